"""Something placed in a layer, and what the arcs that place it elsewhere have in common."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from random import Random
from typing import NamedTuple

from .model import Attribute, File, Layer, Line, Prim, Relationship, Scene
from .subjects import Subject, new_layer


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


Wrap = Callable[[Scene, Placed, str, Random], Placed]


@dataclass(frozen=True)
class Arc:
    """A way by its name."""

    name: str
    wrap: Wrap


def arc(wrap: Wrap) -> Arc:
    return Arc(wrap.__name__.replace("_", " "), wrap)


def where(is_possible: Callable[[Scene, Placed], bool]) -> Callable[[Wrap], Wrap]:
    """An arc that is made only there; elsewhere it is a reference."""

    def decorate(wrap: Wrap) -> Wrap:
        @wraps(wrap)
        def either(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
            chosen = wrap if is_possible(scene, placed) else wrap_in_reference
            return chosen(scene, placed, name, rng)

        return either

    return decorate


def is_layer(scene: Scene, placed: Placed) -> bool:
    """Whether it is in a layer, and not in a package."""
    return placed.layer is not None


def place(subject: Subject) -> Placed:
    """The subject in its own layer; `has_clips` is about its root prim."""
    root = f"/{subject.root.name}"
    has_clips = any("clips" in str(line[0]) for line in subject.root.metadata)
    return Placed(subject.layer.path, root, root, subject.layer, has_clips)


def offset(rng: Random) -> str:
    choices = ("", "", " (offset = 10)", " (offset = -3; scale = 2)", " (scale = 0.5)")
    return rng.choice(choices)


def target(placed: Placed) -> tuple[str | File, ...]:
    """The layer, and the prim in it unless it is the default."""
    if placed.layer and placed.layer.metadata:  # it may have a defaultPrim
        defaults = [line for line in placed.layer.metadata if "defaultPrim" in str(line[0])]
        if defaults:
            return (File(placed.layer_path),)
    return (File(placed.layer_path), f"<{placed.root}>")


def add_layer(scene: Scene, name: str, rng: Random, prims: list[Prim]) -> Layer:
    layer = new_layer(rng, name, ("usda", "usda", "usda", "usda", "usd"))
    layer.prims = prims
    if rng.random() < 0.15:
        layer.metadata.append((f"timeCodesPerSecond = {rng.choice((12, 25, 48))}",))
    scene.layers.append(layer)
    return layer


def below(layer: Layer, placed: Placed, root: str, path: str | None = None) -> Placed:
    """What was at the root is now at `path` below the prim `root` of a new layer."""
    path = path or root
    rest = placed.path[len(placed.root) :]
    return placed._replace(layer_path=layer.path, root=root, path=path + rest, layer=layer)


def composed(scene: Scene, placed: Placed, name: str, rng: Random, *lines: Line) -> Placed:
    """A prim with metadata that brings the other layer in, alone or below a group."""
    prim = Prim(name, metadata=list(lines))
    if rng.random() < 0.5:
        layer = add_layer(scene, name, rng, [prim])
        return below(layer, placed, f"/{name}")
    group = Prim(f"{name}_set", "Xform", children=[prim])
    layer = add_layer(scene, name, rng, [group])
    return below(layer, placed, f"/{group.name}", f"/{group.name}/{name}")


def wrap_in_reference(scene: Scene, placed: Placed, name: str, rng: Random) -> Placed:
    return composed(
        scene, placed, name, rng, ("prepend references = ", *target(placed), offset(rng))
    )


def referring(placed: Placed, name: str, *more: str) -> Prim:
    """A prim with a reference to what is placed."""
    return Prim(name, metadata=[("prepend references = ", *target(placed), *more)])


def instancer(name: str, child: Prim, prototype: str) -> Prim:
    """A PointInstancer that draws the prim at this path below it, which the child is or holds."""
    properties = {
        "prototypes": Relationship([f"/{name}/{prototype}"]),
        "protoIndices": Attribute("int[]", [0, 0]),
        "positions": Attribute("point3f[]", [(0, 0, 0), (5, 0, 0)]),
    }
    return Prim(name, "PointInstancer", properties=properties, children=[child])
