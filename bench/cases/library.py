"""Libraries of many stages: whole runs over thousands of small ones."""

from __future__ import annotations

from pathlib import Path

from bench.case import Case
from bench.measure import ROOT, linter, python

_STAGE = """#usda 1.0
(
    defaultPrim = "Cloud"
    metersPerUnit = 0.01
    upAxis = "Y"
)
def Volume "Cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </Cloud/density>

    def OpenVDBAsset "density"
    {{
        token fieldDataType = "float"
        token fieldName = "density"
        asset filePath = @./cloud.{number:05}.vdb@
    }}
}}
"""

_BARE = """
import os, sys
from pxr import Usd, UsdVol
part, parts = map(int, sys.argv[2:] or (0, 1))
for number, (folder, _, files) in enumerate(os.walk(sys.argv[1])):
    for name in files if number % parts == part else ():
        if name.endswith(".usda"):
            stage = Usd.Stage.Open(os.path.join(folder, name))
            for prim in stage.Traverse():
                if prim.IsA(UsdVol.OpenVDBAsset):
                    for attribute in ("fieldDataType", "fieldName", "filePath"):
                        value = prim.GetAttribute(attribute).Get()
                    os.path.exists(value.resolvedPath)
"""

_BARE_BY_TWO = f"""
import subprocess, sys
code = {_BARE!r}
halves = [[sys.executable, "-c", code, sys.argv[1], half, "2"] for half in "01"]
for child in [subprocess.Popen(half) for half in halves]: child.wait()
"""


def small_stages(folder: Path, scale: float) -> Path:
    return _library(folder, round(2_000 * scale))


def more_small_stages(folder: Path, scale: float) -> Path:
    return _library(folder, round(10_000 * scale))


def _library(folder: Path, stages: int) -> Path:
    """Stages of one Volume with one field and a file of its own, a hundred in a folder."""
    cloud = (ROOT / "rules" / "assets" / "cloud.vdb").read_bytes()
    library = folder / "library"
    for number in range(max(1, stages)):
        asset = library / f"{number // 100:03}"
        asset.mkdir(parents=True, exist_ok=True)
        (asset / f"stage_{number:05}.usda").write_text(
            _STAGE.format(number=number), encoding="utf-8"
        )
        (asset / f"cloud.{number:05}.vdb").write_bytes(cloud)
    return library


_ONE = linter("--isolated", "--quiet", "--jobs", "1")
_TWO = linter("--isolated", "--quiet", "--jobs", "2")

CASES = (
    Case("stages", _ONE, python(_BARE), 3.0, small_stages),
    Case("stages-2", _TWO, _ONE, 0.56, more_small_stages),
    Case("stages-2-bare", python(_BARE_BY_TWO), python(_BARE), 0.56, more_small_stages),
)
