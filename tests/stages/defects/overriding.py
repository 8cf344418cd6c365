"""What a stronger opinion takes away, and what it fails to say."""

from __future__ import annotations

from random import Random

from ..model import Attribute, Layer, Prim, Relationship, overs
from ..particles import APIS
from ..subjects import ParticleSubject, Subject
from .declaration import ONE_FILE, VolumeSubject, any_field, on_particles, on_volume

_APPLIED = {"type": "ParticleField", "arrays": True}


def _hide(subject: Subject, prim: Prim, rng: Random) -> None:
    """The prim's own type comes from a class, and it says another."""
    source = Prim(f"_class_{prim.name}", prim.type, specifier="class")
    subject.layer.prims.append(source)
    prim.metadata.append((f"{rng.choice(('inherits', 'specializes'))} = </{source.name}>",))
    prim.type = rng.choice(("Xform", "Scope"))


@on_volume("SCH012")
def volume_hidden(subject: VolumeSubject, rng: Random) -> None:
    subject.root.children = [
        child for child in subject.root.children if not child.name.endswith("_twin")
    ]
    _hide(subject, subject.prim, rng)


@on_volume("SCH012", needs=ONE_FILE)
def field_hidden(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    _hide(subject, prim, rng)
    return prim


@on_particles("SCH012")
def splat_hidden(subject: ParticleSubject, rng: Random) -> None:
    _hide(subject, subject.prim, rng)


def _over(subject: Subject, path: str) -> Prim:
    """A stronger over of a prim: all prims move into a sublayer of the subject's layer."""
    base = Layer(subject.layer.path.replace(".", "_base."), subject.layer.prims)
    subject.content.layers.append(base)
    subject.layer.add_sublayer(base.path)
    topmost, over = overs(path)
    subject.layer.prims = [topmost]
    return over


@on_volume("SCH004", needs=ONE_FILE)
def path_misspelt_in_an_override(subject: VolumeSubject, rng: Random) -> Prim:
    over = _over(subject, any_field(subject, rng).path)
    name = rng.choice(("filepath", "file_path", "fileName"))
    over.properties[name] = Attribute("asset", "./another.vdb")
    return over


@on_particles("SCH004", needs={"precision": "float", "arrays": True})
def opacities_misspelt_in_an_override(subject: ParticleSubject, rng: Random) -> Prim:
    over = _over(subject, subject.path)
    over.properties["opacitys"] = Attribute("float[]", [0.125])
    return over


@on_particles("PRT010", needs=_APPLIED)
def apis_replaced(subject: ParticleSubject, rng: Random) -> Prim:
    over = _over(subject, subject.path)
    over.metadata.append(('apiSchemas = ["MaterialBindingAPI"]',))
    return over


@on_particles("PRT010", needs=_APPLIED)
def api_deleted(subject: ParticleSubject, rng: Random) -> Prim:
    over = _over(subject, subject.path)
    deleted = rng.choice([api for api in APIS if "Position" in api or "Harmonics" in api])
    over.metadata.append((f'delete apiSchemas = ["{deleted}"]',))
    return over


def _override_an_instance(subject: Subject, rng: Random) -> Prim:
    """The subject becomes the class of an instance, below which there is an over of it."""
    root, prim = subject.root, subject.prim
    source = Prim(f"_class_{root.name}", "Xform", "class", children=[prim])
    over = Prim(prim.name, specifier="over")
    line = (f"inherits = </{source.name}>",)
    instance = Prim("copy", metadata=[("instanceable = true",), line], children=[over])
    if prim is root:
        subject.layer.prims[0] = Prim(root.name, "Xform", children=[instance])
    else:
        root.children = [instance]
    subject.layer.prims.append(source)
    for each in prim.properties.values():
        if isinstance(each, Relationship) and each.targets:
            moved = f"/{source.name}/{prim.name}"
            each.targets = [moved + target[len(subject.path) :] for target in each.targets]
    return over


@on_volume("STG006", needs={**ONE_FILE, "place": "below", "twin": False}, without=("inherited",))
def extent_below_an_instance(subject: VolumeSubject, rng: Random) -> Prim:
    over = _override_an_instance(subject, rng)
    over.properties["extent"] = Attribute("float3[]", [(-2e6, -2e6, -2e6), (2e6, 2e6, 2e6)])
    return over


@on_particles("STG006", needs={"arrays": True}, without=("inherited",))
def opacities_below_an_instance(subject: ParticleSubject, rng: Random) -> Prim:
    over = _override_an_instance(subject, rng)
    name = subject.name_of("opacities")
    over.properties[name] = Attribute(subject.prim.attribute(name).type, [0.125] * subject.count)
    return over
