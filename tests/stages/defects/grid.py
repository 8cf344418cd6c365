"""What is inside the files."""

from __future__ import annotations

from random import Random

from ..files import original, shared
from ..model import Attribute, Prim
from .declaration import A_RUN, ONE_FILE, VolumeSubject, any_field, field_of, naming, on_volume

_DENSITY = {"fieldName": "density", "fieldDataType": "float"}
_VELOCITY = {"fieldName": "velocity", "fieldDataType": "float3"}

text_file = naming("GRD001", "grids/text.vdb", **_DENSITY)
offsets_broken = naming("GRD001", "grids/broken.vdb", **_DENSITY)
nanovdb_called_vdb = naming("GRD001", "grids/nanovdb.vdb", **_DENSITY)
cut_off = naming("GRD002", "grids/truncated.vdb", **_DENSITY)


@on_volume("GRD003")
def grid_missing(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.attribute("fieldName").value = rng.choice(("Density", "fumes", "density ", "g[0]"))
    return prim


no_grids = naming("GRD003", "grids/no_grids.vdb", **_DENSITY)
vector_split = naming("GRD003", "grids/split_velocity.vdb", fieldName="vel", fieldDataType="float3")


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


float_for_double = naming("GRD005", "grids/double.vdb", **_DENSITY)
fog_for_level_set = naming("GRD006", "grids/level_set.vdb", **_DENSITY, fieldClass="fogVolume")
class_of_the_unclassed = naming(
    "GRD006", "grids/unclassed.vdb", is_info=True, **_DENSITY, fieldClass="fogVolume"
)
normal_for_vector = naming("GRD007", "grids/velocity.vdb", **_VELOCITY, vectorDataRoleHint="Normal")
no_voxels = naming("GRD008", "grids/no_voxels.vdb", is_info=True, **_DENSITY)
two_of_one_name = naming("GRD009", "grids/same_name.vdb", **_DENSITY)
another_name_in_metadata = naming("GRD009", "grids/two_names.vdb", **_DENSITY)


@on_volume("GRD010", needs=ONE_FILE)
def version_unsupported(subject: VolumeSubject, rng: Random) -> Prim:
    version = rng.choice((221, 226))
    return field_of(subject, rng, f"grids/version_{version}.vdb", **_DENSITY)


type_unregistered = naming("GRD011", "grids/unregistered.vdb", **_DENSITY)


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
