"""What is measured: one entry a case, and what makes its stages."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from bench.measure import ROOT, Command, linter, python

_TRAVERSE = """
import sys
from pxr import Usd, UsdVol
stage = Usd.Stage.Open(sys.argv[1])
for prim in stage.Traverse(): pass
"""
_READ_SAMPLES = """
import os, sys
from pxr import Usd, UsdVol
stage = Usd.Stage.Open(sys.argv[1])
attribute = stage.GetPrimAtPath("/Smoke/density").GetAttribute("filePath")
for time in attribute.GetTimeSamples(): attribute.Get(time)
os.listdir(os.path.join(os.path.dirname(sys.argv[1]), "files"))
"""


@dataclass(frozen=True, slots=True)
class Case:
    """A command of ours, what it is held against, and how much longer it may take.

    `make` writes a stage into a folder, at a scale, and returns it; both commands get its path.
    """

    name: str
    ours: Command
    floor: Command
    wanted: float
    make: Callable[[Path, float], Path] | None = None


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


def many_prims(folder: Path, scale: float) -> Path:
    """200,000 prims, 100 of them Volumes with a field each."""
    from pxr import Sdf

    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", folder)
    stage = folder / "prims.usdc"
    layer = Sdf.Layer.CreateNew(str(stage))
    groups = max(1, round(200 * scale))
    with Sdf.ChangeBlock():
        for group in range(groups):
            parent = Sdf.PrimSpec(layer, f"group_{group}", Sdf.SpecifierDef, "Xform")
            if group % 2:
                _add_volume(parent)
            for number in range(999):
                child = Sdf.PrimSpec(
                    parent, f"prim_{number}", Sdf.SpecifierDef, "Mesh" if number % 2 else "Xform"
                )
                if number % 10 == 0:
                    apis = Sdf.TokenListOp.Create(prependedItems=["MaterialBindingAPI"])
                    child.SetInfo("apiSchemas", apis)
    layer.Save()
    return stage


def _add_volume(parent: object) -> None:
    from pxr import Sdf, Vt

    volume = Sdf.PrimSpec(parent, "cloud", Sdf.SpecifierDef, "Volume")
    extent = Sdf.AttributeSpec(volume, "extent", Sdf.ValueTypeNames.Float3Array)
    extent.default = Vt.Vec3fArray([(0, 0, 0), (1, 1, 1)])
    field = Sdf.PrimSpec(volume, "density", Sdf.SpecifierDef, "OpenVDBAsset")
    relationship = Sdf.RelationshipSpec(volume, "field:density")
    relationship.targetPathList.explicitItems = [field.path]
    for name, kind, value in (
        ("filePath", Sdf.ValueTypeNames.Asset, Sdf.AssetPath("./cloud.vdb")),
        ("fieldName", Sdf.ValueTypeNames.Token, "density"),
        ("fieldDataType", Sdf.ValueTypeNames.Token, "float"),
    ):
        Sdf.AttributeSpec(field, name, kind).default = value


def many_samples(folder: Path, scale: float) -> Path:
    """100,000 time samples of one attribute, each with a file that is there."""
    (folder / "files").mkdir()
    count = max(1, round(100_000 * scale))
    for number in range(count):
        (folder / "files" / f"smoke.{number:06}.vdb").write_bytes(b"x")
    samples = "".join(
        f"            {number}: @./files/smoke.{number:06}.vdb@,\n" for number in range(count)
    )
    stage = folder / "samples.usda"
    stage.write_text(
        f"""#usda 1.0
(
    startTimeCode = 0
    endTimeCode = {count - 1}
)
def Volume "Smoke"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </Smoke/density>

    def OpenVDBAsset "density"
    {{
        token fieldDataType = "float"
        token fieldName = "density"
        asset filePath.timeSamples = {{
{samples}        }}
    }}
}}
""",
        encoding="utf-8",
    )
    return stage


_OPEN = "import sys; from pxr import Usd, UsdVol; Usd.Stage.Open(sys.argv[1])"
_ONE_RULE = linter("--select", "AST002")
_ALL_RULES = linter("--select", "ALL")

CASES = (
    Case("version", linter("--version"), python("pass"), 4.0),
    Case("help", linter("--help"), python("pass"), 4.0),
    Case("small", linter(), python(_OPEN), 1.6, small_stage),
    Case("prims", linter(), python(_TRAVERSE), 1.3, many_prims),
    Case("prims-all-rules", _ALL_RULES, _ONE_RULE, 1.1, many_prims),
    Case("samples", linter("--select", "AST"), python(_READ_SAMPLES), 2.0, many_samples),
)
