"""What is inside the files."""

from __future__ import annotations

from random import Random

from ..files import original, shared
from ..model import Attribute, Prim
from .declaration import A_RUN, ONE_FILE, VolumeSubject, any_field, field_of, on_volume

_DENSITY = {"fieldName": "density", "fieldDataType": "float"}
_VELOCITY = {"fieldName": "velocity", "fieldDataType": "float3"}


@on_volume("GRD001", needs=ONE_FILE)
def text_file(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/text.vdb", **_DENSITY)


@on_volume("GRD001", needs=ONE_FILE)
def offsets_broken(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/broken.vdb", **_DENSITY)


@on_volume("GRD001", needs=ONE_FILE)
def nanovdb_called_vdb(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/nanovdb.vdb", **_DENSITY)


@on_volume("GRD002", needs=ONE_FILE)
def cut_off(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/truncated.vdb", **_DENSITY)


@on_volume("GRD003")
def grid_missing(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.attribute("fieldName").value = rng.choice(("Density", "fumes", "density ", "g[0]"))
    return prim


@on_volume("GRD003", needs=ONE_FILE)
def no_grids(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/no_grids.vdb", **_DENSITY)


@on_volume("GRD003", needs=ONE_FILE)
def vector_split(subject: VolumeSubject, rng: Random) -> Prim:
    said = {"fieldName": "vel", "fieldDataType": "float3"}
    return field_of(subject, rng, "grids/split_velocity.vdb", **said)


@on_volume("GRD004", needs=ONE_FILE)
def index_beyond(subject: VolumeSubject, rng: Random) -> Prim:
    index = rng.choice((2, 9))
    return field_of(subject, rng, "grids/same_name.vdb", **_DENSITY, fieldIndex=index)


@on_volume("GRD005")
def vector_for_scalar(subject: VolumeSubject, rng: Random) -> Prim:
    attribute = any_field(subject, rng).prim
    said = attribute.attribute("fieldDataType")
    said.value = "float" if "3" in said.value else "double3"
    attribute.properties.pop("vectorDataRoleHint", None)
    return attribute


@on_volume("GRD005", needs=ONE_FILE)
def float_for_double(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/double.vdb", **_DENSITY)


@on_volume("GRD006", needs=ONE_FILE)
def fog_for_level_set(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/level_set.vdb", **_DENSITY, fieldClass="fogVolume")


@on_volume("GRD006", needs=ONE_FILE, is_info=True)
def class_of_the_unclassed(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/unclassed.vdb", **_DENSITY, fieldClass="fogVolume")


@on_volume("GRD007", needs=ONE_FILE)
def normal_for_vector(subject: VolumeSubject, rng: Random) -> Prim:
    said = {**_VELOCITY, "vectorDataRoleHint": "Normal"}
    return field_of(subject, rng, "grids/velocity.vdb", **said)


@on_volume("GRD008", needs=ONE_FILE, is_info=True)
def no_voxels(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/no_voxels.vdb", **_DENSITY)


@on_volume("GRD009", needs=ONE_FILE)
def two_of_one_name(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/same_name.vdb", **_DENSITY)


@on_volume("GRD009", needs=ONE_FILE)
def another_name_in_metadata(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/two_names.vdb", **_DENSITY)


@on_volume("GRD010", needs=ONE_FILE)
def version_unsupported(subject: VolumeSubject, rng: Random) -> Prim:
    version = rng.choice((221, 226))
    return field_of(subject, rng, f"grids/version_{version}.vdb", **_DENSITY)


@on_volume("GRD011", needs=ONE_FILE)
def type_unregistered(subject: VolumeSubject, rng: Random) -> Prim:
    return field_of(subject, rng, "grids/unregistered.vdb", **_DENSITY)


@on_volume("GRD012", needs=ONE_FILE)
def frustum(subject: VolumeSubject, rng: Random) -> Prim:
    path = rng.choice(("grids/frustum.vdb", "box_frustum.vdb"))
    return field_of(subject, rng, path, **_DENSITY)


@on_volume("GRD013", needs={**A_RUN, "fields": 1})
def type_changes(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    frames = list(part.prim.attribute("filePath").samples.values())
    other = original(shared("grids/double.vdb")).read_bytes()
    subject.content.files[rng.choice(frames).path] = other
    del part.prim.properties["fieldDataType"]
    return part.prim


@on_volume("GRD003", needs={**A_RUN, "fields": 1})
def grid_missing_in_a_frame(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    frames = list(part.prim.attribute("filePath").samples.values())
    other = original(shared("grids/split_velocity.vdb")).read_bytes()
    subject.content.files[rng.choice(frames).path] = other
    part.prim.properties["fieldName"] = Attribute("token", "density")
    return part.prim
