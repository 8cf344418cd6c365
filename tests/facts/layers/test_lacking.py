"""What may be missing because a layer did not open, and what is missing all the same."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]
CLOUD = """def Volume "cloud" {
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = <density>
}
"""


def codes(report: StageReport) -> set[str]:
    return {finding.code for finding in report.findings} & {"STG001", "VOL001"}


def test_a_clip_brings_no_prims(lint_text: Lint) -> None:
    clips = """def Xform "asset" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./gone.usda@]
            string primPath = "/asset"
            double2[] active = [(1, 0)]
        }
    }
) {
"""
    assert codes(lint_text(f"#usda 1.0\n{clips}{CLOUD}}}\n")) == {"STG001", "VOL001"}


@pytest.mark.parametrize(
    ("more", "expected"), [("", {"VOL001"}), (", @./gone.usda@</asset>", {"STG001"})]
)
def test_an_instance_may_lack_what_its_prototype_does(
    more: str, expected: set[str], lint_text: Lint, tmp_path: Path
) -> None:
    (tmp_path / "asset.usda").write_text(f'#usda 1.0\ndef Xform "asset" {{\n{CLOUD}}}\n')
    instance = f"instanceable = true\nreferences = [@./asset.usda@</asset>{more}]"
    assert codes(lint_text(f'#usda 1.0\ndef "a" (\n{instance}\n) {{\n}}\n')) == expected


def test_what_a_circle_of_references_leaves_out_may_define_the_prim(
    lint_text: Lint, tmp_path: Path
) -> None:
    circle = '#usda 1.0\ndef Xform "World" (\n    references = @./{}.usda@</World>\n)\n{{\n{}}}\n'
    below = f'    def Xform "fx"\n    {{\n    }}\n    over "FX"\n    {{\n{CLOUD}    }}\n'
    (tmp_path / "other.usda").write_text(circle.format("stage", ""))
    report = lint_text(circle.format("other", below))
    assert [finding.code for finding in report.findings] == ["STG002"]
