"""What UsdVol declares, as the union over USD versions: the one place with version-dependent names.

The tables hold for every supported USD, also for one that is too old to know particle fields.
Source: `usdVol/schema.usda` of OpenUSD 24.11 to 26.11.
"""

from __future__ import annotations

VOLUME = "Volume"
FIELD = "VolumeFieldBase"
FIELD_ASSET = "FieldAsset"
PARTICLE_FIELD = "ParticleField"

STAGE = "<stage>"
UNKNOWN_TYPE = "<unknown type>"
ABSTRACT_TYPE = "<abstract type>"
"""Not schemas, but subscribed to like schemas: see `usdvol_lint.rule`."""

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

API_ATTRIBUTES: dict[str, tuple[str, ...]] = {
    "ParticleFieldPositionAttributeAPI": ("positions", "positionsh"),
    "ParticleFieldOrientationAttributeAPI": ("orientations", "orientationsh"),
    "ParticleFieldScaleAttributeAPI": ("scales", "scalesh"),
    "ParticleFieldOpacityAttributeAPI": ("opacities", "opacitiesh"),
    "ParticleFieldSphericalHarmonicsAttributeAPI": (
        "radiance:sphericalHarmonicsDegree",
        "radiance:sphericalHarmonicsCoefficients",
        "radiance:sphericalHarmonicsCoefficientsh",
    ),
}
"""The attributes that come with each applied API."""

API_PROVIDERS: dict[str, tuple[str, ...]] = {
    base: tuple(api for api, included in API_INCLUDES.items() if base in included)
    for base in BASE_APIS
}
"""The APIs of UsdVol that bring each base API along, and carry what it stands for."""

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


def expand_apis(apis: tuple[str, ...]) -> tuple[str, ...]:
    """The APIs with those that they bring along, in order, each once."""
    expanded = (name for api in apis for name in (api, *API_INCLUDES.get(api, ())))
    return tuple(dict.fromkeys(expanded))


def misspelt_type(name: str) -> str | None:
    """The type of UsdVol that an unregistered type name was probably meant to be."""
    return PRE_STANDARD_TYPES.get(name) or nearest(name, CONCRETE_TYPES)


def misspelt_api(name: str) -> str | None:
    """The API of UsdVol that an unregistered API name was probably meant to be.

    The names share most of their letters, so a third party's own may look alike: a near one
    differs by a letter or two.
    """
    return PRE_STANDARD_APIS.get(name) or nearest(name, tuple(API_INCLUDES), cutoff=0.95)


def nearest(
    name: str, candidates: tuple[str, ...] | frozenset[str], cutoff: float = 0.84
) -> str | None:
    """The candidate that `name` is most likely a misspelling of, if one is close enough.

    Another number is another thing, however close: a 2D splat is no misspelt 3D splat.
    """
    from difflib import get_close_matches  # costs start-up time, and few names are misspelt

    digits = _digits(name)
    folded = {
        _fold(candidate): candidate
        for candidate in sorted(candidates)
        if digits in ("", _digits(candidate))
    }
    matches = get_close_matches(_fold(name), folded, n=1, cutoff=cutoff)
    return folded[matches[0]] if matches else None


def _fold(name: str) -> str:
    """The name without case, separators and the prefix that it has in C++."""
    return name.replace("_", "").replace("-", "").lower().removeprefix("usdvol")


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))
