"""What a stage is about: Volumes and particle fields, each in a layer of its own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from random import Random
from typing import Any, NamedTuple

from .files import Source
from .model import Attribute, Content, Layer, Prim


@dataclass
class Subject:
    """A Volume or particle field below the one root prim of its layer, or as that prim.

    `layers` and `files` are what it consists of; `path` is that of `prim` in `layer`.
    """

    layer: Layer
    prim: Prim
    path: str
    content: Content = field(default_factory=Content)
    time_range: tuple[float, float] | None = None
    """What the stage must author as its range; None leaves it to the seed."""

    @property
    def root(self) -> Prim:
        return self.layer.prims[0]

    def find(self, prim: Prim) -> str:
        """The path of a prim in the layer."""
        return next(path for path, each in _paths(self.layer.prims, "") if each is prim)


@dataclass
class FieldPart:
    """A field of a Volume, and where its values are; in `clips` those that value clips hold."""

    prim: Prim
    path: str
    relationship: str
    source: Source
    clips: list[Attribute] = field(default_factory=list)

    @property
    def file_paths(self) -> list[Attribute]:
        """The attributes that hold the values of `filePath`."""
        return self.clips or [self.prim.attribute("filePath")]


class Choice(NamedTuple):
    """What kind of Volume a seed drew, or a defect asked for."""

    files: str = "static"
    place: str = "below"
    fields: int = 1
    pattern: str = "plain"
    movement: str = "none"
    twin: bool = False


@dataclass
class VolumeSubject(Subject):
    choice: Choice = field(default_factory=Choice)
    fields: list[FieldPart] = field(default_factory=list)


@dataclass
class ParticleSubject(Subject):
    count: int = 0
    degree: int = 0
    look: str = "plain"
    is_changing: bool = False
    """Whether the number of particles is another at each time."""

    def name_of(self, array: str) -> str:
        """Which of the float and half arrays is authored."""
        return next(name for name in (array, f"{array}h") if name in self.prim.properties)

    def array(self, array: str) -> Attribute:
        return self.prim.attribute(self.name_of(array))

    def lists(self, array: str) -> list[list[Any]]:
        """The values of an array, to change in place."""
        return [value for value in self.array(array).each() if value]


def new_layer(rng: Random, name: str, extensions: tuple[str, ...] = ("usda",)) -> Layer:
    folder = rng.choice(("", "lib/", "shots/fx/", "with blank/"))
    return Layer(f"{folder}{name}.{rng.choice(extensions)}")


def every_prim(prims: list[Prim]) -> Iterator[Prim]:
    """Prims and all below them, those in variants too."""
    for prim in prims:
        yield prim
        yield from every_prim(prim.children)
        for variants in prim.variants.values():
            for inside in variants.values():
                yield from every_prim(inside)


def _paths(prims: list[Prim], parent: str) -> Iterator[tuple[str, Prim]]:
    for prim in prims:
        path = f"{parent}/{prim.name}"
        yield path, prim
        yield from _paths(prim.children, path)
