"""What UsdGeom says of a prim, or of one above it: purpose, visibility, transform, time range."""

from __future__ import annotations

from random import Random

from ..model import Attribute, Layer, Prim, Scene
from ..subjects import ParticleSubject, Subject
from .declaration import VolumeSubject, on_particles, on_scene, on_volume

_NAN = float("nan")


def _self_or_root(subject: Subject, rng: Random) -> Prim:
    """The prim itself, or the one above it, which need not be another."""
    return rng.choice((subject.prim, subject.root))


@on_volume("SCH005")
def purpose_not_allowed(subject: VolumeSubject, rng: Random) -> Prim:
    prim = _self_or_root(subject, rng)
    token = rng.choice(("Render", "final", "preview"))
    subject.prim.properties.pop("purpose", None)  # its own, which would hold in place of this
    prim.properties["purpose"] = Attribute("token", token, is_uniform=True)
    return prim


@on_particles("SCH005")
def visibility_not_allowed(subject: ParticleSubject, rng: Random) -> Prim:
    prim = _self_or_root(subject, rng)
    prim.properties["visibility"] = Attribute("token", rng.choice(("hidden", "visible", "off")))
    return prim


def _transform(prim: Prim, order: list[str], **values: Attribute) -> None:
    prim.properties |= {f"xformOp:{name}": value for name, value in values.items()}
    prim.properties["xformOpOrder"] = Attribute("token[]", order, is_uniform=True)


@on_volume("SCH015", needs={"movement": "none"})
def op_not_there(subject: VolumeSubject, rng: Random) -> Prim:
    subject.root.type = "Volume" if subject.root is subject.prim else "Xform"
    prim = _self_or_root(subject, rng)
    _transform(
        prim,
        ["xformOp:translate", rng.choice(("xformOp:rotateXYZ", "!invert!xformOp:scale"))],
        translate=Attribute("double3", (0, 0, 0)),
    )
    return prim


@on_particles("SCH015")
def transform_not_finite(subject: ParticleSubject, rng: Random) -> Prim:
    prim = subject.prim
    if rng.random() < 0.5:
        _transform(
            prim,
            ["xformOp:scale"],
            scale=Attribute("float3", samples={1: (1, 1, 1), 2: (1, _NAN, 1)}),
        )
    else:
        _transform(prim, ["xformOp:orient"], orient=Attribute("quatf", (_NAN, 0, 0, float("inf"))))
    return prim


@on_scene("STG007")
def range_reversed(scene: Scene, layer: Layer, rng: Random) -> None:
    kept = [line for line in layer.metadata if "TimeCode" not in str(line[0])]
    layer.metadata = [*kept, ("startTimeCode = 1048",), (f"endTimeCode = {rng.choice((1, 1001))}",)]
