"""What UsdVol declares, as the union over USD versions: the one place with version-dependent names.

The tables hold for every supported USD, also for one that is too old to know particle fields.
Source: `usdVol/schema.usda` of OpenUSD 24.11 to 26.11.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from usdvol_lint.nearest import CLOSE, closest_match

VOLUME = "Volume"
FIELD = "VolumeFieldBase"
FIELD_ASSET = "FieldAsset"
PARTICLE_FIELD = "ParticleField"
GPRIM = "Gprim"
OURS = frozenset({VOLUME, FIELD, PARTICLE_FIELD})

FIELD_NAMESPACE = "field:"
"""What the names of a Volume's relationships to its fields begin with."""

STAGE = "<stage>"
UNKNOWN_TYPE = "<unknown type>"
ABSTRACT_TYPE = "<abstract type>"
"""Not schemas, but subscribed to like schemas: see `usdvol_lint.rule`."""

FILE_EXTENSIONS = {"OpenVDBAsset": ".vdb", "Field3DAsset": ".f3d"}
"""What the names of the files of each type end in."""

PARTICLE_FIELD_SINCE = (0, 26, 3)
"""The first USD whose UsdVol declares particle fields."""

TYPE_BASES: dict[str, tuple[str, ...]] = {
    "Volume": ("Gprim", "Boundable", "Xformable", "Imageable"),
    "VolumeFieldBase": ("Xformable", "Imageable"),
    "FieldBase": ("VolumeFieldBase", "Xformable", "Imageable"),
    "VolumeFieldAsset": ("FieldBase", "VolumeFieldBase", "Xformable", "Imageable"),
    "FieldAsset": ("VolumeFieldAsset", "FieldBase", "VolumeFieldBase", "Xformable", "Imageable"),
    "OpenVDBAsset": (
        "FieldAsset", "VolumeFieldAsset", "FieldBase", "VolumeFieldBase", "Xformable", "Imageable",
    ),
    "Field3DAsset": (
        "FieldAsset", "VolumeFieldAsset", "FieldBase", "VolumeFieldBase", "Xformable", "Imageable",
    ),
    "ParticleField": ("Gprim", "Boundable", "Xformable", "Imageable"),
    "ParticleField3DGaussianSplat": (
        "ParticleField", "Gprim", "Boundable", "Xformable", "Imageable",
    ),
}  # fmt: skip
"""Every prim type of UsdVol with its bases, nearest first."""

ABSTRACT_TYPES = frozenset({"VolumeFieldBase", "FieldBase", "VolumeFieldAsset", "FieldAsset"})
CONCRETE_TYPES = frozenset(TYPE_BASES) - ABSTRACT_TYPES

POSITION_BASE = "ParticleFieldPositionBaseAPI"
KERNEL_BASE = "ParticleFieldKernelBaseAPI"
RADIANCE_BASE = "ParticleFieldRadianceBaseAPI"
POSITIONS_API = "ParticleFieldPositionAttributeAPI"
HARMONICS_API = "ParticleFieldSphericalHarmonicsAttributeAPI"

API_INCLUDES: dict[str, tuple[str, ...]] = {
    POSITION_BASE: (),
    KERNEL_BASE: (),
    RADIANCE_BASE: (),
    "ParticleFieldPositionAttributeAPI": (POSITION_BASE,),
    "ParticleFieldOrientationAttributeAPI": (),
    "ParticleFieldScaleAttributeAPI": (),
    "ParticleFieldOpacityAttributeAPI": (),
    "ParticleFieldKernelGaussianEllipsoidAPI": (KERNEL_BASE,),
    "ParticleFieldKernelGaussianSurfletAPI": (KERNEL_BASE,),
    "ParticleFieldKernelConstantSurfletAPI": (KERNEL_BASE,),
    "ParticleFieldSphericalHarmonicsAttributeAPI": (RADIANCE_BASE,),
}
"""Every applied API of UsdVol with the APIs that it brings along."""

BASE_APIS = (POSITION_BASE, KERNEL_BASE, RADIANCE_BASE)
PARTICLE_FIELD_ONLY_APIS = tuple(api for api in API_INCLUDES if api not in BASE_APIS)
"""The APIs whose schema says `apiSchemaCanOnlyApplyTo = ["ParticleField"]`."""

BUILT_IN_APIS: dict[str, tuple[str, ...]] = {
    "ParticleField3DGaussianSplat": (
        "ParticleFieldPositionAttributeAPI",
        "ParticleFieldOrientationAttributeAPI",
        "ParticleFieldScaleAttributeAPI",
        "ParticleFieldOpacityAttributeAPI",
        "ParticleFieldKernelGaussianEllipsoidAPI",
        "ParticleFieldSphericalHarmonicsAttributeAPI",
    ),
}
"""The APIs that a prim type has without anyone applying them."""


class Attribute(NamedTuple):
    """What a schema declares of an attribute: any token is allowed where it names none."""

    type_name: str
    uniform: bool = False
    tokens: tuple[str, ...] = ()


