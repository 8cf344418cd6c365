"""What prims of UsdVol's types are read for, and whether a prim of any type has it."""

from __future__ import annotations

from functools import cache
from typing import Any

from usdvol_lint import schema

_GEOMETRY = frozenset({"Imageable", "Xformable", "Boundable", "Gprim"})
"""The bases that any prim which is drawn may have."""


def has_data_of(prim: Any, type_name: str) -> bool:
    """Whether properties are authored that a prim of this type of UsdVol is read for."""
    names = prim.GetAuthoredPropertyNames()
    if type_name == schema.VOLUME:
        return any(name.startswith(schema.FIELD_NAMESPACE) for name in names)
    return not _read_by(type_name).isdisjoint(names)


@cache
def _read_by(type_name: str) -> frozenset[str]:
    """The attributes that UsdVol itself declares for a type, or for APIs that it may have."""
    schemas = {type_name, *schema.TYPE_BASES[type_name]} - _GEOMETRY
    if schema.PARTICLE_FIELD in schemas:
        schemas |= schema.API_ATTRIBUTES.keys()
    return frozenset(schema.attributes_of(schemas))
