"""What the arrays of a particle field hold."""

from __future__ import annotations

from random import Random

from ..model import Attribute
from ..particles import COEFFICIENTS, DEGREE
from ..subjects import ParticleSubject
from .declaration import on_particles

_ALL = {"arrays": True, "count": 12}
_FLOAT = {**_ALL, "precision": "float"}


def _one(subject: ParticleSubject, array: str, rng: Random) -> list[object]:
    """The value of an array at one of its times."""
    return rng.choice(subject.lists(array))


@on_particles("ARR001", needs=_ALL)
def no_particles(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("positions"):
        values.clear()
    for array in ("orientations", "scales", "opacities", COEFFICIENTS):
        del subject.prim.properties[subject.name_of(array)]


@on_particles("ARR002", needs=_ALL)
def too_short(subject: ParticleSubject, rng: Random) -> None:
    _one(subject, rng.choice(("orientations", "scales", "opacities")), rng).pop()


@on_particles("ARR003", needs=_ALL)
def too_long(subject: ParticleSubject, rng: Random) -> None:
    values = _one(subject, rng.choice(("orientations", "scales", "opacities")), rng)
    values.append(values[0])


@on_particles("ARR004", needs={**_ALL, "degree": (0, 1, 2, 3)})
def one_coefficient_too_few(subject: ParticleSubject, rng: Random) -> None:
    _one(subject, COEFFICIENTS, rng).pop()


@on_particles("ARR004", needs={**_ALL, "degree": 0})
def colours_without_degree(subject: ParticleSubject, rng: Random) -> None:
    del subject.prim.properties[DEGREE]
    subject.array(COEFFICIENTS).metadata.clear()


@on_particles("ARR005", needs=_ALL)
def degree_negative(subject: ParticleSubject, rng: Random) -> None:
    subject.prim.properties[DEGREE] = Attribute("int", -1, is_uniform=True)
    subject.array(COEFFICIENTS).metadata.clear()


@on_particles("ARR006", needs={**_ALL, "degree": 4}, is_info=True)
def degree_four(subject: ParticleSubject, rng: Random) -> None:
    pass


@on_particles("ARR007", needs=_FLOAT)
def nan(subject: ParticleSubject, rng: Random) -> None:
    array = rng.choice(("positions", "scales", "opacities", "orientations", COEFFICIENTS))
    values = _one(subject, array, rng)
    place = rng.randrange(len(values))
    old = values[place]
    bad = rng.choice((float("nan"), float("inf")))
    values[place] = (bad, *old[1:]) if isinstance(old, tuple) else bad


@on_particles("ARR007", needs={**_ALL, "precision": "half"})
def half_overflow(subject: ParticleSubject, rng: Random) -> None:
    values = _one(subject, "scales", rng)
    values[3] = (70000.0, 1, 1)


@on_particles("ARR008", needs=_ALL)
def logits(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("opacities"):
        values[:] = [round(rng.uniform(-6, 6), 3) for _ in values]
        values[0] = -4.5


@on_particles("ARR008", needs=_ALL)
def one_opacity_above(subject: ParticleSubject, rng: Random) -> None:
    _one(subject, "opacities", rng)[7] = rng.choice((1.5, -0.2))


@on_particles("ARR009", needs=_ALL)
def logarithms(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("scales"):
        values[:] = [(-4.5, -3.1, round(rng.uniform(-7, -1), 3)) for _ in values]


@on_particles("ARR009", needs=_ALL)
def one_scale_negative(subject: ParticleSubject, rng: Random) -> None:
    _one(subject, "scales", rng)[2] = (0.1, -0.1, 0.1)


@on_particles("ARR010", needs=_ALL)
def no_length(subject: ParticleSubject, rng: Random) -> None:
    _one(subject, "orientations", rng)[4] = (0, 0, 0, 0)


@on_particles("ARR011", needs=_ALL)
def not_unit(subject: ParticleSubject, rng: Random) -> None:
    _one(subject, "orientations", rng)[5] = (1, 1, 0.5, 0)


@on_particles("ARR012", needs=_FLOAT, is_info=True)
def half_beside_float(subject: ParticleSubject, rng: Random) -> None:
    opacities = subject.array("opacities")
    copy = Attribute("half[]", opacities.value, dict(opacities.samples))
    subject.prim.properties["opacitiesh"] = copy


@on_particles("ARR012", needs=_FLOAT)
def half_of_another_size(subject: ParticleSubject, rng: Random) -> None:
    subject.prim.properties["scalesh"] = Attribute("half3[]", [(1, 1, 1)])


@on_particles("ARR013", needs=_ALL)
def one_outside(subject: ParticleSubject, rng: Random) -> None:
    _one(subject, "positions", rng)[9] = (0.1, 5, 0.3)


@on_particles("ARR014", needs=_ALL)
def many_invisible(subject: ParticleSubject, rng: Random) -> None:
    for values in subject.lists("opacities"):
        values[:4] = [0] * 4


@on_particles("ARR014", needs={**_ALL, "degree": 0})
def many_that_are_one(subject: ParticleSubject, rng: Random) -> None:
    for name in ("positions", "orientations", "scales", "opacities", COEFFICIENTS):
        for values in subject.lists(name):
            values[:5] = [values[0]] * 5
    subject.prim.properties.pop("primvars:ids", None)  # which tell particles apart


@on_particles("ARR015", needs=_ALL, is_info=True)
def element_size_of_another(subject: ParticleSubject, rng: Random) -> None:
    subject.array(COEFFICIENTS).metadata[:] = [("elementSize = 2",)]


@on_particles("ARR016", needs={**_ALL, "type": "ParticleField3DGaussianSplat"})
def colour_space_unknown(subject: ParticleSubject, rng: Random) -> None:
    subject.prim.metadata.append(('prepend apiSchemas = ["ColorSpaceAPI"]',))
    name = Attribute("token", "srgb_rec709_display", is_uniform=True)
    subject.prim.properties["colorSpace:name"] = name
    coefficients = subject.array(COEFFICIENTS)
    coefficients.metadata[:] = [
        line for line in coefficients.metadata if "colorSpace" not in str(line[0])
    ]


@on_particles("ARR017", needs=_ALL)
def no_coefficients(subject: ParticleSubject, rng: Random) -> None:
    del subject.prim.properties[subject.name_of(COEFFICIENTS)]
