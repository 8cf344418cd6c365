"""Stages of many prims, few of which are Volumes."""

from __future__ import annotations

import shutil
from pathlib import Path

from bench.case import Case
from bench.cases.volumes import add_volume
from bench.measure import ROOT, linter, python

_TRAVERSE = """
import sys
from pxr import Usd, UsdVol
stage = Usd.Stage.Open(sys.argv[1])
for prim in stage.Traverse(): pass
"""


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
                add_volume(parent, "cloud", "./cloud.vdb")
            for number in range(999):
                child = Sdf.PrimSpec(
                    parent, f"prim_{number}", Sdf.SpecifierDef, "Mesh" if number % 2 else "Xform"
                )
                if number % 10 == 0:
                    apis = Sdf.TokenListOp.Create(prependedItems=["MaterialBindingAPI"])
                    child.SetInfo("apiSchemas", apis)
    layer.Save()
    return stage


_ONE_RULE = linter("--select", "AST002")
_ALL_RULES = linter("--select", "ALL")

CASES = (
    Case("prims", linter(), python(_TRAVERSE), 1.3, many_prims),
    Case("prims-all-rules", _ALL_RULES, _ONE_RULE, 1.1, many_prims),
)
