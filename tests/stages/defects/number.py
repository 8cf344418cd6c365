"""What the numbers in the arrays of a particle field say, all of them valid."""

from __future__ import annotations

from math import exp
from random import Random

from ..looks import hide_below
from ..model import Attribute, Prim
from ..particles import COEFFICIENTS
from ..subjects import ParticleSubject
from .declaration import on_particles

_ALL = {"arrays": True, "count": 32, "changing": False}
_FLOAT = {**_ALL, "precision": "float"}
_HALF = {**_ALL, "precision": "half"}
_CHANGING = {"animated": True, "changing": True, "count": 24}
_ARRAYS = ("positions", "orientations", "scales", "opacities", COEFFICIENTS)


@on_particles("ARR001", needs={**_FLOAT, **_CHANGING})
def born_later(subject: ParticleSubject, rng: Random) -> None:
    for name in _ARRAYS:
        samples = subject.array(name).samples
        samples[min(samples)] = rng.choice(([], None))


@on_particles("ARR018", needs={**_HALF, **_CHANGING}, is_info=True)
def opacities_come_later(subject: ParticleSubject, rng: Random) -> None:
    born_later.make(subject, rng)
    opacities = subject.prim.properties.pop("opacitiesh")
    assert isinstance(opacities, Attribute)
    opacities.type = "float[]"
    subject.prim.properties["opacities"] = opacities


@on_particles("ARR019", needs=_ALL)
def exp_of_exp(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("positions"):
        values[:] = [tuple(number / 4 for number in place) for place in values]
    for values in subject.lists("scales"):
        values[:] = [tuple(exp(exp(rng.uniform(-6, -2.5))) for _ in range(3)) for _ in values]
        values[0] = (exp(exp(-2)),) * 3  # one is always far from the others


@on_particles("ARR019", needs=_ALL)
def sigmoid_of_sigmoid(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("opacities"):
        values[:] = [0.505, 0.73, *(rng.uniform(0.5, 0.73) for _ in values[2:])]


@on_particles("ARR019", needs=_ALL)
def sigmoid_of_ones(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("opacities"):
        values[:] = [0.7310586] * len(values)


@on_particles("ARR023", needs=_ALL)
def bytes_of_colours(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists(COEFFICIENTS):
        values[:] = [tuple(rng.randint(0, 255) for _ in range(3)) for _ in values]
        values[0] = (200, 100, 0)


@on_particles("ARR024", needs={**_ALL, "count": 1000, "degree": 0}, is_info=True)
def scales_of_another_unit(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("positions"):
        values[:] = [(index / 500 - 1, index % 10 / 10, 0) for index in range(len(values))]
    for values in subject.lists("scales"):
        values[:] = [tuple(rng.uniform(0.9, 1) for _ in range(3)) for _ in values]
    corners = [(-4, -4, -4), (4, 4, 4)]
    subject.prim.properties["extent"] = Attribute("float3[]", corners)


@on_particles("ARR020", needs=_HALF)
def halfs_far_away(subject: ParticleSubject, rng: Random) -> None:
    _move(subject, 200.0, 0.002)


@on_particles("ARR020", needs=_FLOAT)
def floats_of_a_map(subject: ParticleSubject, rng: Random) -> None:
    _move(subject, 5_400_000.0, 0.02)


@on_particles("ARR020", needs=_HALF, is_info=True)
def halfs_too_near(subject: ParticleSubject, rng: Random) -> None:
    _move(subject, 200.0, 0.1)


def _move(subject: ParticleSubject, origin: float, scale: float) -> None:
    """Moves the particles, a unit apart, along x, and gives all of them this size."""
    for values in subject.lists("positions"):
        values[:] = [(origin + index, 0.5, 0.5) for index in range(len(values))]
    for values in subject.lists("scales"):
        values[:] = [(scale, scale, scale)] * len(values)
    corners = [(origin - 2, -2, -2), (origin + 50, 2, 2)]
    subject.prim.properties["extent"] = Attribute("float3[]", corners)


@on_particles("ARR025", needs={**_ALL, "animated": True, "changing": False})
def positions_held(subject: ParticleSubject, rng: Random) -> Prim:
    positions = subject.array("positions")
    first = next(iter(positions.samples.values()))
    return hide_below(
        subject, subject.path, subject.name_of("positions"), Attribute(positions.type, first)
    )


@on_particles("ARR025", needs=_ALL, is_info=True)
def opacities_held(subject: ParticleSubject, rng: Random) -> Prim:
    opacities = subject.array("opacities")
    value = subject.lists("opacities")[0]
    opacities.samples = {1: value, 2: [0.25 for _ in value]}
    return hide_below(
        subject, subject.path, subject.name_of("opacities"), Attribute(opacities.type, value)
    )


@on_particles("SCH017", needs=_ALL, is_info=True)
def extent_held(subject: ParticleSubject, rng: Random) -> Prim:
    extent = subject.prim.attribute("extent")
    corners = extent.value
    extent.samples = {1: corners, 2: [(-2, -2, -2), (2, 2, 2.5)]}
    return hide_below(subject, subject.path, "extent", Attribute("float3[]", corners))


@on_particles("ARR021", needs={**_ALL, "type": "ParticleField", "kernel": "flat"}, is_info=True)
def surflets_all_alike(subject: ParticleSubject, rng: Random) -> None:
    del subject.prim.properties[subject.name_of("orientations")]


@on_particles("ARR022", needs=_ALL, is_info=True)
def one_kernel_outside(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("scales"):
        values[3] = (3.0, 3.0, 3.0)
    for values in subject.lists("opacities"):
        values[3] = 1


@on_particles("ARR026", needs={**_ALL, "animated": True}, is_info=True)
def positions_blocked_for_a_frame(subject: ParticleSubject, rng: Random) -> None:
    samples = subject.array("positions").samples
    samples[sorted(samples)[1]] = None


@on_particles("ARR027", needs={**_ALL, "animated": True})
def particle_range_elsewhere(subject: ParticleSubject, rng: Random) -> None:
    subject.time_range = (1_000_000, 1_000_100)
