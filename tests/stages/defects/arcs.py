"""Arcs that USD follows to nothing."""

from __future__ import annotations

from random import Random

from ..model import File, Layer, Prim, Scene
from .declaration import on_scene

_LOST = "lost_library.usda"


def _arc(layer: Layer, rng: Random, *target: str | File) -> Prim:
    """A prim whose reference or payload leads there."""
    arc = rng.choice(("prepend references", "references", "prepend payload", "payload"))
    prim = Prim("lost_smoke", rng.choice(("", "Xform")), metadata=[(f"{arc} = ", *target)])
    layer.prims.append(prim)
    return prim


def _library(scene: Scene, *names: str, default: str = "") -> File:
    """A layer of its own with prims of these names."""
    metadata = [(f'defaultPrim = "{default}"',)] if default else []
    prims = [Prim(name, "Xform", children=[Prim("part", "Xform")]) for name in names]
    scene.layers.append(Layer(_LOST, prims, metadata))
    return File(_LOST)


@on_scene("STG004")
def reference_to_no_prim(scene: Scene, layer: Layer, rng: Random) -> Prim:
    return _arc(layer, rng, "</no/such/prim>")


@on_scene("STG004")
def prim_misspelt(scene: Scene, layer: Layer, rng: Random) -> Prim:
    target = rng.choice(("</puf>", "</puff/prat>", "</Puff/part>"))
    return _arc(layer, rng, _library(scene, "puff", "other"), target)


@on_scene("STG004")
def no_default_prim(scene: Scene, layer: Layer, rng: Random) -> Prim:
    return _arc(layer, rng, _library(scene, *rng.choice((("puff",), ("puff", "other"), ()))))


@on_scene("STG004")
def default_prim_not_there(scene: Scene, layer: Layer, rng: Random) -> Prim:
    return _arc(layer, rng, _library(scene, "puff", default=rng.choice(("pufff", "/puff/gone"))))
