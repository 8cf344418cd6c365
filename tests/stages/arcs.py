"""The ways in which a stage can come by what is in another layer.

Each takes something placed in a layer, puts it into a new layer in its way, and says at which
paths it is there: add one by writing such a function with `@arc`.
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Any, NamedTuple

from .files import SHARED, original
from .model import Attribute, Content, Expression, File, Layer, Line, Prim, Relationship, Scene
from .subjects import Subject, every_prim, new_layer


class Placed(NamedTuple):
    """A layer, or a package with it, in which the root prim of a subject is at `path`.

    `root` is the root prim above, or that prim itself.
    """

    layer_path: str
    root: str
    path: str
    layer: Layer | None = None
    has_clips: bool = False
    holds_instances: bool = False

    def shown(self, path: str) -> str:
        """Where the prim is that has this path in the layer of the subject."""
        return self.path + "".join(f"/{name}" for name in path.split("/")[2:])


UNITS = "metersPerUnit"
UP_AXIS = "upAxis"
RATE = "timeCodesPerSecond"
UNDONE = 'doc = "undoes the rate for what it references"'
UNSAID = 'doc = "says no rate"'

Wrap = Callable[[Scene, Placed, str, Random], Placed]


@dataclass(frozen=True)
class Arc:
    """A way by its name."""

    name: str
    wrap: Wrap


def arc(wrap: Wrap) -> Arc:
    return Arc(wrap.__name__.replace("_", " "), wrap)


def place(subject: Subject) -> Placed:
    """The subject in its own layer; `has_clips` is about its root prim."""
    root = f"/{subject.root.name}"
    has_clips = any("clips" in str(line[0]) for line in subject.root.metadata)
    return Placed(subject.layer.path, root, root, subject.layer, has_clips)


def _offset(rng: Random) -> str:
    choices = ("", "", " (offset = 10)", " (offset = -3; scale = 2)", " (scale = 0.5)")
    return rng.choice(choices)


def _target(placed: Placed) -> tuple[str | File, ...]:
    """The layer, and the prim in it unless it is the default."""
    if placed.layer and placed.layer.metadata:  # it may have a defaultPrim
        defaults = [line for line in placed.layer.metadata if "defaultPrim" in str(line[0])]
        if defaults:
            return (File(placed.layer_path),)
    return (File(placed.layer_path), f"<{placed.root}>")


def _new(scene: Scene, name: str, rng: Random, prims: list[Prim]) -> Layer:
    layer = new_layer(rng, name, ("usda", "usda", "usda", "usda", "usd"))
    layer.prims = prims
    if rng.random() < 0.15:
        layer.metadata.append((f"timeCodesPerSecond = {rng.choice((12, 25, 48))}",))
    scene.layers.append(layer)
    return layer


def _below(layer: Layer, placed: Placed, root: str, path: str | None = None) -> Placed:
    """What was at the root is now at `path` below the prim `root` of a new layer."""
    path = path or root
    rest = placed.path[len(placed.root) :]
    return placed._replace(layer_path=layer.path, root=root, path=path + rest, layer=layer)


def _composed(scene: Scene, placed: Placed, name: str, rng: Random, *lines: Line) -> Placed:
    """A prim with metadata that brings the other layer in, alone or below a group."""
    prim = Prim(name, metadata=list(lines))
    if rng.random() < 0.5:
        layer = _new(scene, name, rng, [prim])
        return _below(layer, placed, f"/{name}")
    group = Prim(f"{name}_set", "Xform", children=[prim])
    layer = _new(scene, name, rng, [group])
    return _below(layer, placed, f"/{group.name}", f"/{group.name}/{name}")


@arc
def sublayer(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    if placed.layer is None:
        return reference.wrap(scene, placed, name, rng)
    layer = _new(scene, name, rng, [])
    line = ("subLayers = [", File(placed.layer_path), _offset(rng), "]")
    layer.metadata.append(line)
    return placed._replace(layer_path=layer.path, layer=layer)


@arc
def reference(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    line = ("prepend references = ", *_target(placed), _offset(rng))
    return _composed(scene, placed, name, rng, line)


@arc
def typed_reference(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A reference on a prim that says the type again which the referenced one has."""
    roots = placed.layer.prims if placed.layer else []
    types = [prim.type for prim in roots if f"/{prim.name}" == placed.root]
    line = ("prepend references = ", *_target(placed), _offset(rng))
    prim = Prim(name, types[0] if types else "", metadata=[line])
    return _below(_new(scene, name, rng, [prim]), placed, f"/{name}")


