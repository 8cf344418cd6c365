"""Stages of many prims, few of which are Volumes: in one layer, or assembled by references."""

from __future__ import annotations

import shutil
from pathlib import Path

from bench.case import Case
from bench.cases.volumes import add_volume
from bench.measure import ROOT, gauged, linter, python

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


def million_prims(folder: Path, scale: float) -> Path:
    """1,000,000 prims, 10,000 of them Volumes with a field each."""
    from pxr import Sdf

    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", folder)
    stage = folder / "million.usdc"
    layer = Sdf.Layer.CreateNew(str(stage))
    with Sdf.ChangeBlock():
        for group in range(max(1, round(1000 * scale))):
            parent = Sdf.PrimSpec(layer, f"group_{group}", Sdf.SpecifierDef, "Xform")
            for number in range(10):
                add_volume(parent, f"cloud_{number}", "./cloud.vdb")
            for number in range(979):
                kind = "Mesh" if number % 2 else "Xform"
                Sdf.PrimSpec(parent, f"prim_{number}", Sdf.SpecifierDef, kind)
    layer.Save()
    return stage


def assembled(folder: Path, scale: float) -> Path:
    """1,000 references to an asset of 200 prims, one of them a Volume with its field."""
    from pxr import Sdf

    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", folder)
    _write_asset(folder / "asset.usdc")
    stage = folder / "assembled.usdc"
    layer = Sdf.Layer.CreateNew(str(stage))
    references = Sdf.ReferenceListOp.Create(prependedItems=[Sdf.Reference("./asset.usdc")])
    with Sdf.ChangeBlock():
        for number in range(max(1, round(1000 * scale))):
            spec = Sdf.PrimSpec(layer, f"asset_{number}", Sdf.SpecifierDef)
            spec.SetInfo("references", references)
    layer.Save()
    return stage


def _write_asset(path: Path) -> None:
    """200 prims: a root, a Volume and its field, and others below five groups."""
    from pxr import Sdf

    layer = Sdf.Layer.CreateNew(str(path))
    with Sdf.ChangeBlock():
        root = Sdf.PrimSpec(layer, "asset", Sdf.SpecifierDef, "Xform")
        layer.defaultPrim = "asset"
        add_volume(root, "cloud", "./cloud.vdb")
        groups = [
            Sdf.PrimSpec(root, f"group_{number}", Sdf.SpecifierDef, "Xform") for number in range(5)
        ]
        for number in range(200 - 3 - len(groups)):
            group = groups[number % len(groups)]
            Sdf.PrimSpec(
                group, f"prim_{number}", Sdf.SpecifierDef, "Mesh" if number % 2 else "Xform"
            )
    layer.Save()


_ONE_RULE = linter("--select", "AST002")
_ALL_RULES = linter("--select", "ALL")
_MEMORY = gauged("memory", linter())

CASES = (
    Case("prims", linter(), python(_TRAVERSE), 1.3, many_prims),
    Case("prims-all-rules", _ALL_RULES, _ONE_RULE, 1.1, many_prims),
    Case("assembled", linter(), python(_TRAVERSE), 1.3, assembled),
    Case("million", linter(), python(_TRAVERSE), 1.3, million_prims, is_big=True),
    Case("million-memory", _MEMORY, None, 800, million_prims, unit="MB", is_big=True),
)
