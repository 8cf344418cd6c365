"""Value clips that USD does not use, or that stay behind."""

from __future__ import annotations

import re
from random import Random

from ..model import Line, Prim
from .declaration import VolumeSubject, on_volume

_NAMED = {"files": "clips"}


def _bearer(subject: VolumeSubject) -> Prim:
    """The prim with the clips."""
    prims = (subject.root, subject.prim)
    return next(
        prim for prim in prims if any("clips = {" in str(line[0]) for line in prim.metadata)
    )


def _rewrite(subject: VolumeSubject, key: str, *lines: Line) -> Prim:
    """The prim with the clips, whose entry for a key is now another, or gone."""
    prim = _bearer(subject)
    number = next(n for n, line in enumerate(prim.metadata) if f" {key} =" in str(line[0]))
    prim.metadata[number : number + 1] = lines
    return prim


@on_volume("AST016", needs=_NAMED)
def clips_without_active(subject: VolumeSubject, rng: Random) -> Prim:
    return _rewrite(subject, "active")


@on_volume("AST016", needs=_NAMED)
def clip_index_from_one(subject: VolumeSubject, rng: Random) -> Prim:
    prim = _bearer(subject)
    [active] = [str(line[0]) for line in prim.metadata if " active =" in str(line[0])]
    return _rewrite(
        subject, "active", (re.sub(r", (\d+)\)", lambda m: f", {int(m[1]) + 1})", active),)
    )


@on_volume("AST016", needs={"files": ("clips", "template clips")})
def clips_elsewhere(subject: VolumeSubject, rng: Random) -> Prim:
    path = rng.choice(("/Nowhere", "nowhere", "", "/nowhere/else"))
    return _rewrite(subject, "primPath", (f'string primPath = "{path}"',))


@on_volume("AST016", needs={"files": "template clips"})
def stride_of_zero(subject: VolumeSubject, rng: Random) -> Prim:
    return _rewrite(subject, "templateStride", ("double templateStride = 0",))


_BELOW_A_GROUP = {
    "files": ("clips", "template clips"),
    "place": ("below", "group"),
    "movement": "group",
}


@on_volume("AST016", needs=_BELOW_A_GROUP)
def clips_left_behind(subject: VolumeSubject, rng: Random) -> Prim:
    """A field that is taken from below the prim with the clips."""
    taken = Prim("taken", metadata=[(f"references = <{rng.choice(subject.fields).path}>",)])
    subject.root.children.append(taken)
    return taken


@on_volume("AST018", needs={"files": "clips", "fields": 1})
def clip_without_value(subject: VolumeSubject, rng: Random) -> Prim:
    """A clip in the middle that has nothing for the field; it may bring several frames."""
    [part] = subject.fields
    middle = rng.choice(part.clips[1:-1])
    middle.samples.clear()
    return part.prim
