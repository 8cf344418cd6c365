"""Layers whose rates or units are not those of the stage."""

from __future__ import annotations

from random import Random

from ..arcs import RATE, UNITS, UNSAID, UP_AXIS
from ..model import Attribute, File, Layer, Line, Prim, Scene
from .declaration import on_scene

_CACHE = "unlike_the_stage.usda"
_BOX = [(0, 0, 0), (1, 1, 1)]


def _say(layer: Layer, name: str, value: object) -> None:
    kept = [line for line in layer.metadata if name not in str(line[0])]
    layer.metadata = [*kept, (f"{name} = {value}",)]


def _referenced(scene: Scene, layer: Layer, rng: Random, extent: Attribute, *said: Line) -> Prim:
    """A Volume in a layer that says this, on the stage by an arc."""
    volume = Prim("cache", "Volume", properties={"extent": extent})
    scene.layers.append(Layer(_CACHE, [volume], list(said)))
    arc = rng.choice(("references", "payload"))
    prim = Prim("cached", metadata=[(f"prepend {arc} = ", File(_CACHE), "</cache>")])
    layer.prims.append(prim)
    return prim


@on_scene("STG008")
def rate_unsaid(scene: Scene, layer: Layer, rng: Random) -> Prim:
    _say(layer, RATE, rng.choice((25, 30, 50, 59.94)))
    start, step = rng.choice((0, 1, 1001)), rng.choice((1, 1, 0.5))
    extent = Attribute("float3[]", samples={start + n * step: _BOX for n in range(8)})
    return _referenced(scene, layer, rng, extent, (UNSAID,))


@on_scene("STG009")
def units_of_another(scene: Scene, layer: Layer, rng: Random) -> Prim:
    _say(layer, UNITS, 1)
    said = (f"{UNITS} = {rng.choice((0.01, 0.001, 100))}",)
    return _referenced(scene, layer, rng, Attribute("float3[]", _BOX), said)


@on_scene("STG009")
def up_axis_of_another(scene: Scene, layer: Layer, rng: Random) -> Prim:
    _say(layer, UP_AXIS, '"Y"')
    return _referenced(scene, layer, rng, Attribute("float3[]", _BOX), (f'{UP_AXIS} = "Z"',))
