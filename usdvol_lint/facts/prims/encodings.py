"""Encodings of volumes and splats that predate the schema: how they are recognised, what to do."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

from usdvol_lint.facts.usd.kinds import raw_apis


class Encoding(NamedTuple):
    """Where an encoding comes from, what to do, and by which `sign` on a prim it was recognised."""

    origin: str
    advice: str
    sign: str = ""


_NUREC = Encoding(
    "NuRec, as 3DGRUT before 2026 and Isaac Sim write it for NVIDIA's renderers alone",
    "export it again, from the training checkpoint or the PLY, as ParticleField3DGaussianSplat",
)
_HOUDINI = Encoding(
    "a volume of Houdini's own, which no renderer outside Houdini reads",
    "write the volume to a .vdb file, and name that file with an OpenVDBAsset",
)
_LIGHT_FIELD = Encoding(
    "usdLightField, the proposal of 2025 that became ParticleField",
    "use the type ParticleField3DGaussianSplat, drop `primvars:` from `primvars:radiance:…`, "
    "and remove API names that begin with LightField",
)
_GAUSSIANS_API = Encoding(
    "the proposal of July 2025, which put splats on Points",
    "use the type ParticleField3DGaussianSplat, rename `points` to `positions`, "
    "and remove GaussiansAPI and SphericalHarmonicsAPI",
)
_ADOBE = Encoding(
    "splats as Adobe's plugins for PLY and SPZ files present them",
    "export the PLY or SPZ file as ParticleField3DGaussianSplat; do not rename attributes, the "
    "values mean other things and the extent is a clip box",
)
_GSPLAT = Encoding(
    "splats as tinyusdz and some reconstruction apps write them",
    "export the PLY or SPZ file as ParticleField3DGaussianSplat; do not rename attributes, they "
    "may hold raw logits and logarithms",
)

_TRAINING = Encoding(
    "splats as NuRec files and 3DGRUT name them, before exp, sigmoid and normalization",
    "export them again, from the training checkpoint or the PLY, as ParticleField3DGaussianSplat; "
    "do not rename attributes, they hold raw logits and logarithms",
)

_BY_TYPE = {
    "OmniNuRecFieldAsset": _NUREC,
    "HoudiniFieldAsset": _HOUDINI,
    "ParticleField_3DGaussianSplat": _LIGHT_FIELD,
}
_BY_API = {"GaussiansAPI": _GAUSSIANS_API, "SphericalHarmonicsAPI": _GAUSSIANS_API}
_Fingerprints: TypeAlias = dict[tuple[str, ...], Encoding]
"""Encodings by prefixes of property names; there must be a property for each prefix."""

_RADIANCE_PRIMVARS: _Fingerprints = {("primvars:radiance:sphericalHarmonics",): _LIGHT_FIELD}
_RAW_ARRAYS: _Fingerprints = {("features_albedo", "densities", "rotations"): _TRAINING}
_BY_PROPERTIES: dict[str, _Fingerprints] = {
    "Scope": _RAW_ARRAYS,
    "Points": {
        **_RAW_ARRAYS,
        ("primvars:gsplat:",): _GSPLAT,
        ("gsplat:encoding",): _GSPLAT,
        ("primvars:rot", "primvars:widths1", "primvars:widths2"): _ADOBE,
    },
    "ParticleField": {**_RADIANCE_PRIMVARS, **_RAW_ARRAYS},
    "ParticleField3DGaussianSplat": {**_RADIANCE_PRIMVARS, **_RAW_ARRAYS},
    "Volume": {("omni:nurec:",): _NUREC, **_RAW_ARRAYS},
}


def recognise(prim: Any) -> Encoding | None:
    """The encoding of a prim; makes few queries, since a stage may hold 100,000 Points."""
    type_name = prim.GetTypeName()
    if type_name in _BY_TYPE:
        return _BY_TYPE[type_name]._replace(sign=f"type {type_name!r}")
    if type_name not in _BY_PROPERTIES:
        return None
    for api in raw_apis(prim) if type_name == "Points" else ():
        if api in _BY_API:
            return _BY_API[api]._replace(sign=f"applied API {api!r}")
    return _by_properties(prim, _BY_PROPERTIES[type_name])


def _by_properties(prim: Any, known: _Fingerprints) -> Encoding | None:
    names = prim.GetAuthoredPropertyNames()
    text = " ".join(names)
    for prefixes, encoding in known.items():
        # Most prims end with the first of these tests, which is the fastest.
        if prefixes[0] in text and all(_any_begins(names, prefix) for prefix in prefixes):
            if any(child.GetTypeName() in _BY_TYPE for child in prim.GetChildren()):
                return None  # it is reported on these fields
            first = next(name for name in names if name.startswith(prefixes[0]))
            return encoding._replace(sign=f"property {first!r}")
    return None


def _any_begins(names: list[str], prefix: str) -> bool:
    return any(name.startswith(prefix) for name in names)
