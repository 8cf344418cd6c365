"""What a stronger opinion takes away, and what it fails to say."""

from __future__ import annotations

from random import Random

from ..model import Prim
from ..subjects import ParticleSubject, Subject
from .declaration import ONE_FILE, VolumeSubject, any_field, on_particles, on_volume


def _hide(subject: Subject, prim: Prim, rng: Random) -> None:
    """The prim's own type comes from a class, and it says another."""
    source = Prim(f"_class_{prim.name}", prim.type, specifier="class")
    subject.layer.prims.append(source)
    prim.metadata.append((f"{rng.choice(('inherits', 'specializes'))} = </{source.name}>",))
    prim.type = rng.choice(("Xform", "Scope"))


@on_volume("SCH012")
def volume_hidden(subject: VolumeSubject, rng: Random) -> None:
    subject.root.children = [
        child for child in subject.root.children if not child.name.endswith("_twin")
    ]
    _hide(subject, subject.prim, rng)


@on_volume("SCH012", needs=ONE_FILE)
def field_hidden(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    _hide(subject, prim, rng)
    return prim


@on_particles("SCH012")
def splat_hidden(subject: ParticleSubject, rng: Random) -> None:
    _hide(subject, subject.prim, rng)
