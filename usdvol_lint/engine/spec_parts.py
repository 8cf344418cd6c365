"""What single specs hold of what prims of ours need."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import own_attribute, own_relationship
from usdvol_lint.facts.usd.untyped import GROUP_TYPES
from usdvol_lint.schema import FIELD_NAMESPACE

POSITIONS = "positions"
COEFFICIENTS = "radiance:sphericalHarmonicsCoefficients"
DEGREE = "radiance:sphericalHarmonicsDegree"
EXTENT = "extent"
_WANTED = {
    schema.FIELD_ASSET: ("filePath", "fieldName", "fieldDataType"),
    schema.VOLUME: (EXTENT,),
    schema.PARTICLE_FIELD: (EXTENT, POSITIONS, COEFFICIENTS, DEGREE),
}
"""What prims of ours need, by schema; particle arrays may be in half precision instead."""

_DECLARED = schema.attributes_of(schema.ATTRIBUTES)


def wanted(schemas: frozenset[str]) -> list[str]:
    return [name for key, names in _WANTED.items() if key in schemas for name in names]


def either(name: str) -> tuple[str, ...]:
    """An attribute, and where particles have it in half precision too."""
    return (name, f"{name}h") if name in (POSITIONS, COEFFICIENTS) else (name,)


@cache
def own_paths(name: str) -> tuple[Any, ...]:
    """The same as paths relative to a prim."""
    return tuple(Sdf.Path(f".{each}") for each in either(name))


def is_def(spec: Any) -> bool:
    return bool(spec.specifier == Sdf.SpecifierDef)


def is_field(spec: Any) -> bool:
    return is_def(spec) and has_type(spec)


def has_fields(spec: Any) -> bool:
    return any(name.startswith(FIELD_NAMESPACE) for name in spec.properties.keys())  # noqa: SIM118


def has_type(spec: Any) -> bool:
    return spec.typeName not in GROUP_TYPES


def applies(api: str, spec: Any) -> bool:
    """Whether a prim's spec has one of our APIs: by its list, or built into its type."""
    listed = spec.GetInfo("apiSchemas").GetAppliedItems()
    built_in = schema.BUILT_IN_APIS.get(spec.typeName, ())
    return api in schema.expand_apis((*listed, *built_in))


def holds_value(name: str, spec: Any) -> bool:
    """Whether a prim's spec has a value of an attribute that is not empty."""
    return any(is_valued(own_attribute(spec, path)) for path in own_paths(name))


def is_valued(attribute: Any | None) -> bool:
    if attribute is None:
        return False
    value = attribute.default
    if value is not None and not isinstance(value, Sdf.ValueBlock):
        return is_filled(value)
    return bool(attribute.HasInfo("timeSamples") or attribute.HasInfo("spline"))


def is_filled(value: Any) -> bool:
    """Whether a value of an attribute that prims of ours need is there and not empty."""
    if value is None or isinstance(value, int):
        return value is not None
    return bool(value.path if isinstance(value, Sdf.AssetPath) else len(value))


def is_brought(prim: Any, name: str) -> bool:
    """Whether a prim of a stage has, at some time, a value of an attribute that is not empty."""
    attribute = prim.GetAttribute(name)
    if not attribute.HasAuthoredValue():
        return False
    wanted_type = Sdf.ValueTypeNames.Find(_DECLARED[name].type_name).type
    for spec in attribute.GetPropertyStack()[:1]:
        if isinstance(spec, Sdf.RelationshipSpec) or spec.typeName.type != wanted_type:
            return False
    times = (Usd.TimeCode.Default(), *attribute.GetTimeSamples())
    return any(is_filled(attribute.Get(time)) for time in times)


def is_in_variant(spec: Any) -> bool:
    return bool(spec.path.ContainsPrimVariantSelection())


def has_beside(spec: Any, others: Iterable[Any]) -> bool:
    return any(is_beside(spec, other) for other in others)


def is_beside(spec: Any, other: Any) -> bool:
    """Whether another spec is in the same layer, and in no variant that this one is not in."""
    if spec.layer != other.layer:
        return False
    path = other.path
    while path.ContainsPrimVariantSelection() and not path.IsPrimVariantSelectionPath():
        path = path.GetParentPath()
    return not path.IsPrimVariantSelectionPath() or bool(spec.path.HasPrefix(path))


def has_targets(spec: Any, path: Any) -> bool:
    relationship = own_relationship(spec, path)
    return bool(relationship and relationship.HasInfo("targetPaths"))
