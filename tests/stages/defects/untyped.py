"""Prims that lack the type for what they hold."""

from __future__ import annotations

from random import Random

from ..subjects import ParticleSubject
from .declaration import VolumeSubject, on_particles, on_volume

_TYPES = ("", "Xform", "Scope")


@on_volume("SCH014", needs={"movement": "none"})
def volume_without_its_type(subject: VolumeSubject, rng: Random) -> None:
    subject.root.children = [
        child for child in subject.root.children if not child.name.endswith("_twin")
    ]
    subject.prim.type = rng.choice(_TYPES)


@on_particles("SCH014", needs={"arrays": True, "type": "ParticleField3DGaussianSplat"})
def splat_without_its_type(subject: ParticleSubject, rng: Random) -> None:
    subject.prim.type = rng.choice(_TYPES)
