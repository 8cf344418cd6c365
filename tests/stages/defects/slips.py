"""Slips that take a volume out of the picture: names of types, of grids and of folders."""

from __future__ import annotations

import posixpath
from random import Random

from ..files import original, shared
from ..model import Attribute, File, Layer, Prim, Relationship, Scene
from .declaration import (
    ONE_FILE,
    VolumeSubject,
    any_field,
    extent_for_all,
    field_of,
    on_scene,
    on_volume,
)


@on_volume("SCH001")
def volume_type_misspelt(subject: VolumeSubject, rng: Random) -> None:
    subject.prim.type = rng.choice(("Volumes", "volume", "Volme"))


@on_volume("SCH001", needs=ONE_FILE)
def field_type_slightly_off(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.type = rng.choice(("OpenVDBasset", "OpenVDBAssets", "OpenVDBAset", "OpnVDBAset"))
    return prim


@on_volume("AST006", needs=ONE_FILE)
def field3d_file_of_an_openvdb_field(subject: VolumeSubject, rng: Random) -> Prim:
    said = {"fieldName": "temperature", "fieldDataType": "half"}
    return field_of(subject, rng, "samples/f3d_ogawa.f3d", **said)


@on_volume("AST006", needs=ONE_FILE)
def openvdb_file_of_a_field3d_field(subject: VolumeSubject, rng: Random) -> Prim:
    said = {"fieldName": "density", "fieldDataType": "float"}
    prim = field_of(subject, rng, "grids/half.vdb", **said)
    prim.type = "Field3DAsset"
    return prim


@on_volume("FLD001", needs=ONE_FILE)
def no_name_of_the_only_grid(subject: VolumeSubject, rng: Random) -> Prim:
    said = rng.choice(({}, {"fieldName": ""}))
    return field_of(subject, rng, "grids/half.vdb", fieldDataType="float", **said)


@on_volume("AST002", needs=ONE_FILE)
def cache_moved(subject: VolumeSubject, rng: Random) -> Prim:
    """The very file lies in a folder beside the one that the path names."""
    extent_for_all(subject)
    folder = posixpath.dirname(subject.layer.path)
    data = original(shared("cloud.vdb")).read_bytes()
    subject.content.files[posixpath.join(folder, "cache_v1/cloud.vdb")] = data
    prim = any_field(subject, rng).prim
    gone = File(posixpath.join(folder, rng.choice(("cache_v2", "chace_v1", "fx")), "cloud.vdb"))
    prim.properties["filePath"] = Attribute("asset", gone)
    return prim


@on_volume("AST002", needs={**ONE_FILE, "fields": (2, 3, 4)}, without=("package",))
def folder_of_all_fields_missing(subject: VolumeSubject, rng: Random) -> list[Prim]:
    for part in subject.fields:
        name = f"./published/{rng.choice(('', 'v2/'))}{part.prim.name}.vdb"
        part.prim.properties["filePath"] = Attribute("asset", name)
    return [part.prim for part in subject.fields]


@on_scene("STG011")
def variant_misspelt(scene: Scene, layer: Layer, rng: Random) -> Prim:
    written = rng.choice(("thik", "Thick", "thcik"))
    prim = Prim("selecting", "Xform")
    prim.metadata = [
        (f'variants = {{ string density = "{written}" }}',),
        ('prepend variantSets = "density"',),
    ]
    prim.variants = {"density": {"thick": [Prim("smoke", "Volume")], "none": []}}
    layer.prims.append(prim)
    return prim


@on_volume("STG012", needs={"place": "beside"})
def prototype_misspelt(subject: VolumeSubject, rng: Random) -> Prim:
    instancer = Prim("crowd", "PointInstancer")
    instancer.properties = {
        "prototypes": Relationship([f"{subject.path}s"]),
        "protoIndices": Attribute("int[]", [0]),
        "positions": Attribute("point3f[]", [(0, 0, 0)]),
    }
    subject.root.children.append(instancer)
    return instancer
