"""What an `over` that nothing defines takes off the stage."""

from __future__ import annotations

from random import Random

from ..model import Attribute, Layer, Prim, Scene
from ..subjects import ParticleSubject, VolumeSubject
from .declaration import ONE_FILE, any_field, on_particles, on_scene, on_volume

_NAMES = (("fx", "FX"), ("effects", "efects"), ("Effects", "Effetcs"), ("smoke", "smokes"))
_HIDING = ("inherited", "prototype below over")


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


@on_volume("STG010", needs={**ONE_FILE, "place": "below"}, without=_HIDING)
def override_of_another_case(subject: VolumeSubject, rng: Random) -> Prim:
    return _override(subject, any_field(subject, rng).prim.name.swapcase())


@on_volume("STG010", needs={**ONE_FILE, "place": "below"}, without=_HIDING)
def override_of_a_near_name(subject: VolumeSubject, rng: Random) -> Prim:
    name = any_field(subject, rng).prim.name
    return _override(subject, f"{name}s" if len(name) > 4 else name.upper())


def _override(subject: VolumeSubject, name: str) -> Prim:
    over = Prim(name, specifier="over")
    over.properties["filePath"] = Attribute("asset", "./another.vdb")
    subject.prim.children.append(over)
    return over
