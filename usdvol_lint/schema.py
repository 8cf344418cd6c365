"""What UsdVol declares, as the union over USD versions: no other module depends on a version.

The tables are the same under every supported USD, also one too old to know particle fields.
Source: `usdVol/schema.usda` of OpenUSD 24.11 to 26.11.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

VOLUME = "Volume"
FIELD = "VolumeFieldBase"
FIELD_ASSET = "FieldAsset"
PARTICLE_FIELD = "ParticleField"
GPRIM = "Gprim"
POINT_INSTANCER = "PointInstancer"
OURS = frozenset({VOLUME, FIELD, PARTICLE_FIELD})

FIELD_NAMESPACE = "field:"
"""The prefix of a Volume's relationships to its fields; what a field lacks that none targets."""
TYPE_NAME, SPECIFIER, CLIPS, PRIMS = "typeName", "specifier", "clips", "primChildren"
"""What specs may lack that is no property, in USD's words."""

STAGE = "<stage>"
UNKNOWN_TYPE = "<unknown type>"
ABSTRACT_TYPE = "<abstract type>"
"""No schemas, but in a rule's `on` like schemas: see `usdvol_lint.rule.Rule`."""

FILE_EXTENSIONS = {"OpenVDBAsset": ".vdb", "Field3DAsset": ".f3d"}
"""The extension of the files of each type."""

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
"""Every applied API of UsdVol with the APIs that are built into it."""

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
"""The APIs that are built into a prim type."""


class Attribute(NamedTuple):
    """What a schema declares of an attribute; without `tokens`, any token is allowed."""

    type_name: str
    uniform: bool = False
    tokens: tuple[str, ...] = ()


ATTRIBUTES: dict[str, dict[str, Attribute]] = {
    "Imageable": {
        "visibility": Attribute("token", tokens=("inherited", "invisible")),
        "purpose": Attribute("token", uniform=True, tokens=("default", "render", "proxy", "guide")),
    },
    "Xformable": {"xformOpOrder": Attribute("token[]", uniform=True)},
    "Boundable": {"extent": Attribute("float3[]")},
    "Gprim": {
        "doubleSided": Attribute("bool", uniform=True),
        "orientation": Attribute("token", uniform=True, tokens=("rightHanded", "leftHanded")),
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
"""The attributes that each schema adds to those of its bases or declares anew, bases first.

Those that a Volume inherits from UsdGeom are here too.
"""

DECLARED_BY: dict[str, tuple[str, ...]] = {
    name: tuple(schema for schema, names in ATTRIBUTES.items() if name in names)
    for schema, names in ATTRIBUTES.items()
    if schema not in TYPE_BASES["Volume"]
    for name in names
}
"""By the name of each attribute of UsdVol's own, the schemas that declare it."""

SCALAR_DATA_TYPES = frozenset(
    {"half", "float", "double", "int", "uint", "int64", "bool", "mask", "string"}
)
"""The `fieldDataType` tokens of fields with one number, bool or string for each voxel."""

API_ATTRIBUTES: dict[str, tuple[str, ...]] = {
    api: tuple(ATTRIBUTES[api]) for api in API_INCLUDES if api in ATTRIBUTES
}
"""The names of each applied API's attributes."""

API_PROVIDERS: dict[str, tuple[str, ...]] = {
    base: tuple(api for api, included in API_INCLUDES.items() if base in included)
    for base in BASE_APIS
}
"""The APIs of UsdVol into which each base API is built; these have the attributes."""

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
"""The names of USD's colour spaces (`GfColorSpaceNames`)."""


def applied(api: str) -> str:
    """What a prim lacks to which an API is not applied, as one of the words above."""
    return f"apiSchemas:{api}"


def expand_apis(apis: tuple[str, ...]) -> tuple[str, ...]:
    """The APIs, each followed by those built into it, without duplicates."""
    expanded = (name for api in apis for name in (api, *API_INCLUDES.get(api, ())))
    return tuple(dict.fromkeys(expanded))


def attributes_of(schemas: Iterable[str]) -> dict[str, Attribute]:
    """The attributes of a prim with all of these schemas, by name."""
    names = frozenset(schemas)
    return {
        name: attribute
        for schema, attributes in ATTRIBUTES.items()
        if schema in names
        for name, attribute in attributes.items()
    }
