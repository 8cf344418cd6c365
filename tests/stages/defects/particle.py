"""What a particle field is made of."""

from __future__ import annotations

from random import Random

from ..model import Attribute, Line
from ..particles import APIS, COEFFICIENTS, DEGREE
from ..subjects import ParticleSubject
from .declaration import on_particles

_PLAIN = {"type": "ParticleField", "arrays": True}
_SPLAT = {"type": "ParticleField3DGaussianSplat"}


def _apply(subject: ParticleSubject, *apis: str) -> None:
    names = ", ".join(f'"{api}"' for api in apis)
    line: Line = (f"prepend apiSchemas = [{names}]",)
    kept = [each for each in subject.prim.metadata if "apiSchemas" not in str(each[0])]
    subject.prim.metadata = [*kept, line]


def _without(word: str) -> list[str]:
    return [api for api in APIS if word not in api]


def _remove(subject: ParticleSubject, array: str) -> None:
    subject.prim.properties.pop(subject.name_of(array))


@on_particles("PRT001", needs=_PLAIN)
def no_positions(subject: ParticleSubject, rng: Random) -> None:
    _apply(subject, *_without("Position"))
    _remove(subject, "positions")


@on_particles("PRT002", needs=_PLAIN)
def no_kernel(subject: ParticleSubject, rng: Random) -> None:
    _apply(subject, *_without("Kernel"))


@on_particles("PRT003", needs=_PLAIN)
def no_radiance(subject: ParticleSubject, rng: Random) -> None:
    _apply(subject, *_without("SphericalHarmonics"))
    _remove(subject, COEFFICIENTS)
    subject.prim.properties.pop(DEGREE, None)


@on_particles("PRT004", needs=_PLAIN)
def kernel_base_alone(subject: ParticleSubject, rng: Random) -> None:
    _apply(subject, *_without("Kernel"), "ParticleFieldKernelBaseAPI")


@on_particles("PRT005", needs=_SPLAT)
def second_kernel(subject: ParticleSubject, rng: Random) -> None:
    _apply(subject, "ParticleFieldKernelGaussianSurfletAPI")


@on_particles("PRT006", needs=_SPLAT)
def api_misspelt(subject: ParticleSubject, rng: Random) -> None:
    names = ("ParticleFieldOpacitiesAttributeAPI", "ParticleFieldScaleAttributesAPI")
    _apply(subject, rng.choice(names))


@on_particles("PRT007", needs=_PLAIN)
def opacities_without_api(subject: ParticleSubject, rng: Random) -> None:
    _apply(subject, *_without("Opacity"))


@on_particles("PRT007", needs=_PLAIN)
def scales_without_api(subject: ParticleSubject, rng: Random) -> None:
    _apply(subject, *_without("Scale"))
    assert isinstance(subject.array("scales"), Attribute)


@on_particles("PRT009", needs=_PLAIN)
def api_doubled(subject: ParticleSubject, rng: Random) -> None:
    """In a text layer: a crate is written from what USD read, without the list."""
    subject.layer.path = subject.layer.path.replace(".usdc", ".usda")
    _apply(subject, *APIS, rng.choice(APIS))