ATTRIBUTES: dict[str, dict[str, Attribute]] = {
    "Imageable": {
        "visibility": Attribute("token"),
        "purpose": Attribute("token", uniform=True),
    },
    "Xformable": {"xformOpOrder": Attribute("token[]", uniform=True)},
    "Boundable": {"extent": Attribute("float3[]")},
    "Gprim": {
        "doubleSided": Attribute("bool", uniform=True),
        "orientation": Attribute("token", uniform=True),
        "primvars:displayColor": Attribute("color3f[]"),
        "primvars:displayOpacity": Attribute("float[]"),
    },
    "VolumeFieldAsset": {
        "filePath": Attribute("asset"),
        "fieldName": Attribute("token"),
        "fieldIndex": Attribute("int"),
        "fieldDataType": Attribute("token"),
        "vectorDataRoleHint": Attribute(
            "token", tokens=("None", "Point", "Normal", "Vector", "Color")
        ),
    },
    "OpenVDBAsset": {
        "fieldDataType": Attribute(
            "token",
            tokens=(
                *("half", "float", "double", "int", "uint", "int64"),
                *("half2", "float2", "double2", "int2", "half3", "float3", "double3", "int3"),
                *("matrix3d", "matrix4d", "quatd", "bool", "mask", "string"),
            ),
        ),
        "fieldClass": Attribute("token", tokens=("levelSet", "fogVolume", "staggered", "unknown")),
    },
    "Field3DAsset": {
        "fieldDataType": Attribute(
            "token", tokens=("half", "float", "double", "half3", "float3", "double3")
        ),
        "fieldPurpose": Attribute("token"),
    },
    "ParticleField3DGaussianSplat": {
        "projectionModeHint": Attribute(
            "token", uniform=True, tokens=("perspective", "tangential")
        ),
        "sortingModeHint": Attribute(
            "token",
            uniform=True,
            tokens=("zDepth", "cameraDistance", "rayHitDistance"),  # the last since 26.5
        ),
    },
    "ParticleFieldPositionAttributeAPI": {
        "positions": Attribute("point3f[]"),
        "positionsh": Attribute("point3h[]"),
    },
    "ParticleFieldOrientationAttributeAPI": {
        "orientations": Attribute("quatf[]"),
        "orientationsh": Attribute("quath[]"),
    },
    "ParticleFieldScaleAttributeAPI": {
        "scales": Attribute("float3[]"),
        "scalesh": Attribute("half3[]"),
    },
    "ParticleFieldOpacityAttributeAPI": {
        "opacities": Attribute("float[]"),
        "opacitiesh": Attribute("half[]"),
    },
    "ParticleFieldSphericalHarmonicsAttributeAPI": {
        "radiance:sphericalHarmonicsDegree": Attribute("int", uniform=True),
        "radiance:sphericalHarmonicsCoefficients": Attribute("float3[]"),
        "radiance:sphericalHarmonicsCoefficientsh": Attribute("half3[]"),
    },
}
"""The attributes that each schema adds to, or narrows of, those of its bases, bases first.

What a Volume has from UsdGeom is here too, but not which tokens UsdGeom allows.
"""

SCALAR_DATA_TYPES = frozenset(
    {"half", "float", "double", "int", "uint", "int64", "bool", "mask", "string"}
)
"""The `fieldDataType` tokens of fields with one number, flag or text in each voxel."""

API_ATTRIBUTES: dict[str, tuple[str, ...]] = {
    api: tuple(ATTRIBUTES[api]) for api in API_INCLUDES if api in ATTRIBUTES
}
"""The names of the attributes that come with each applied API."""

API_PROVIDERS: dict[str, tuple[str, ...]] = {
    base: tuple(api for api, included in API_INCLUDES.items() if base in included)
    for base in BASE_APIS
}
"""The APIs of UsdVol that bring each base API along, and carry what it stands for."""

COLOUR_SPACES = frozenset(
    {
        *("lin_ap0_scene", "lin_ap1_scene", "lin_rec709_scene", "lin_rec2020_scene"),
        *("lin_adobergb_scene", "lin_p3d65_scene", "lin_displayp3_scene", "lin_ciexyzd65_scene"),
        *("srgb_rec709_scene", "srgb_ap1_scene", "srgb_p3d65_scene"),
        *("g22_rec709_scene", "g22_ap1_scene", "g22_adobergb_scene"),
        *("g18_rec709_scene", "g24_rec709_scene"),
        *("data", "raw", "unknown", "identity"),
    }
)
"""The colour spaces that USD knows by name (`GfColorSpaceNames`)."""

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


def expand_apis(apis: tuple[str, ...]) -> tuple[str, ...]:
    """The APIs with those that they bring along, in order, each once."""
    expanded = (name for api in apis for name in (api, *API_INCLUDES.get(api, ())))
    return tuple(dict.fromkeys(expanded))


def attributes_of(schemas: Iterable[str]) -> dict[str, Attribute]:
    """The attributes that prims have which answer to all of these schemas."""
    names = frozenset(schemas)
    return {
        name: attribute
        for schema, attributes in ATTRIBUTES.items()
        if schema in names
        for name, attribute in attributes.items()
    }


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
