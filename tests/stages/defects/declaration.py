"""How a defect is declared: what it is made on, and what must be found of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random
from typing import Any

from ..files import shared
from ..model import Attribute, File, Layer, Prim, Scene
from ..subjects import FieldPart, ParticleSubject, VolumeSubject

Make = Callable[..., Prim | list[Prim] | None]


@dataclass(frozen=True)
class Defect:
    """Changes one thing of a subject, or of the root layer of a scene.

    `make` gets the subject, or the scene and its root layer, and the random numbers; it returns
    the prim that the finding is at, the prims if each has one, None for that of the subject, or for
    none on a scene.
    `needs` is what the subject has to be like, see `volumes.choose` and `particles.particles`;
    `without` are arcs that would hide the defect or add to it, and `within`
    names one that it needs.  `also` are codes that it leads to
    by its nature, `perhaps` those that it leads to on some platforms, and `is_info` says that the
    finding is no warning.  `title` is what it is called in its module.
    """

    code: str
    on: str
    make: Make
    needs: dict[str, Any] = field(default_factory=dict)
    also: tuple[str, ...] = ()
    perhaps: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    within: str | None = None
    is_info: bool = False
    title: str = ""

    @property
    def name(self) -> str:
        return f"{self.code} {self.title.replace('_', ' ')}"


def on_volume(code: str, **declared: Any) -> Callable[[Make], Defect]:
    return lambda make: Defect(code, "volume", make, **declared)


def on_particles(code: str, **declared: Any) -> Callable[[Make], Defect]:
    return lambda make: Defect(code, "particles", make, **declared)


def on_scene(code: str, **declared: Any) -> Callable[[Make], Defect]:
    return lambda make: Defect(code, "scene", make, **declared)


ONE_FILE = {"files": ("static", "several")}
"""A field that names one file for all times, an OpenVDB one."""

A_RUN = {"files": "own sequence"}
"""Time samples for seven frames at least."""


def any_field(subject: VolumeSubject, rng: Random) -> FieldPart:
    return rng.choice(subject.fields)


def extent_for_all(subject: VolumeSubject) -> None:
    """An extent that no grid reaches out of."""
    corners = [(-1e5, -1e5, -1e5), (1e5, 1e5, 1e5)]
    subject.prim.properties["extent"] = Attribute("float3[]", corners)


def field_of(subject: VolumeSubject, rng: Random, path: str, **said: Any) -> Prim:
    """A field that names this shared file, and says this of its grid."""
    extent_for_all(subject)
    prim = any_field(subject, rng).prim
    types = {"fieldIndex": "int"}
    prim.properties = {
        name: Attribute(types.get(name, "token"), value) for name, value in said.items()
    }
    prim.properties["filePath"] = Attribute("asset", File(shared(path)))
    return prim


def naming(code: str, path: str, is_info: bool = False, **said: Any) -> Defect:
    """A field that names this shared file, and says this of its grid."""

    def make(subject: VolumeSubject, rng: Random) -> Prim:
        return field_of(subject, rng, path, **said)

    return on_volume(code, needs=ONE_FILE, is_info=is_info)(make)


__all__ = [
    "A_RUN",
    "ONE_FILE",
    "Defect",
    "Layer",
    "ParticleSubject",
    "Prim",
    "Scene",
    "VolumeSubject",
    "any_field",
    "extent_for_all",
    "field_of",
    "naming",
    "on_particles",
    "on_scene",
    "on_volume",
]
