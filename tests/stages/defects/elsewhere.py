"""What is right on a prim of another type."""

from __future__ import annotations

from random import Random

from ..files import shared
from ..model import Attribute, File, Prim
from ..particles import APIS
from ..subjects import ParticleSubject, VolumeSubject
from .declaration import any_field, on_particles, on_volume


@on_volume("SCH016", is_info=True)
def class_on_a_volume(subject: VolumeSubject, rng: Random) -> None:
    name = rng.choice(("fieldClass", "filePath", "positions", "sortingModeHint"))
    subject.prim.properties[name] = Attribute("token", "fogVolume")


@on_volume("SCH016", needs={"files": ("static", "sequence", "clips")}, is_info=True)
def purpose_on_an_openvdb_field(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties["fieldPurpose"] = Attribute("token", "smoke")
    return prim


@on_particles("SCH016", needs={"type": "ParticleField"}, is_info=True)
def hint_on_a_plain_field(subject: ParticleSubject, rng: Random) -> None:
    subject.prim.properties["projectionModeHint"] = Attribute(
        "token", "tangential", is_uniform=True
    )


@on_particles("PRT008", needs={"type": "ParticleField", "arrays": True}, is_info=True)
def splat_by_parts(subject: ParticleSubject, rng: Random) -> None:
    names = ", ".join(f'"{api}"' for api in APIS)
    kept = [each for each in subject.prim.metadata if "apiSchemas" not in str(each[0])]
    subject.prim.metadata = [*kept, (f"prepend apiSchemas = [{names}]",)]


@on_particles("VOL012", is_info=True)
def field_without_a_volume(subject: ParticleSubject, rng: Random) -> Prim:
    """The only one of the stage, unless there is another subject."""
    field = Prim("density", "OpenVDBAsset")
    field.properties["filePath"] = Attribute("asset", File(shared("cloud.vdb")))
    field.properties["fieldName"] = Attribute("token", "density")
    field.properties["fieldDataType"] = Attribute("token", "float")
    subject.root.children.append(field)
    return field
