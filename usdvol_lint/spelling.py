"""Guesses at what was meant by a name that no schema of UsdVol declares."""

from __future__ import annotations

from collections.abc import Iterable

from usdvol_lint.nearest import CLOSE, closest_match
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
"""Type names from before the schema was released, or from guesswork, and what is meant."""

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
"""API names from before the schema was released, or from guesswork, and what is meant."""

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
"""Attribute names from guesswork that no likeness gives away, and what is meant."""

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
    "sortingModeHint": {"depth": "zDepth", "distance": "cameraDistance"},
}
"""Tokens in other libraries' words, folded, and what the attribute calls them."""


def misspelt_type(name: str) -> str | None:
    """The type of UsdVol that an unregistered type name was probably meant to be."""
    return PRE_STANDARD_TYPES.get(name) or closest_name(name, CONCRETE_TYPES)


def misspelt_api(name: str) -> str | None:
    """The API of UsdVol that an unregistered API name was probably meant to be.

    The names share most of their letters, so a third party's own may look alike: a near one
    differs by a letter or two.
    """
    return PRE_STANDARD_APIS.get(name) or closest_name(name, tuple(API_INCLUDES), cutoff=0.95)


def misspelt_attribute(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate that an attribute which no schema declares was probably meant to be.

    A name in a namespace is somebody's own, unless it is in one of ours; and one with a word more
    than ours has, `opacitiesMax`, is no slip.
    """
    names = frozenset(candidates)
    folded = _fold(name)
    for guessed, meant in GUESSED_ATTRIBUTES.items():
        if folded == _fold(guessed):
            return meant if meant in names else None
    if name.startswith("primvars:"):
        return None
    if ":" in name:
        names = frozenset(candidate for candidate in names if ":" in candidate)
    if any(name.startswith(other) and name[len(other) :][:1].isupper() for other in names):
        return None
    return closest_name(name, names, cutoff=0.81)


def is_alike(one: str, other: str) -> bool:
    """Whether values of two types may stand for the same thing: both texts or both numbers."""
    return _nature(one) == _nature(other)


def misspelt_token(attribute: str, token: str, allowed: tuple[str, ...]) -> str | None:
    """The allowed token that another one was probably meant to be.

    OpenVDB's own words among them: `GRID_FOG_VOLUME`, `Tree_float_5_4_3`, `vec3s`.
    """
    folded = _fold(token).removeprefix("grid")
    if folded.startswith("tree"):
        folded = folded.removeprefix("tree").rstrip("0123456789") or folded
    guess = GUESSED_TOKENS.get(attribute, {}).get(folded)
    return guess if guess in allowed else closest_name(folded, frozenset(allowed), cutoff=0.8)


def closest_name(
    name: str, candidates: tuple[str, ...] | frozenset[str], cutoff: float = CLOSE
) -> str | None:
    """The candidate that `name` is most likely a misspelling of, if one is close enough.

    Another number is another thing, however close: a 2D splat is no misspelt 3D splat.
    """
    digits = _digits(name)
    alike = (other for other in sorted(candidates) if digits in ("", _digits(other)))
    return closest_match(name, alike, cutoff, _fold)


def _nature(type_name: str) -> tuple[bool, bool]:
    """Whether a type is an array, and whether it is a text."""
    scalar = type_name.removesuffix("[]")
    return scalar != type_name, scalar in ("asset", "string", "token")


def _fold(name: str) -> str:
    """The name without case, separators and the prefix that it has in C++."""
    for separator in "_-: ":
        name = name.replace(separator, "")
    return name.lower().removeprefix("usdvol")


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))
