"""Time samples that USD does not give at the times that it names, since it rounds scaled times."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from pxr import Usd

from usdvol_lint.model import StageReport

ABOVE = """#usda 1.0
(
    timeCodesPerSecond = 59.94
    subLayers = [@./cache.usda@]
)
"""
CACHE = """#usda 1.0
(
    timeCodesPerSecond = 24
)
def ParticleField3DGaussianSplat "scan"
{
    float3[] extent = [(-1, -1, -1), (1, 1, 1)]
    point3h[] positionsh = [(0, 0, 0)]
    point3h[] positionsh.timeSamples = {
        0: [],
        1: [(0, 0, 0)],
    }
}
def Volume "cloud"
{
    rel field:density = </cloud/density>

    def OpenVDBAsset "density"
    {
        asset filePath = @./still.vdb@
        asset filePath.timeSamples = {
            0: None,
            1: @./cloud.vdb@,
        }
    }
}
"""


def test_a_sample_whose_scaled_time_is_rounded_down_is_read(
    lint_text: Callable[[str], StageReport], tmp_path: Path
) -> None:
    (tmp_path / "cache.usda").write_text(CACHE)
    report = lint_text(ABOVE)
    stage = Usd.Stage.Open("stage.usda")
    positions = stage.GetAttributeAtPath("/scan.positionsh")
    assert list(map(len, map(positions.Get, positions.GetTimeSamples()))) == [0, 0]
    codes = [finding.code for finding in report.findings]
    assert "ARR001" not in codes
    assert "AST001" not in codes
    [missing] = [each for each in report.findings if each.code == "AST002"]
    assert missing.site.frames == "default, 2.4975"
