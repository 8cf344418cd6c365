"""What only resembles an encoding that predates the schema."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]


@pytest.mark.parametrize(
    ("prim", "is_one"),
    [
        ('def Points "p" {\ncustom token gsplat:encoding = "raw"\n}', True),
        ('def Points "p" {\ncustom token my:gsplat:encoding = "raw"\n}', False),
        ('def Points "p" (apiSchemas = ["GaussiansAPI"]) {}', True),
        ('def Volume "p" (apiSchemas = ["GaussiansAPI"]) {}', False),
        ('def Volume "p" {\ncustom float omni:nurec:offset = 0\n}', True),
        ('def Volume "p" {\ncustom float my:omni:nurec:offset = 0\n}', False),
    ],
)
def test_signs(prim: str, is_one: bool, lint_text: Lint) -> None:
    codes = [finding.code for finding in lint_text(f"#usda 1.0\n{prim}\n").findings]
    assert ("SCH011" in codes, "LNT002" in codes) == (is_one, False)
