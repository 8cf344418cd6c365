"""Start-up: runs with nothing or little to check."""

from __future__ import annotations

import shutil
from pathlib import Path

from bench.case import Case
from bench.measure import ROOT, linter, python

_OPEN = "import sys; from pxr import Usd, UsdVol; Usd.Stage.Open(sys.argv[1])"


def small_stage(folder: Path, scale: float) -> Path:
    """One Volume with one field and its file."""
    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", folder)
    stage = folder / "small.usda"
    stage.write_text(
        """#usda 1.0
def Volume "Cloud"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </Cloud/density>

    def OpenVDBAsset "density"
    {
        token fieldDataType = "float"
        token fieldName = "density"
        asset filePath = @./cloud.vdb@
    }
}
""",
        encoding="utf-8",
    )
    return stage


CASES = (
    Case("version", linter("--version"), python("pass"), 4.0),
    Case("help", linter("--help"), python("pass"), 4.0),
    Case("small", linter(), python(_OPEN), 1.6, small_stage),
)
