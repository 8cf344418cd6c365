"""The ways in which a stage can come by what is in another layer.

Each takes something placed in a layer, puts it into a new layer in its way, and says at which
paths it is there: add one by writing such a function with `@arc`.
"""

from __future__ import annotations

import posixpath
from random import Random
from typing import Any

from .files import SHARED, original
from .model import Attribute, Content, Expression, File, Prim, Scene, overs
from .placing import (
    Arc,
    Placed,
    add_layer,
    arc,
    below,
    composed,
    instancer,
    is_layer,
    offset,
    referring,
    target,
    where,
    wrap_in_reference,
)
from .subjects import every_prim

UNITS = "metersPerUnit"
UP_AXIS = "upAxis"
RATE = "timeCodesPerSecond"
UNDONE = 'doc = "undoes the rate for what it references"'
UNSAID = 'doc = "says no rate"'


@arc
@where(is_layer)
def sublayer(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    layer = add_layer(scene, name, rng, [])
    layer.add_sublayer(placed.layer_path, offset(rng))
    return placed._replace(layer_path=layer.path, layer=layer)


@arc
def reference(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    return wrap_in_reference(scene, placed, name, rng)


@arc
def typed_reference(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A reference on a prim that says the type again which the referenced one has."""
    roots = placed.layer.prims if placed.layer else []
    types = [prim.type for prim in roots if f"/{prim.name}" == placed.root]
    prim = referring(placed, name, offset(rng))
    prim.type = types[0] if types else ""
    return below(add_layer(scene, name, rng, [prim]), placed, f"/{name}")


@arc
@where(is_layer)
def default_prim(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    assert placed.layer
    placed.layer.metadata.append((f'defaultPrim = "{placed.root[1:]}"',))
    return composed(scene, placed, name, rng, ("references = ", File(placed.layer_path)))


@arc
def payload(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    line = ("prepend payload = ", *target(placed), offset(rng))
    return composed(scene, placed, name, rng, line)


@arc
def instance(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Two instances of one prim: what is wrong is shown at the first.

    Clips on an instance itself are none for what is below it, so they need a group around them.
    """
    if placed.has_clips and placed.root == placed.path:
        group = Prim(f"{name}_clipped", "Xform", children=[referring(placed, "inner")])
        layer = add_layer(scene, group.name, rng, [group])
        placed = below(layer, placed, f"/{group.name}", f"/{group.name}/inner")
    copies = [referring(placed, f"{name}_{letter}") for letter in "ab"]
    for copy in copies:
        copy.metadata.insert(0, ("instanceable = true",))
    layer = add_layer(scene, name, rng, [Prim(name, "Xform", children=copies)])
    placed = placed._replace(holds_instances=True)
    return below(layer, placed, f"/{name}", f"/{name}/{copies[0].name}")


@arc
@where(lambda scene, placed: not placed.has_clips)
def instanced_later(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A stronger layer makes an instance of a prim below which a weaker one has an over."""
    prim = referring(placed, "inner")
    rest = placed.path[len(placed.root) :]
    if rest:
        topmost, last = overs(rest)
        prim.children.append(topmost)
        last.properties["visibility"] = Attribute("token", "invisible")
    weaker = add_layer(scene, f"{name}_layout", rng, [Prim(name, "Xform", children=[prim])])
    shared = Prim("inner", specifier="over", metadata=[("instanceable = true",)])
    layer = add_layer(scene, name, rng, [Prim(name, specifier="over", children=[shared])])
    layer.add_sublayer(weaker.path)
    return below(layer, placed, f"/{name}", f"/{name}/inner")._replace(holds_instances=True)


@arc
def point_instancer(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    prim = instancer(name, referring(placed, "prototype"), "prototype")
    layer = add_layer(scene, name, rng, [prim])
    return below(layer, placed, f"/{name}", f"/{name}/prototype")


@arc
def prototype_below_over(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """As USD's documentation advises it; of what else is below the `over` nothing is drawn."""
    spare = Prim("spare", rng.choice(("Volume", "OpenVDBAsset")))
    if rng.random() < 0.5:
        spare = referring(placed, "spare")
        spare.metadata.append(("instanceable = true",))
    library = Prim("Prototypes", specifier="over")
    library.children = [referring(placed, "prototype"), spare]
    prim = instancer(name, library, "Prototypes/prototype")
    layer = add_layer(scene, name, rng, [prim])
    return below(layer, placed, f"/{name}", f"/{name}/Prototypes/prototype")


@arc
def variant(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    outer = Prim(name, "Xform")
    outer.metadata = [
        ('variants = { string look = "thick" }',),
        ('prepend variantSets = "look"',),
    ]
    outer.variants = {"look": {"none": [], "thick": [referring(placed, "inner")]}}
    layer = add_layer(scene, name, rng, [outer])
    return below(layer, placed, f"/{name}", f"/{name}/inner")


@arc
@where(lambda scene, placed: not placed.holds_instances)
def inherited(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """From a class; where that holds instances, these are shown at the class's own path."""
    source = referring(placed, f"_class_{name}")
    source.specifier = "class"
    heir = Prim(name, metadata=[(f"{rng.choice(('inherits', 'specializes'))} = </{source.name}>",)])
    layer = add_layer(scene, name, rng, [source, heir])
    return below(layer, placed, f"/{name}")


@arc
def turned(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Below a group that turns about a pivot, in a layer whose time range has one end."""
    group = Prim(name, "Xform", children=[referring(placed, "inner")])
    pivot = "xformOp:translate:pivot"
    order = ["!resetXformStack!", pivot, "xformOp:rotateXYZ", f"!invert!{pivot}"]
    group.properties = {
        pivot: Attribute("double3", (2, 0, 0)),
        "xformOp:rotateXYZ": Attribute("float3", samples={1: (0, 0, 0), 90: (0, 360, 0)}),
        "xformOpOrder": Attribute("token[]", order, is_uniform=True),
    }
    layer = add_layer(scene, name, rng, [group])
    layer.metadata.append((rng.choice(("startTimeCode = 1001", "endTimeCode = -5")),))
    return below(layer, placed, f"/{name}", f"/{name}/inner")


@arc
def internal_reference(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """From a prim of the same layer, which no other may be drawn from: an over."""
    source = Prim(f"{name}_library", specifier="over")
    source.children = [referring(placed, "part")]
    copy = Prim(name, metadata=[(f"references = </{source.name}/part>",)])
    layer = add_layer(scene, name, rng, [source, copy])
    return below(layer, placed, f"/{name}")


def says_no_rate(scene: Scene, placed: Placed) -> bool:
    """Whether a layer says no rate, so that USD takes it for 24."""
    metadata = placed.layer.metadata if placed.layer else []
    return not any(RATE in str(line[0]) for line in metadata)


@arc
@where(says_no_rate)
def rate_undone(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A rate that is not 24, and a scale that undoes it for layers that say none."""
    rate = rng.choice((12, 48))  # exact scales: others USD may round to the sample before
    kind = rng.choice(("references", "payload"))
    scale = 24 / rate
    line = (f"prepend {kind} = ", *target(placed), f" (offset = 5; scale = {scale!r})")
    placed = composed(scene, placed, name, rng, line)
    assert placed.layer
    said = [each for each in placed.layer.metadata if RATE not in str(each[0])]
    placed.layer.metadata = [*said, (f"{RATE} = {rate}",), (UNDONE,)]
    return placed


@arc
def units_corrected(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Another up axis and other units, which a group around the reference makes up for."""
    if placed.layer and not any(UNITS in str(line[0]) for line in placed.layer.metadata):
        placed.layer.metadata += [(f"{UNITS} = 0.01",), (f'{UP_AXIS} = "Z"',)]
    group = Prim(f"{name}_turned", "Xform", children=[referring(placed, name)])
    ops = {"rotateX": ("float", -90), "scale": ("float3", (0.01, 0.01, 0.01))}
    group.properties = {f"xformOp:{op}": Attribute(*said) for op, said in ops.items()}
    names = [f"xformOp:{op}" for op in ops]
    group.properties["xformOpOrder"] = Attribute("token[]", names, is_uniform=True)
    layer = add_layer(scene, name, rng, [group])
    layer.metadata += [(f"{UNITS} = 1",), (f'{UP_AXIS} = "Y"',)]
    return below(layer, placed, f"/{group.name}", f"/{group.name}/{name}")


def say_rates(contents: list[Content], root: str) -> None:
    """Below a root layer whose rate is not 24, layers say that theirs is, unless that is undone."""
    layers = [layer for content in contents for layer in content.layers]
    [top] = [layer.metadata for layer in layers if layer.path == root] or [[]]
    if not any(RATE in str(line[0]) for line in top) or (UNDONE,) in top:
        return
    for layer in layers:
        if not any(RATE in str(line[0]) or line == (UNSAID,) for line in layer.metadata):
            layer.metadata.append((f"{RATE} = 24",))


@arc
@where(is_layer)
def overridden(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A sublayer, and stronger opinions on its root prim that change nothing of interest."""
    over = Prim(placed.root[1:], specifier="over")
    over.properties["studio:approved"] = Attribute("bool", True)
    layer = add_layer(scene, name, rng, [over])
    layer.add_sublayer(placed.layer_path)
    return placed._replace(layer_path=layer.path, layer=layer)


@arc
@where(lambda scene, placed: placed.layer is not None and not scene.packages)
def package(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Everything so far in a usdz, whose first file is the layer; what it shares goes along."""
    content = Content(scene.layers, scene.files)
    scene.layers, scene.files = [], {}
    content.layers.sort(key=lambda layer: layer is not placed.layer)
    _take_along(content)
    path = posixpath.join(rng.choice(("", "packages/")), f"{name}.usdz")
    scene.packages[path] = content
    return placed._replace(layer_path=path, layer=None)


def _take_along(content: Content) -> None:
    """The shared files that the layers name become files of the content."""

    def taken(value: Any) -> Any:
        is_file = isinstance(value, (File, Expression))
        if not is_file or not value.path.startswith(f"../{SHARED}/"):
            return value
        inside = value.path.removeprefix("../")
        if original(value.path).is_file():
            content.files[inside] = original(value.path)
        return value._replace(path=inside)

    for layer in content.layers:
        for prim in every_prim(layer.prims):
            for each in prim.properties.values():
                if isinstance(each, Attribute):
                    each.value = taken(each.value)
                    each.samples = {time: taken(value) for time, value in each.samples.items()}


ARCS = tuple(each for each in globals().values() if isinstance(each, Arc))
