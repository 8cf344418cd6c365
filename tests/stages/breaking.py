"""Ways to break a prim of any type with an opinion that is stronger than all it has."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from pxr import Sdf, Vt

Break: TypeAlias = Callable[[Any, Any], None]

_SMALL = Vt.Vec3fArray([(0.4, 0.4, 0.4), (0.41, 0.41, 0.41)])


def _value(name: str, type_name: Any, value: Any) -> Break:
    def author(top: Any, prim: Any) -> None:
        spec = Sdf.CreatePrimInLayer(top, prim.GetPath())
        Sdf.AttributeSpec(spec, name, type_name).default = value

    author.__name__ = f"{name} = {value}"
    return author


def _first_target(prim: Any) -> tuple[Any, Any] | None:
    """The first field relationship of a Volume, and its target."""
    for each in prim.GetPropertiesInNamespace("field"):
        for target in each.GetTargets()[:1]:
            return each, target
    return None


def a_missing_target(top: Any, prim: Any) -> None:
    if found := _first_target(prim):
        spec = Sdf.CreatePrimInLayer(top, prim.GetPath())
        targets = Sdf.RelationshipSpec(spec, found[0].GetName()).targetPathList
        targets.explicitItems = [prim.GetPath().AppendChild("nowhere_at_all")]


def a_second_target(top: Any, prim: Any) -> None:
    if found := _first_target(prim):
        spec = Sdf.CreatePrimInLayer(top, prim.GetPath())
        targets = Sdf.RelationshipSpec(spec, found[0].GetName()).targetPathList
        targets.appendedItems = [prim.GetPath().AppendChild("other")]


def a_field_that_is_inactive(top: Any, prim: Any) -> None:
    found = _first_target(prim)
    if found and prim.GetStage().GetPrimAtPath(found[1]):
        Sdf.CreatePrimInLayer(top, found[1].GetPrimPath()).SetInfo("active", False)


def a_mesh_below(top: Any, prim: Any) -> None:
    spec = Sdf.CreatePrimInLayer(top, prim.GetPath().AppendChild("mesh"))
    spec.specifier, spec.typeName = Sdf.SpecifierDef, "Mesh"


def another_type(top: Any, prim: Any) -> None:
    Sdf.CreatePrimInLayer(top, prim.GetPath()).typeName = "Xform"


def no_apis(top: Any, prim: Any) -> None:
    taken = Sdf.TokenListOp.Create(deletedItems=list(prim.GetAppliedSchemas()))
    Sdf.CreatePrimInLayer(top, prim.GetPath()).SetInfo("apiSchemas", taken)


_TYPES = Sdf.ValueTypeNames
_OF_ALL = (
    _value("extent", _TYPES.Float3Array, _SMALL),
    _value("extent", _TYPES.Float3Array, Vt.Vec3fArray([(float("nan"), 0, 0), (1, 1, 1)])),
    another_type,
)
_OF_FIELDS = (
    _value("fieldName", _TYPES.Token, "nosuchgrid"),
    _value("fieldIndex", _TYPES.Int, 7),
    _value("fieldDataType", _TYPES.Token, "double3"),
    _value("fieldClass", _TYPES.Token, "levelSet"),
    _value("vectorDataRoleHint", _TYPES.Token, "Color"),
    _value("filePath", _TYPES.Asset, Sdf.AssetPath("./nosuch.vdb")),
    _value("filePath", _TYPES.Asset, Sdf.ValueBlock()),
    _value("fielName", _TYPES.Token, "density"),
    another_type,
)
_OF_PARTICLES = (
    *_OF_ALL,
    _value("positions", _TYPES.Point3fArray, Vt.Vec3fArray([(0, 0, 0)])),
    _value("opacities", _TYPES.FloatArray, Vt.FloatArray([5.0])),
    _value("scales", _TYPES.Float3Array, Vt.Vec3fArray([(-1, -1, -1)])),
    _value("radiance:sphericalHarmonicsDegree", _TYPES.Int, 7),
    no_apis,
)
BREAKS: dict[str, tuple[Break, ...]] = {
    "Volume": (
        *_OF_ALL,
        *(a_missing_target, a_second_target, a_field_that_is_inactive, a_mesh_below),
    ),
    "OpenVDBAsset": _OF_FIELDS,
    "Field3DAsset": _OF_FIELDS,
    "ParticleField3DGaussianSplat": _OF_PARTICLES,
    "ParticleField": _OF_PARTICLES,
}
"""By the type of the prim."""
