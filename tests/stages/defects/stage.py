"""The stage as a whole: what its root layer names, and what it is."""

from __future__ import annotations

from random import Random

from ..model import Layer, Prim, Scene
from .declaration import on_scene


@on_scene("STG001")
def reference_gone(scene: Scene, layer: Layer, rng: Random) -> Prim:
    arc = rng.choice(("references", "payload"))
    prim = Prim("lost", "Xform", metadata=[(f"prepend {arc} = @./not/there.usda@</lost>",)])
    layer.prims.append(prim)
    return prim


@on_scene("STG001")
def sublayer_gone(scene: Scene, layer: Layer, rng: Random) -> None:
    for number, line in enumerate(layer.metadata):
        if "subLayers" in str(line[0]):
            layer.metadata[number] = (line[0], "@./gone.usda@, ", *line[1:])
            return
    layer.metadata.append(("subLayers = [@./gone.usda@]",))


@on_scene("STG002", perhaps=("STG002",))
def references_in_a_circle(scene: Scene, layer: Layer, rng: Random) -> Prim:
    prims = [Prim(f"circle_{one}") for one in "xy"]
    for prim, other in zip(prims, reversed(prims), strict=True):
        prim.metadata = [(f"prepend references = </{other.name}>",)]
    layer.prims += prims
    return prims[0]


@on_scene("STG003")
def no_prims(scene: Scene, layer: Layer, rng: Random) -> None:
    layer.prims.clear()
    layer.metadata = [('doc = "an export that died"',)]
    scene.layers[:] = [layer]


@on_scene("LNT001")
def text_broken(scene: Scene, layer: Layer, rng: Random) -> None:
    layer.path = scene.root = "broken.usda"
    layer.prims.append(Prim("bro ken", "Xform"))


@on_scene("LNT005", is_info=True)
def reference_to_a_uri(scene: Scene, layer: Layer, rng: Random) -> Prim:
    line = ("prepend references = @https://example.com/tree.usda@</tree>",)
    prim = Prim("remote", "Xform", metadata=[line])
    layer.prims.append(prim)
    return prim
