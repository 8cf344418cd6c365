"""What a stage is made of, as plain data that defects may change before it is written.

Unlike elsewhere these nouns are mutable: a defect is a function that changes one of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias


class File(NamedTuple):
    """A file of the scene, from its folder: it is written relative to the layer that names it."""

    path: str


SCENE = "<scene>"
"""The absolute path of the folder of a scene, in the text of its layers."""


class Expression(NamedTuple):
    """A file that a variable expression names."""

    path: str


ABSENT = object()
"""No default: an attribute may be declared only, or have time samples alone."""

Line: TypeAlias = tuple[str | File, ...]
"""A line of metadata in parts."""


@dataclass
class Attribute:
    """Values are Python's: tuples, lists, numbers, text, a `File`,
    an `Expression`, or None for a block."""

    type: str
    value: Any = ABSENT
    samples: dict[float, Any] = field(default_factory=dict)
    is_uniform: bool = False
    metadata: list[Line] = field(default_factory=list)

    def each(self) -> Iterator[Any]:
        """Every value, the default first."""
        if self.value is not ABSENT:
            yield self.value
        yield from self.samples.values()


@dataclass
class Relationship:
    """None for the targets is a block."""

    targets: list[str] | None
    is_custom: bool = False


@dataclass
class Prim:
    name: str
    type: str = ""
    specifier: str = "def"
    metadata: list[Line] = field(default_factory=list)
    properties: dict[str, Attribute | Relationship] = field(default_factory=dict)
    children: list[Prim] = field(default_factory=list)
    variants: dict[str, dict[str, list[Prim]]] = field(default_factory=dict)
    """By the name of the set and of the variant: the prims in it."""

    def attribute(self, name: str) -> Attribute:
        found = self.properties[name]
        assert isinstance(found, Attribute)
        return found

    def relationship(self, name: str) -> Relationship:
        found = self.properties[name]
        assert isinstance(found, Relationship)
        return found


def overs(path: str) -> tuple[Prim, Prim]:
    """Overs of a prim and of all above it: the topmost one, and that of the prim."""
    topmost, *names = (Prim(name, specifier="over") for name in path.split("/")[1:])
    last = topmost
    for each in names:
        last.children.append(each)
        last = each
    return topmost, last


@dataclass
class Layer:
    """The extension of `path`, from the scene's folder, decides on its format."""

    path: str
    prims: list[Prim] = field(default_factory=list)
    metadata: list[Line] = field(default_factory=list)

    def add_sublayer(self, path: str, offset: str = "") -> None:
        """The only one, so that this layer is stronger than the one at the path."""
        self.metadata.append(("subLayers = [", File(path), offset, "]"))


@dataclass
class Content:
    """Layers and files that stand in one folder, or in one package."""

    layers: list[Layer] = field(default_factory=list)
    files: dict[str, bytes | Path] = field(default_factory=dict)


@dataclass
class Scene(Content):
    """A folder, and the file in it that is linted."""

    root: str = ""
    packages: dict[str, Content] = field(default_factory=dict)


class Expected(NamedTuple):
    """What must be found of a scene: nothing, or one code at one prim, and at `others` if any.

    `also` are codes that the same defect leads to by its nature, `perhaps` those of some platforms
    only; `is_info` says that the code is no warning.
    """

    code: str | None = None
    prim: str | None = None
    also: tuple[str, ...] = ()
    perhaps: tuple[str, ...] = ()
    is_info: bool = False
    others: tuple[str, ...] = ()