@arc
def default_prim(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    if placed.layer is None:
        return reference.wrap(scene, placed, name, rng)
    placed.layer.metadata.append((f'defaultPrim = "{placed.root[1:]}"',))
    return _composed(scene, placed, name, rng, ("references = ", File(placed.layer_path)))


@arc
def payload(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    line = ("prepend payload = ", *_target(placed), _offset(rng))
    return _composed(scene, placed, name, rng, line)


@arc
def instance(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Two instances of one prim: what is wrong is shown at the first.

    Clips on an instance itself are none for what is below it, so they need a group around them.
    """
    if placed.has_clips and placed.root == placed.path:
        group = Prim(f"{name}_clipped", "Xform")
        inner = Prim("inner", metadata=[("prepend references = ", *_target(placed))])
        group.children.append(inner)
        layer = _new(scene, group.name, rng, [group])
        placed = _below(layer, placed, f"/{group.name}", f"/{group.name}/inner")
    line: Line = ("prepend references = ", *_target(placed))
    copies = [Prim(f"{name}_{letter}") for letter in "ab"]
    for copy in copies:
        copy.metadata = [("instanceable = true",), line]
    layer = _new(scene, name, rng, [Prim(name, "Xform", children=copies)])
    placed = placed._replace(holds_instances=True)
    return _below(layer, placed, f"/{name}", f"/{name}/{copies[0].name}")


@arc
def instanced_later(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A stronger layer makes an instance of a prim below which a weaker one has an over."""
    if placed.has_clips:
        return reference.wrap(scene, placed, name, rng)
    prim = Prim("inner", metadata=[("prepend references = ", *_target(placed))])
    inner = prim
    for part in placed.path[len(placed.root) :].split("/")[1:]:
        inner.children.append(Prim(part, specifier="over"))
        inner = inner.children[0]
    if inner is not prim:
        inner.properties["visibility"] = Attribute("token", "invisible")
    weaker = _new(scene, f"{name}_layout", rng, [Prim(name, "Xform", children=[prim])])
    shared = Prim("inner", specifier="over", metadata=[("instanceable = true",)])
    layer = _new(scene, name, rng, [Prim(name, specifier="over", children=[shared])])
    layer.metadata.append(("subLayers = [", File(weaker.path), "]"))
    return _below(layer, placed, f"/{name}", f"/{name}/inner")._replace(holds_instances=True)


@arc
def point_instancer(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    prototype = Prim("prototype", metadata=[("prepend references = ", *_target(placed))])
    instancer = Prim(name, "PointInstancer", children=[prototype])
    instancer.properties = {
        "prototypes": Relationship([f"/{name}/prototype"]),
        "protoIndices": Attribute("int[]", [0, 0]),
        "positions": Attribute("point3f[]", [(0, 0, 0), (5, 0, 0)]),
    }
    layer = _new(scene, name, rng, [instancer])
    return _below(layer, placed, f"/{name}", f"/{name}/prototype")


@arc
def prototype_below_over(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """As USD's documentation advises it; of what else is below the `over` nothing is drawn."""
    prototype = Prim("prototype", metadata=[("prepend references = ", *_target(placed))])
    spare = Prim("spare", rng.choice(("Volume", "OpenVDBAsset")))
    library = Prim("Prototypes", specifier="over", children=[prototype, spare])
    instancer = Prim(name, "PointInstancer", children=[library])
    instancer.properties = {
        "prototypes": Relationship([f"/{name}/Prototypes/prototype"]),
        "protoIndices": Attribute("int[]", [0, 0]),
        "positions": Attribute("point3f[]", [(0, 0, 0), (5, 0, 0)]),
    }
    layer = _new(scene, name, rng, [instancer])
    return _below(layer, placed, f"/{name}", f"/{name}/Prototypes/prototype")


@arc
def variant(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    inner = Prim("inner", metadata=[("prepend references = ", *_target(placed))])
    outer = Prim(name, "Xform")
    outer.metadata = [
        ('variants = { string look = "thick" }',),
        ('prepend variantSets = "look"',),
    ]
    outer.variants = {"look": {"none": [], "thick": [inner]}}
    layer = _new(scene, name, rng, [outer])
    return _below(layer, placed, f"/{name}", f"/{name}/inner")


@arc
def inherited(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """From a class; where that holds instances, these are shown at the class's own path."""
    if placed.holds_instances:
        return reference.wrap(scene, placed, name, rng)
    source = Prim(f"_class_{name}", specifier="class")
    source.metadata = [("prepend references = ", *_target(placed))]
    heir = Prim(name, metadata=[(f"{rng.choice(('inherits', 'specializes'))} = </{source.name}>",)])
    layer = _new(scene, name, rng, [source, heir])
    return _below(layer, placed, f"/{name}")


@arc
def turned(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Below a group that turns about a pivot, in a layer whose time range has one end."""
    inner = Prim("inner", metadata=[("prepend references = ", *_target(placed))])
    group = Prim(name, "Xform", children=[inner])
    pivot = "xformOp:translate:pivot"
    order = ["!resetXformStack!", pivot, "xformOp:rotateXYZ", f"!invert!{pivot}"]
    group.properties = {
        pivot: Attribute("double3", (2, 0, 0)),
        "xformOp:rotateXYZ": Attribute("float3", samples={1: (0, 0, 0), 90: (0, 360, 0)}),
        "xformOpOrder": Attribute("token[]", order, is_uniform=True),
    }
    layer = _new(scene, name, rng, [group])
    layer.metadata.append((rng.choice(("startTimeCode = 1001", "endTimeCode = -5")),))
    return _below(layer, placed, f"/{name}", f"/{name}/inner")


@arc
def internal_reference(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """From a prim of the same layer, which no other may be drawn from: an over."""
    source = Prim(f"{name}_library", specifier="over")
    source.children = [Prim("part", metadata=[("prepend references = ", *_target(placed))])]
    copy = Prim(name, metadata=[(f"references = </{source.name}/part>",)])
    layer = _new(scene, name, rng, [source, copy])
    return _below(layer, placed, f"/{name}")


@arc
def rate_undone(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A rate that is not 24, and a scale that undoes it for layers that say none."""
    rate = rng.choice((12, 48))  # exact scales: others USD may round to the sample before
    kind = rng.choice(("references", "payload"))
    line = (f"prepend {kind} = ", *_target(placed), f" (offset = 5; scale = {24 / rate!r})")
    placed = _composed(scene, placed, name, rng, line)
    assert placed.layer
    said = [each for each in placed.layer.metadata if RATE not in str(each[0])]
    placed.layer.metadata = [*said, (f"{RATE} = {rate}",), (UNDONE,)]
    return placed


@arc
def units_corrected(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Another up axis and other units, which a group around the reference makes up for."""
    if placed.layer and not any(UNITS in str(line[0]) for line in placed.layer.metadata):
        placed.layer.metadata += [(f"{UNITS} = 0.01",), (f'{UP_AXIS} = "Z"',)]
    inner = Prim(name, metadata=[("prepend references = ", *_target(placed))])
    group = Prim(f"{name}_turned", "Xform", children=[inner])
    ops = {"rotateX": ("float", -90), "scale": ("float3", (0.01, 0.01, 0.01))}
    group.properties = {f"xformOp:{op}": Attribute(*said) for op, said in ops.items()}
    names = [f"xformOp:{op}" for op in ops]
    group.properties["xformOpOrder"] = Attribute("token[]", names, is_uniform=True)
    layer = _new(scene, name, rng, [group])
    layer.metadata += [(f"{UNITS} = 1",), (f'{UP_AXIS} = "Y"',)]
    return _below(layer, placed, f"/{group.name}", f"/{group.name}/{name}")


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
def overridden(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """A sublayer, and stronger opinions on its root prim that change nothing of interest."""
    if placed.layer is None:
        return reference.wrap(scene, placed, name, rng)
    over = Prim(placed.root[1:], specifier="over")
    over.properties["studio:approved"] = Attribute("bool", True)
    layer = _new(scene, name, rng, [over])
    layer.metadata.append(("subLayers = [", File(placed.layer_path), "]"))
    return placed._replace(layer_path=layer.path, layer=layer)


@arc
def package(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    """Everything so far in a usdz, whose first file is the layer; what it shares goes along."""
    if placed.layer is None or scene.packages:
        return reference.wrap(scene, placed, name, rng)
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
