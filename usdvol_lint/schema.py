"""What UsdVol declares, as the union over USD versions: the one place with version-dependent names.

The tables hold for every supported USD, also for one that is too old to know particle fields.
Source: `usdVol/schema.usda` of OpenUSD 24.11 to 26.11.
"""

from __future__ import annotations

from difflib import get_close_matches

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
FIELD_BASES = ("VolumeFieldBase", "FieldBase")
"""A prim is a field if it is one of these: third-party types may derive from either."""

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


PRE_STANDARD_TYPES: dict[str, str] = {
    "ParticleField_3DGaussianSplat": "ParticleField3DGaussianSplat",
    "GaussianSplat": "ParticleField3DGaussianSplat",
    "GaussianSplats": "ParticleField3DGaussianSplat",
    "Gaussians": "ParticleField3DGaussianSplat",
    "LightField": "ParticleField",
}
"""Type names from before the schema was released, and what they became."""

PRE_STANDARD_APIS: dict[str, str] = {
    "PositionBaseAPI": POSITION_BASE,
    "PositionAttributeAPI": "ParticleFieldPositionAttributeAPI",
    "OrientationAttributeAPI": "ParticleFieldOrientationAttributeAPI",
    "ScaleAttributeAPI": "ParticleFieldScaleAttributeAPI",
    "OpacityAttributeAPI": "ParticleFieldOpacityAttributeAPI",
    "LightFieldKernelBaseAPI": KERNEL_BASE,
    "LightFieldRadianceBaseAPI": RADIANCE_BASE,
    "LightFieldKernelGaussianEllipsoidAPI": "ParticleFieldKernelGaussianEllipsoidAPI",
    "LightFieldKernelGaussianSurfletAPI": "ParticleFieldKernelGaussianSurfletAPI",
    "LightFieldKernelConstantSurfletAPI": "ParticleFieldKernelConstantSurfletAPI",
    "LightFieldSphericalHarmonicsAttributeAPI": "ParticleFieldSphericalHarmonicsAttributeAPI",
}
"""API names from before the schema was released, and what they became."""


def expand_apis(apis: tuple[str, ...]) -> tuple[str, ...]:
    """The APIs with those that they bring along, in order, each once."""
    expanded = (name for api in apis for name in (api, *API_INCLUDES.get(api, ())))
    return tuple(dict.fromkeys(expanded))


def nearest(name: str, candidates: tuple[str, ...] | frozenset[str]) -> str | None:
    """The candidate that `name` is most likely a misspelling of, if one is close enough."""
    folded = {_fold(candidate): candidate for candidate in sorted(candidates)}
    matches = get_close_matches(_fold(name), folded, n=1, cutoff=0.84)
    return folded[matches[0]] if matches else None


def _fold(name: str) -> str:
    return name.replace("_", "").replace("-", "").lower()
