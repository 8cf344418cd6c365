"""Particle fields that are right, of every kind that a seed can draw."""

from __future__ import annotations

from math import sqrt
from random import Random
from typing import Any

from . import looks
from .model import ABSENT, Attribute, Prim, Relationship
from .subjects import ParticleSubject, new_layer

APIS = (
    "ParticleFieldPositionAttributeAPI",
    "ParticleFieldOrientationAttributeAPI",
    "ParticleFieldScaleAttributeAPI",
    "ParticleFieldOpacityAttributeAPI",
    "ParticleFieldKernelGaussianEllipsoidAPI",
    "ParticleFieldSphericalHarmonicsAttributeAPI",
)
KERNELS = (
    "ParticleFieldKernelGaussianEllipsoidAPI",
    "ParticleFieldKernelGaussianSurfletAPI",
    "ParticleFieldKernelConstantSurfletAPI",
)
COEFFICIENTS = "radiance:sphericalHarmonicsCoefficients"
DEGREE = "radiance:sphericalHarmonicsDegree"

_ARRAYS = {
    "positions": ("point3f[]", "point3h[]"),
    "orientations": ("quatf[]", "quath[]"),
    "scales": ("float3[]", "half3[]"),
    "opacities": ("float[]", "half[]"),
    COEFFICIENTS: ("float3[]", "half3[]"),
}


LOOKS = ("plain", "material", "colour space", "empty twins", "held", *looks.LOOKS)
"""What else there is: a bound material, the name of a colour space, arrays of the other precision
that are empty, arrays that hold one value at all their times, and those of `looks`."""


def particles(rng: Random, name: str, needs: dict[str, Any]) -> ParticleSubject:
    """A particle field, right in every way that the rules know of.

    `needs` may ask for `"type"`, `"precision"`, `"animated"`, `"changing"`, `"degree"`, `"count"`
    and a flat `"kernel"`, and for all optional `"arrays"`.
    """
    layer = new_layer(rng, name, ("usda", "usda", "usdc"))
    type_name = rng.choice(("ParticleField3DGaussianSplat",) * 3 + ("ParticleField",))
    type_name = needs.get("type", type_name)
    prim = Prim(f"{name}_splat", type_name)
    layer.prims = [prim if rng.random() < 0.3 else Prim(name, "Xform", children=[prim])]
    path = f"/{prim.name}" if layer.prims[0] is prim else f"/{name}/{prim.name}"
    count = needs.get("count") or rng.choice((1, 2, 3, 5, 12))
    degree = needs.get("degree", rng.randint(0, 3))
    subject = ParticleSubject(layer, prim, path, count=count, degree=degree)
    subject.content.layers.append(layer)
    if type_name == "ParticleField":
        kernels = KERNELS[1:] if needs.get("kernel") == "flat" else KERNELS
        applied = [api for api in APIS if "Kernel" not in api] + [rng.choice(kernels)]
        apply(prim, *applied)
    prim.properties["extent"] = Attribute("float3[]", [(-2, -2, -2), (2, 2, 2)])
    _add_arrays(subject, rng, needs)
    _add_radiance(subject, rng)
    subject.look = needs.get("look") or rng.choice(("plain", *LOOKS))
    _add_look(subject)
    _decorate(subject, rng)
    if change := looks.LOOKS.get(subject.look):
        change(subject)
    return subject


def _add_arrays(subject: ParticleSubject, rng: Random, needs: dict[str, Any]) -> None:
    precision = needs.get("precision") or rng.choice(("float", "half", "mixed"))
    times = [1, 2, 3.5] if needs.get("animated", rng.random() < 0.4) else []
    subject.is_changing = bool(times) and needs.get("changing", rng.random() < 0.3)
    counts = {
        time: subject.count + 2 * subject.is_changing * index for index, time in enumerate(times)
    }
    is_optional = "arrays" not in needs
    for name, types in _ARRAYS.items():
        if is_optional and name not in ("positions", COEFFICIENTS) and rng.random() < 0.1:
            continue
        is_half = precision == "half" or (precision == "mixed" and rng.random() < 0.5)
        attribute = Attribute(types[is_half])
        if times and (name == "positions" or subject.is_changing or rng.random() < 0.5):
            attribute.samples = {
                time: _elements(name, count, subject.degree, rng) for time, count in counts.items()
            }
        else:
            attribute.value = _elements(name, subject.count, subject.degree, rng)
        subject.prim.properties[f"{name}{'h' * is_half}"] = attribute


