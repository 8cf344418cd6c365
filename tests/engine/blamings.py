"""Layers as text with what is to blame in them, and which spec that is, in short."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pxr import Usd

from usdvol_lint.engine.blame import Blaming
from usdvol_lint.rule import Problem

Open = Callable[..., Usd.Stage]

ASSET = """
def Volume "tank" (
    prepend apiSchemas = ["MotionAPI"]
)
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </tank/density>
    def OpenVDBAsset "density" (
        kind = "component"
    )
    {
        asset filePath (
            doc = "words"
        )
        asset filePath = @./a.vdb@
        token fieldName
    }
}
"""
REFERS = "references = @./asset.usda@</tank>"
ANIMATED = """
def OpenVDBAsset "density"
{
    asset filePath = @./a.vdb@
    asset filePath.timeSamples = {
        1: @./1.vdb@,
        2: @./2.vdb@,
        4: @./4.vdb@,
    }
}
"""
MOVED = "(\n    subLayers = [@./base.usda@ (offset = 100; scale = 2)]\n)\n"


def blame(stage: Usd.Stage, path: str, **problem: Any) -> tuple[str, str, str | None, str]:
    """Layer, path of the spec, property and subject."""
    at = stage.GetObjectAtPath(path) if path != "/" else stage.GetPseudoRoot()
    against = [
        stage.GetObjectAtPath(each) if isinstance(each, str) else each
        for each in problem.pop("against", ())
    ]
    found = Blaming().blame(Problem("", at=at, against=against, **problem))
    assert found.spec
    name = found.spec.layer.GetDisplayName()
    return name.removesuffix(".usda"), str(found.spec.path), found.property, found.subject


def shot(inside: str = "", meta: str = "", kind: str = "def", more: str = "") -> str:
    return f'{kind} "tank" (\n{meta}\n{REFERS}\n)\n{{\n{inside}\n}}\n{more}'
