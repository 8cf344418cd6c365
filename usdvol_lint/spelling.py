"""The name of UsdVol that an undeclared one is probably a misspelling of."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

from usdvol_lint.nearest import CLOSE, closest_match, is_one_slip_from
from usdvol_lint.schema import API_ATTRIBUTES, API_INCLUDES, CONCRETE_TYPES, POSITION_BASE

PRE_STANDARD_TYPES: dict[str, str] = {
    "ParticleField_3DGaussianSplat": "ParticleField3DGaussianSplat",
    "ParticleField3DGS": "ParticleField3DGaussianSplat",
    "GaussianSplat": "ParticleField3DGaussianSplat",
    "GaussianSplats": "ParticleField3DGaussianSplat",
    "Gaussians": "ParticleField3DGaussianSplat",
    "LightField": "ParticleField",
    "OpenVDB": "OpenVDBAsset",
    "OpenVDBField": "OpenVDBAsset",
    "OpenVDBFieldAsset": "OpenVDBAsset",
    "VDBAsset": "OpenVDBAsset",
    "Field3D": "Field3DAsset",
}
"""Type names that were used before the schema was released, or are guessed, and today's."""

PRE_STANDARD_APIS: dict[str, str] = {
    "GaussianShapeAPI": "ParticleFieldKernelGaussianEllipsoidAPI",
    "GaussianFalloffFunctionAPI": "ParticleFieldKernelGaussianEllipsoidAPI",
    "PositionBaseAPI": POSITION_BASE,
    "PositionAttributeAPI": "ParticleFieldPositionAttributeAPI",
    "OrientationAttributeAPI": "ParticleFieldOrientationAttributeAPI",
    "ScaleAttributeAPI": "ParticleFieldScaleAttributeAPI",
    "OpacityAttributeAPI": "ParticleFieldOpacityAttributeAPI",
    "SphericalHarmonicsAttributeAPI": "ParticleFieldSphericalHarmonicsAttributeAPI",
    "ParticleFieldOpacitiesAttributeAPI": "ParticleFieldOpacityAttributeAPI",
    **{api.replace("ParticleField", "LightField"): api for api in API_INCLUDES},
    **{api.replace("Attribute", ""): api for api in API_ATTRIBUTES},
}
"""API names that were used before the schema was released, or are guessed, and today's."""

GUESSED_ATTRIBUTES: dict[str, str] = {
    "file": "filePath",
    "fileName": "filePath",
    "gridName": "fieldName",
    "gridIndex": "fieldIndex",
    "dataType": "fieldDataType",
    "gridClass": "fieldClass",
    "points": "positions",
    "rotations": "orientations",
    "opacity": "opacities",
    "particleField:positionAttr": "positions",
    "particleField:orientationAttr": "orientations",
    "particleField:scaleAttr": "scales",
    "particleField:opacityAttr": "opacities",
    "particleField:shAttr": "radiance:sphericalHarmonicsCoefficients",
    "shCoeffs": "radiance:sphericalHarmonicsCoefficients",
    "shDegree": "radiance:sphericalHarmonicsDegree",
}
"""Guessed attribute names that are too unlike the right one to be found by similarity."""

GUESSED_TOKENS: dict[str, dict[str, str]] = {
    "fieldClass": {"sdf": "levelSet", "fog": "fogVolume"},
    "fieldDataType": {
        **dict.fromkeys(("float16", "f16", "fp16"), "half"),
        **dict.fromkeys(("float32", "f32", "fp32", "scalar"), "float"),
        **dict.fromkeys(("float64", "f64", "fp64"), "double"),
        **dict.fromkeys(("int32", "i32", "integer"), "int"),
        **dict.fromkeys(("uint32", "u32"), "uint"),
        **dict.fromkeys(("i64", "long"), "int64"),
        **dict.fromkeys(("vec3h", "vector3h"), "half3"),
        **dict.fromkeys(("vec3f", "vec3s", "vector3f", "point3f", "normal3f", "color3f"), "float3"),
        **dict.fromkeys(("vec3d", "vector3d", "point3d", "normal3d", "color3d"), "double3"),
        "vec3i": "int3",
        "vec2h": "half2",
        **dict.fromkeys(("vec2f", "vec2s"), "float2"),
        "vec2d": "double2",
        "vec2i": "int2",
        "boolean": "bool",
    },
    "vectorDataRoleHint": {"colour": "Color"},
    "visibility": {
        **dict.fromkeys(("hidden", "off", "none"), "invisible"),
        **dict.fromkeys(("visible", "on"), "inherited"),
    },
    "sortingModeHint": {"depth": "zDepth", "distance": "cameraDistance"},
}
"""For each attribute tokens of other libraries, folded, and its own for the same."""

_LONG_NAME = 10
_VERSION = re.compile(r"(.*?)_?v?[0-9]+")