def _elements(name: str, count: int, degree: int, rng: Random) -> list[Any]:
    """One element for each particle; for coefficients as many as the degree asks for."""
    if name == "positions":
        return [(round(number / 16, 4), *_numbers(rng, -1, 1, 2)) for number in range(count)]
    if name == "orientations":
        return [_quaternion(rng) for _ in range(count)]
    if name == "scales":
        return [_numbers(rng, 0.01, 0.5, 3) for _ in range(count)]
    if name == "opacities":
        return [rng.choice((1, 1, *_numbers(rng, 0.1, 1, 2))) for _ in range(count)]
    each = (degree + 1) ** 2
    return [_numbers(rng, -0.5, 0.9, 3) for _ in range(count * each)]


def _numbers(rng: Random, low: float, high: float, count: int) -> tuple[float, ...]:
    return tuple(round(rng.uniform(low, high), 4) for _ in range(count))


def _quaternion(rng: Random) -> tuple[float, ...]:
    if rng.random() < 0.2:
        return (1, 0, 0, 0)
    parts = [rng.uniform(0.1, 1) for _ in range(4)]
    length = sqrt(sum(part * part for part in parts))
    return tuple(round(part / length, 6) for part in parts)


def _add_radiance(subject: ParticleSubject, rng: Random) -> None:
    if subject.degree != 3 or rng.random() < 0.7:  # 3 is what USD falls back to
        degree = Attribute("int", subject.degree, is_uniform=True)
        subject.prim.properties[DEGREE] = degree
    if rng.random() < 0.3:
        size = (subject.degree + 1) ** 2
        coefficients = subject.array(COEFFICIENTS)
        coefficients.metadata += [(f"elementSize = {size}",), ('interpolation = "vertex"',)]


def _add_look(subject: ParticleSubject) -> None:
    properties = subject.prim.properties
    if subject.look == "material":
        subject.prim.children.append(Prim("look", "Material"))
        properties["material:binding"] = Relationship([f"{subject.path}/look"])
        apply(subject.prim, "MaterialBindingAPI")
    elif subject.look == "colour space":
        apply(subject.prim, "ColorSpaceAPI")
        properties["colorSpace:name"] = Attribute("token", "g22_rec709_scene", is_uniform=True)
    elif subject.look == "empty twins":
        for name, types in _ARRAYS.items():
            for twin, kind in zip((name, f"{name}h"), types, strict=True):
                properties.setdefault(twin, Attribute(kind, []))
    elif subject.look == "held":
        scales = properties.get("scales") or properties.get("scalesh")
        if isinstance(scales, Attribute) and not scales.samples:
            scales.samples = dict.fromkeys((1, 2, 3.5), scales.value)


def apply(prim: Prim, *apis: str) -> None:
    """Applies APIs besides those that are applied already."""
    applied = [line for line in prim.metadata if "apiSchemas" in str(line[0])]
    known = [api for line in applied for api in str(line[0]).split('"')[1::2]]
    names = ", ".join(f'"{api}"' for api in (*known, *apis))
    kept = [line for line in prim.metadata if line not in applied]
    prim.metadata = [*kept, (f"prepend apiSchemas = [{names}]",)]


def _decorate(subject: ParticleSubject, rng: Random) -> None:
    properties = subject.prim.properties
    if subject.prim.type == "ParticleField3DGaussianSplat":
        for name, tokens in (
            ("projectionModeHint", ("perspective", "tangential")),
            ("sortingModeHint", ("zDepth", "cameraDistance", "rayHitDistance")),
        ):
            if rng.random() < 0.3:
                properties[name] = Attribute("token", rng.choice(tokens), is_uniform=True)
    if rng.random() < 0.2:
        coefficients = subject.array(COEFFICIENTS)
        coefficients.metadata.append(('colorSpace = "lin_rec709_scene"',))
    if rng.random() < 0.2:
        values = subject.array("positions")
        if values.value is not ABSENT:
            ids = Attribute("int[]", list(range(subject.count)))
            properties["primvars:ids"] = ids
