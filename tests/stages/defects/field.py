"""Field prims."""

from __future__ import annotations

from random import Random

from ..looks import hide_below
from ..model import Attribute, Prim
from .declaration import A_RUN, VolumeSubject, any_field, field_of, naming, on_volume

no_name = naming("FLD001", "cloud.vdb", fieldDataType="float")
"""Of one of several grids: where a file has but one, it is clear which is meant."""
name_empty = naming("FLD001", "cloud.vdb", fieldName="", fieldDataType="float")


@on_volume("FLD002", is_info=True)
def no_data_type(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    del prim.properties["fieldDataType"]
    return prim


@on_volume("FLD003", needs=A_RUN, is_info=True)
def role_of_a_scalar(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties["vectorDataRoleHint"] = Attribute("token", "Color")
    return prim


@on_volume("FLD004")
def index_negative(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties["fieldIndex"] = Attribute("int", rng.choice((-1, -7)))
    return prim


@on_volume("FLD005", needs={"files": "static"}, is_info=True)
def index_of_the_second(subject: VolumeSubject, rng: Random) -> Prim:
    said = {"fieldName": "density", "fieldDataType": "float", "fieldIndex": 1}
    return field_of(subject, rng, "grids/same_name.vdb", **said)


@on_volume("FLD006", needs=A_RUN)
def default_over_samples(subject: VolumeSubject, rng: Random) -> Prim:
    """A stronger layer names one file for all times."""
    part = any_field(subject, rng)
    first = next(iter(part.prim.attribute("filePath").samples.values()))
    return hide_below(subject, part.path, "filePath", Attribute("asset", first))


@on_volume("FLD007", needs={"files": "field3d"}, is_info=True)
def field3d(subject: VolumeSubject, rng: Random) -> Prim:
    return any_field(subject, rng).prim


@on_volume("FLD008", is_info=True)
def extent_on_the_field(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties["extent"] = Attribute("float3[]", [(0, 0, 0), (1, 1, 1)])
    return prim
