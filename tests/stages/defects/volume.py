"""Volumes and their relationships."""

from __future__ import annotations

from random import Random

from ..model import Attribute, File, Layer, Relationship
from ..subjects import FieldPart
from .declaration import ONE_FILE, Prim, VolumeSubject, any_field, extent_for_all, on_volume


def _bound(subject: VolumeSubject, rng: Random) -> FieldPart:
    """A field that is bound directly, so that nothing is left over when its relationship goes."""
    part = any_field(subject, rng)
    subject.prim.properties.pop(f"to:{part.prim.name}", None)
    subject.prim.properties[part.relationship] = Relationship([part.path])
    return part


def _retarget(subject: VolumeSubject, rng: Random, *targets: str) -> None:
    part = _bound(subject, rng)
    subject.prim.properties[part.relationship] = Relationship(list(targets))


@on_volume("VOL001")
def target_missing(subject: VolumeSubject, rng: Random) -> None:
    _retarget(subject, rng, f"{subject.path}/gone")


@on_volume("VOL002")
def target_is_a_material(subject: VolumeSubject, rng: Random) -> None:
    subject.prim.children.append(Prim("look", "Material"))
    _retarget(subject, rng, f"{subject.path}/look")


@on_volume("VOL002")
def target_is_the_volume(subject: VolumeSubject, rng: Random) -> None:
    _retarget(subject, rng, subject.path)


@on_volume("VOL002")
def target_has_no_type(subject: VolumeSubject, rng: Random) -> None:
    part = any_field(subject, rng)
    part.prim.type = ""


@on_volume("VOL003")
def no_target(subject: VolumeSubject, rng: Random) -> None:
    _retarget(subject, rng)


@on_volume("VOL003", is_info=True)
def target_blocked(subject: VolumeSubject, rng: Random) -> None:
    relationship = _bound(subject, rng).relationship
    subject.prim.properties[relationship] = Relationship(None)


@on_volume("VOL003")
def target_in_a_circle(subject: VolumeSubject, rng: Random) -> None:
    relationship = _bound(subject, rng).relationship
    subject.prim.properties["back"] = Relationship([f"{subject.path}.{relationship}"])
    subject.prim.properties[relationship] = Relationship([f"{subject.path}.back"])


@on_volume("VOL004", needs={"fields": (2, 3, 4)})
def two_targets(subject: VolumeSubject, rng: Random) -> None:
    one = _bound(subject, rng)
    other = next(each for each in subject.fields if each is not one)
    subject.prim.properties[one.relationship] = Relationship([one.path, other.path])


@on_volume("VOL005")
def target_is_an_attribute(subject: VolumeSubject, rng: Random) -> None:
    part = _bound(subject, rng)
    subject.prim.properties[part.relationship] = Relationship([f"{part.path}.fieldName"])


@on_volume("VOL006")
def attribute_for_relationship(subject: VolumeSubject, rng: Random) -> None:
    part = _bound(subject, rng)
    subject.prim.properties[part.relationship] = Attribute("string", part.path)


@on_volume("VOL006")
def outside_the_namespace(subject: VolumeSubject, rng: Random) -> None:
    part = _bound(subject, rng)
    del subject.prim.properties[part.relationship]
    subject.prim.properties[part.prim.name] = Relationship([part.path])


@on_volume("VOL007", needs={"place": "beside"})
def field_outside_of_what_is_referenced(subject: VolumeSubject, rng: Random) -> Prim:
    source = File(subject.layer.path)
    line = ("prepend references = ", source, f"<{subject.path}>")
    prim = Prim(f"{subject.root.name}_alone", metadata=[line])
    layer = Layer(f"{prim.name}.usda", [prim])
    subject.content.layers.append(layer)
    subject.layer = layer
    return prim


@on_volume("VOL008")
def field_inactive(subject: VolumeSubject, rng: Random) -> None:
    any_field(subject, rng).prim.metadata.append(("active = false",))


@on_volume("VOL008")
def field_undefined(subject: VolumeSubject, rng: Random) -> None:
    any_field(subject, rng).prim.specifier = "over"


@on_volume("VOL008")
def field_abstract(subject: VolumeSubject, rng: Random) -> None:
    any_field(subject, rng).prim.specifier = "class"


@on_volume("VOL009")
def name_nested(subject: VolumeSubject, rng: Random) -> None:
    part = any_field(subject, rng)
    bound = subject.prim.properties.pop(part.relationship)
    subject.prim.properties[f"field:gas:{part.prim.name}"] = bound


@on_volume("VOL010", needs={"place": ("below", "group")})
def field_unbound(subject: VolumeSubject, rng: Random) -> None:
    properties = subject.prim.properties
    subject.prim.properties = {
        name: each for name, each in properties.items() if not isinstance(each, Relationship)
    }


@on_volume("VOL011", needs={"place": "beside"}, is_info=True)
def field_outside(subject: VolumeSubject, rng: Random) -> None:
    pass


@on_volume("VOL012", is_info=True)
def field_unused(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    unused = Prim("unused", part.prim.type, properties=dict(part.prim.properties))
    subject.prim.children.append(unused)
    unused.properties["filePath"] = Attribute("asset", File(part.source.path))
    return unused


_WITH_VOXELS = {"files": ("own sequence", "clips", "template clips", "field3d")}


@on_volume("VOL013", needs=_WITH_VOXELS)
def extent_elsewhere(subject: VolumeSubject, rng: Random) -> None:
    corners = [(100, 0, 0), (101, 1, 1)]
    subject.prim.properties["extent"] = Attribute("float3[]", corners)


@on_volume("VOL013", needs=_WITH_VOXELS)
def extent_cuts_one_side(subject: VolumeSubject, rng: Random) -> None:
    is_moved = any("xformOp:translate" in part.prim.properties for part in subject.fields)
    extent = subject.prim.attribute("extent")
    (x, y, _), high = next(extent.each())
    subject.prim.properties["extent"] = Attribute(
        "float3[]", [(x, y, 0.8 if is_moved else 0.55), high]
    )


@on_volume("VOL014", needs={"files": "several", "fields": (2, 3)}, is_info=True)
def mixed_files(subject: VolumeSubject, rng: Random) -> None:
    pass


@on_volume("VOL015", needs={"place": "beside", **ONE_FILE}, is_info=True)
def volume_moved_alone(subject: VolumeSubject, rng: Random) -> None:
    extent_for_all(subject)
    subject.prim.properties["xformOp:translate"] = Attribute("double3", (0, 3, 0))
    order = Attribute("token[]", ["xformOp:translate"], is_uniform=True)
    subject.prim.properties["xformOpOrder"] = order
