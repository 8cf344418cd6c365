"""Runs of the packs for tests over bad input, and what is said of each stage."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from process import STUDIO, Ran
from pxr import Sdf, Usd, UsdVol

POSIX = os.name == "posix"
STUDIO_ONLY = ("--isolated", "--pack", STUDIO, "--select", "STU001", "--output-format", "json")

GOOD = "name 'fog', wanted smoke, fire"


def crate() -> bytes:
    """A small crate file, the same in every run."""
    layer = Sdf.Layer.CreateAnonymous(".usdc")
    stage = Usd.Stage.Open(layer)
    smoke = UsdVol.Volume.Define(stage, "/smoke")
    smoke.CreateExtentAttr([(0, 0, 0), (1, 1, 1)])
    field = UsdVol.OpenVDBAsset.Define(stage, "/smoke/density")
    for time in range(40):
        field.CreateFilePathAttr().Set(f"./smoke.{time:04}.vdb", time)
    smoke.CreateFieldRelationship("density", field.GetPath())
    path = Path("crate.usdc")
    layer.Export(str(path))
    return path.read_bytes()


def statuses(ran: Ran) -> dict[str, str]:
    return {stage["path"]: stage["status"] for stage in ran.json["stages"]}


def troubles(ran: Ran) -> dict[str, tuple[Any, ...]]:
    """What is said of each stage, with its place and the advice."""
    return {
        stage["path"]: (
            finding["message"],
            finding["line"],
            finding["column"],
            finding["suggestion"],
        )
        for stage in ran.stages
        for finding in stage["findings"]
    }


def pack(folder: Path, **modules: str) -> Path:
    folder.mkdir()
    for name, text in modules.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    return folder


RULE = """\
from usdvol_lint.rule import ERROR, rule


@rule("{code}", on="Volume", severity=ERROR, since="1")
def {name}(volume, facts):
    yield from ()
"""