def misspelt_type(name: str) -> str | None:
    """The type of UsdVol that an unregistered type name is probably a misspelling of."""
    near = PRE_STANDARD_TYPES.get(name) or closest_name(name, CONCRETE_TYPES)
    return near or next(
        (other for other in sorted(CONCRETE_TYPES) if _is_one_slip(name, other)), None
    )


def is_slip(name: str, meant: str) -> bool:
    """Whether a type name is near-certainly another one: but for case, a plural or few letters.

    A few letters are two in a name of ten or more, and one in a shorter one; digits are none.
    """
    allowed = 2 if len(meant) >= _LONG_NAME else 1
    same_digits = _digits(name) == _digits(meant)
    return same_digits and _letters_apart(name.lower(), meant.lower()) <= allowed


def versioned_type(name: str) -> str | None:
    """The type of UsdVol that a type name is followed by a number of, as `OpenVDBAssetV2` is."""
    types = {other.lower(): other for other in CONCRETE_TYPES}
    version = _VERSION.fullmatch(name.lower())
    return types.get(version[1]) if version else None


def misspelt_api(name: str) -> str | None:
    """The API of UsdVol that an unregistered API name is probably a misspelling of.

    These names share most of their letters, also with those of third parties, so one has to be
    right but for a letter or two.
    """
    return PRE_STANDARD_APIS.get(name) or closest_name(name, tuple(API_INCLUDES), cutoff=0.95)


def misspelt_attribute(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate that an undeclared attribute name is probably a misspelling of.

    A namespaced name is compared only with namespaced candidates, and a primvar with none.
    A candidate with a word appended, `opacitiesMax`, is no misspelling.
    """
    names = frozenset(candidates)
    folded = _fold(name)
    for guessed, right in GUESSED_ATTRIBUTES.items():
        if folded == _fold(guessed):
            return right if right in names else None
    if name.startswith("primvars:"):
        return None
    if ":" in name:
        names = frozenset(candidate for candidate in names if ":" in candidate)
    if any(name.startswith(other) and name[len(other) :][:1].isupper() for other in names):
        return None
    return closest_name(name, names, cutoff=0.81)


def is_certainly_misspelt(name: str, meant: str) -> bool:
    """Whether an attribute name is a usual guess, or one slip of the hand from what was meant."""
    guesses = (_fold(guessed) for guessed, right in GUESSED_ATTRIBUTES.items() if right == meant)
    return is_one_slip_from(name, meant) or _fold(name) in {_fold(meant), *guesses}


def is_alike(one: str, other: str) -> bool:
    """Whether two value types are both arrays or both not, and both of text or both of numbers."""
    return _array_and_text(one) == _array_and_text(other)


@lru_cache(maxsize=1024)
def misspelt_token(attribute: str, token: str, allowed: tuple[str, ...]) -> str | None:
    """The allowed token that another one is probably a misspelling of.

    OpenVDB's own names are understood too: `GRID_FOG_VOLUME`, `Tree_float_5_4_3`, `vec3s`.
    """
    folded = _fold(token).removeprefix("grid")
    if folded.startswith("tree"):
        folded = folded.removeprefix("tree").rstrip("0123456789") or folded
    guess = GUESSED_TOKENS.get(attribute, {}).get(folded)
    return guess if guess in allowed else closest_name(folded, frozenset(allowed), cutoff=0.8)


@lru_cache(maxsize=1024)
def closest_name(
    name: str, candidates: tuple[str, ...] | frozenset[str], cutoff: float = CLOSE
) -> str | None:
    """The candidate that `name` is most likely a misspelling of, if one is close enough.

    A name with digits is compared only with candidates that have the same digits: a 2D splat is no
    misspelt 3D splat.
    `cutoff` is as for `nearest.closest_match`.
    """
    digits = _digits(name)
    comparable = (other for other in sorted(candidates) if digits in ("", _digits(other)))
    return closest_match(name, comparable, cutoff, _fold)


def _is_one_slip(name: str, other: str) -> bool:
    return is_one_slip_from(name.lower(), other.lower())


def _letters_apart(one: str, other: str) -> int:
    """How many letters have to be added, removed or replaced to make one word of the other."""
    costs = list(range(len(other) + 1))
    for row, letter in enumerate(one, start=1):
        diagonal, costs[0] = costs[0], row
        for column, wanted in enumerate(other, start=1):
            cheapest = min(costs[column] + 1, costs[column - 1] + 1, diagonal + (letter != wanted))
            diagonal, costs[column] = costs[column], cheapest
    return costs[-1]


def _array_and_text(type_name: str) -> tuple[bool, bool]:
    """Whether a value type is an array, and whether it is of text."""
    scalar = type_name.removesuffix("[]")
    return scalar != type_name, scalar in ("asset", "string", "token")


def _fold(name: str) -> str:
    """The name in lower case, without separators and the prefix of C++, `UsdVol`."""
    for separator in "_-: ":
        name = name.replace(separator, "")
    return name.lower().removeprefix("usdvol")


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))
