"""Prims that stand beside what a stage is about and are nothing to the rules.

Add one by writing a function with `@neighbour` that returns the prim.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from .model import Attribute, Prim, Relationship

Make = Callable[[Random], Prim]


@dataclass(frozen=True)
class Neighbour:
    name: str
    make: Make


def neighbour(make: Make) -> Neighbour:
    return Neighbour(make.__name__.replace("_", " "), make)


def _broken_volume(name: str) -> Prim:
    """A Volume that is wrong in many ways, for places where nobody looks."""
    field = Prim("density", "OpenVDBAsset")
    field.properties = {
        "filePath": Attribute("asset", "./there/is/none.vdb"),
        "fieldDataType": Attribute("token", "flaot"),
    }
    volume = Prim(name, "Volume", children=[field])
    volume.properties["field:density"] = Relationship(["/nowhere", "/elsewhere"])
    return volume


@neighbour
def inactive(rng: Random) -> Prim:
    prim = Prim("switched_off", "Xform", children=[_broken_volume("cloud")])
    prim.metadata.append(("active = false",))
    return prim


@neighbour
def abstract(rng: Random) -> Prim:
    return Prim("_class_unused", specifier="class", children=[_broken_volume("cloud")])


@neighbour
def undefined(rng: Random) -> Prim:
    return Prim("overs", specifier="over", children=[_broken_volume("cloud")])


@neighbour
def library_below_over(rng: Random) -> Prim:
    """Parts that an arc brings onto the stage, and others; the `over` is named like a sibling."""
    parts = [Prim(name, "Volume") for name in ("puff", "unused")]
    library = Prim("stock", specifier="over", children=parts)
    arc = rng.choice(("references", "inherits", "specializes", "payload"))
    used = Prim("used", metadata=[(f"{arc} = </shelf/stock/puff>",)])
    used.properties["extent"] = Attribute("float3[]", [(-9, -9, -9), (9, 9, 9)])
    return Prim("shelf", "Xform", children=[Prim("Stock", "Xform"), library, used])


@neighbour
def over_below_class(rng: Random) -> Prim:
    over = Prim("fx", specifier="over", children=[_broken_volume("cloud")])
    return Prim("_class_fx", specifier="class", children=[Prim("FX", "Xform"), over])


@neighbour
def unselected(rng: Random) -> Prim:
    prim = Prim("choice", "Xform")
    prim.metadata = [
        ('variants = { string look = "none" }',),
        ('prepend variantSets = "look"',),
    ]
    prim.variants = {"look": {"none": [], "thick": [_broken_volume("cloud")]}}
    return prim


@neighbour
def mesh(rng: Random) -> Prim:
    prim = Prim("ground", "Mesh")
    prim.properties = {
        "points": Attribute("point3f[]", [(0, 0, 0), (1, 0, 0), (0, 1, 0)]),
        "faceVertexCounts": Attribute("int[]", [3]),
        "faceVertexIndices": Attribute("int[]", [0, 1, 2]),
    }
    return prim


@neighbour
def camera(rng: Random) -> Prim:
    return Prim("rig", "Xform", children=[Prim("shot", "Camera")])


@neighbour
def points(rng: Random) -> Prim:
    prim = Prim("spray", "Points")
    prim.properties = {
        "points": Attribute("point3f[]", [(0, 0, 0), (1, 2, 3)]),
        "widths": Attribute("float[]", [0.1, 0.2]),
        "primvars:age": Attribute("float[]", [1, 2]),
    }
    return prim


@neighbour
def shown_by_renderer(rng: Random) -> Prim:
    """A Volume without a field, which some renderers fill by themselves."""
    prim = Prim("fog", "Volume")
    prim.properties["extent"] = Attribute("float3[]", [(-9, -9, -9), (9, 9, 9)])
    return prim


@neighbour
def other_schema(rng: Random) -> Prim:
    prim = Prim("dataset", "CaeDataSet")
    prim.properties["field:density"] = Relationship(["/nowhere"])
    return prim


@neighbour
def later_version(rng: Random) -> Prim:
    """Types with a version behind their names, which a plugin may declare elsewhere."""
    field = Prim("density", rng.choice(("OpenVDBAsset2", "OpenVDBAssetV2")))
    field.properties["filePath"] = Attribute("asset", "./there/is/none.vdb")
    volume = Prim("later", "VolumeV2", children=[field])
    volume.properties["field:density"] = Relationship(["/nowhere"])
    return volume


def class_of_others(rng: Random) -> Prim:
    """An arc to a class that nobody has authored yet."""
    arc = rng.choice(("inherits", "specializes"))
    return Prim("heir", "Xform", metadata=[(f"prepend {arc} = </_class_of_nobody>",)])


NEIGHBOURS = tuple(each for each in globals().values() if isinstance(each, Neighbour))
