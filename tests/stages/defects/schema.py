"""How the schemas are used."""

from __future__ import annotations

from random import Random

from ..model import Attribute, Prim
from ..subjects import ParticleSubject
from .declaration import ONE_FILE, VolumeSubject, any_field, on_particles, on_volume


@on_volume("SCH001", needs=ONE_FILE)
def field_type_misspelt(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.type = rng.choice(("OpenVdbAsset", "OpenVDBFieldAsset", "OpenVDB", "VDBAsset"))
    return prim


@on_particles("SCH001")
def splat_type_misspelt(subject: ParticleSubject, rng: Random) -> None:
    subject.prim.type = rng.choice(("ParticleField3DGaussianSplats", "GaussianSplats"))
    subject.prim.metadata.clear()


@on_volume("SCH002", needs=ONE_FILE)
def abstract_field(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.type = rng.choice(("FieldAsset", "FieldBase"))
    return prim


@on_volume("SCH003", needs=ONE_FILE)
def path_is_a_string(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties["filePath"] = Attribute("string", "./cloud.vdb")
    return prim


@on_volume("SCH003", needs={"files": ("own sequence", "clips", "field3d")})
def index_is_a_float(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties["fieldIndex"] = Attribute("float", 0.0)
    return prim


@on_particles("SCH003", needs={"precision": "float"})
def positions_in_double(subject: ParticleSubject, rng: Random) -> None:
    subject.array("positions").type = "double3[]"


@on_particles("SCH003", needs={"precision": "float", "arrays": True})
def scales_are_colours(subject: ParticleSubject, rng: Random) -> None:
    subject.array("scales").type = "color3f[]"


@on_volume("SCH004", needs={"files": ("own sequence", "clips", "field3d")})
def index_misspelt(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties.pop("fieldIndex", None)
    name = rng.choice(("fieldindex", "feildIndex", "gridIndex", "field_index"))
    prim.properties[name] = Attribute("int", 0)
    return prim


@on_volume("SCH004", needs=ONE_FILE)
def path_misspelt(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    name = rng.choice(("filepath", "file_path", "fileName"))
    prim.properties[name] = prim.properties.pop("filePath")
    return prim


@on_particles("SCH004", needs={"arrays": True})
def opacities_misspelt(subject: ParticleSubject, rng: Random) -> None:
    array = subject.prim.properties.pop(subject.name_of("opacities"))
    subject.prim.properties[rng.choice(("opacitys", "opacity", "Opacities"))] = array


@on_particles("SCH004", needs={"arrays": True})
def positions_misspelt(subject: ParticleSubject, rng: Random) -> None:
    """As UsdGeom's Points call them, or with a slip: no particle is left."""
    array = subject.prim.properties.pop(subject.name_of("positions"))
    subject.prim.properties[rng.choice(("points", "postions", "Positions"))] = array


@on_volume("SCH005")
def data_type_not_allowed(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    token = rng.choice(("flaot", "vec3f", "Float", "float32", "half4"))
    prim.attribute("fieldDataType").value = token
    return prim


@on_volume("SCH005", needs=ONE_FILE)
def class_not_allowed(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    token = rng.choice(("GRID_FOG_VOLUME", "fog volume", "sdf", "LevelSet"))
    prim.properties["fieldClass"] = Attribute("token", token)
    return prim


@on_particles("SCH005", needs={"type": "ParticleField3DGaussianSplat"})
def sorting_not_allowed(subject: ParticleSubject, rng: Random) -> None:
    hint = Attribute("token", "depth", is_uniform=True)
    subject.prim.properties["sortingModeHint"] = hint


@on_volume("SCH006")
def purpose_animated(subject: VolumeSubject, rng: Random) -> None:
    purpose = Attribute("token", samples={1: "render", 2: "default"}, is_uniform=True)
    subject.prim.properties["purpose"] = purpose


@on_particles("SCH006", needs={"degree": 1})
def degree_animated(subject: ParticleSubject, rng: Random) -> None:
    degree = Attribute("int", 1, {1: 1, 2: 1}, is_uniform=True)
    subject.prim.properties["radiance:sphericalHarmonicsDegree"] = degree


@on_volume("SCH007")
def no_extent(subject: VolumeSubject, rng: Random) -> None:
    del subject.prim.properties["extent"]


@on_particles("SCH007")
def no_extent_of_particles(subject: ParticleSubject, rng: Random) -> None:
    del subject.prim.properties["extent"]


def _extent(subject: VolumeSubject | ParticleSubject, *corners: tuple[float, ...]) -> None:
    subject.prim.properties["extent"] = Attribute("float3[]", list(corners))


@on_volume("SCH008")
def extent_of_one_corner(subject: VolumeSubject, rng: Random) -> None:
    _extent(subject, (-9, -9, -9))


@on_volume("SCH008")
def extent_upside_down(subject: VolumeSubject, rng: Random) -> None:
    _extent(subject, (1e4, -1e4, -1e4), (-1e4, 1e4, 1e4))


@on_particles("SCH008")
def extent_not_finite(subject: ParticleSubject, rng: Random) -> None:
    nan = rng.choice((float("nan"), float("inf")))
    _extent(subject, (-9, -9, -9), (9, nan, 9))


@on_volume("SCH009")
def mesh_below_volume(subject: VolumeSubject, rng: Random) -> Prim:
    mesh = Prim("proxy", rng.choice(("Mesh", "Cube", "Points")))
    subject.prim.children.append(mesh)
    return mesh


@on_particles("SCH009")
def sphere_below_particles(subject: ParticleSubject, rng: Random) -> Prim:
    sphere = Prim("ball", "Sphere")
    subject.prim.children.append(Prim("group", "Xform", children=[sphere]))
    return sphere


@on_volume("SCH010")
def api_on_the_volume(subject: VolumeSubject, rng: Random) -> None:
    api = '"ParticleFieldOpacityAttributeAPI"'
    subject.prim.metadata.append((f"prepend apiSchemas = [{api}]",))


@on_volume("SCH011", needs={"place": "beside"})
def points_for_splats(subject: VolumeSubject, rng: Random) -> Prim:
    points = Prim("splats", "Points")
    points.metadata.append(('prepend apiSchemas = ["GaussiansAPI"]',))
    points.properties["points"] = Attribute("point3f[]", [(0, 0, 0)])
    subject.root.children.append(points)
    return points


@on_volume("SCH011", needs={"place": "beside"})
def training_parameters(subject: VolumeSubject, rng: Random) -> Prim:
    """The arrays of a checkpoint as they are, on a prim that nobody draws."""
    scope = Prim("checkpoint", "Scope")
    for name in ("positions", "scales", "rotations", "densities", "features_albedo"):
        scope.properties[name] = Attribute("float[]", [rng.uniform(-5, 5)])
    subject.root.children.append(scope)
    return scope
