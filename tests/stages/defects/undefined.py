"""What an `over` that nothing defines takes off the stage."""

from __future__ import annotations

from random import Random

from ..model import Attribute, Layer, Prim, Scene
from ..subjects import ParticleSubject, VolumeSubject
from .declaration import ONE_FILE, any_field, on_particles, on_scene, on_volume

_NAMES = (("fx", "FX"), ("effects", "efects"), ("Effects", "Effetcs"), ("smoke", "smokes"))


def _slip(rng: Random) -> list[Prim]:
    """A prim, and an `over` that was meant to be one on it."""
    name, written = rng.choice(_NAMES)
    lost = Prim("lost", rng.choice(("Volume", "ParticleField3DGaussianSplat", "OpenVDBAsset")))
    between = Prim("group", rng.choice(("", "Xform")), children=[lost])
    children = rng.choice(([lost], [between]))
    return [Prim(name, "Xform"), Prim(written, specifier="over", children=children)]


@on_volume("STG005")
def over_below_a_volumes_root(subject: VolumeSubject, rng: Random) -> Prim:
    subject.root.children += (added := _slip(rng))
    return added[1]


@on_particles("STG005")
def over_below_a_splats_root(subject: ParticleSubject, rng: Random) -> Prim:
    subject.root.children += (added := _slip(rng))
    return added[1]


@on_scene("STG005")
def over_at_the_root(scene: Scene, layer: Layer, rng: Random) -> Prim:
    layer.prims += (added := _slip(rng))
    return added[1]


@on_volume("STG005", is_info=True)
def over_unlike_its_siblings(subject: VolumeSubject, rng: Random) -> Prim:
    _, over = _slip(rng)
    subject.root.children.append(over)
    return over


@on_volume("STG010", needs=ONE_FILE)
def override_of_another_case(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    over = Prim(prim.name.swapcase(), specifier="over")
    over.properties["filePath"] = Attribute("asset", "./another.vdb")
    subject.prim.children.append(over)
    return over


@on_particles("STG010")
def override_of_a_near_name(subject: ParticleSubject, rng: Random) -> Prim:
    over = Prim(subject.root.name.swapcase(), specifier="over", children=[])
    below = over
    for name in subject.path.split("/")[2:]:
        below.children.append(below := Prim(name, specifier="over"))
    below.properties["extent"] = Attribute("float3[]", [(-2e6, -2e6, -2e6), (2e6, 2e6, 2e6)])
    subject.layer.prims.append(over)
    return over
