"""How values of asset attributes are read, where several prims share them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]


@pytest.mark.parametrize("order", ["ab", "ba"])
def test_samples_hide_a_default_that_another_prim_has(
    order: str, lint_text: Lint, tmp_path: Path
) -> None:
    (tmp_path / "there.vdb").write_bytes(b"x")
    default = "asset filePath = @./there.vdb@"
    samples = "asset filePath.timeSamples = {1: @./gone.vdb@}"
    bodies = dict(zip(order, (default, f"{default}\n{samples}"), strict=True))
    text = "#usda 1.0\n"
    for name in sorted(bodies):
        text += f'def OpenVDBAsset "{name}" {{\n{bodies[name]}\n}}\n'
    missing = [finding for finding in lint_text(text).findings if finding.code == "AST002"]
    assert [(each.site.prim, each.site.frames) for each in missing] == [(f"/{order[1]}", "1")]
