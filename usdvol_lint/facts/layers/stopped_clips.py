"""Value clips on an instance or above one, which do not reach into its prototype."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from pxr import Sdf, Usd

from usdvol_lint.facts.layers.clip_bearers import ClippedPlace
from usdvol_lint.facts.layers.lost_clips import without_samples
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.clips import ClipSet, clip_sets_on, is_from_clips
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.instances import in_prototype


class StoppedClips(NamedTuple):
    """The clips of an instance or a prim above it, as its strongest `carrier` names them.

    `attributes`, at least one, would have values of the clips if `prim` were no instance; `spec`
    is that which makes it one.
    """

    prim: Any
    spec: Any
    carrier: Any
    attributes: tuple[Any, ...]

    @property
    def without_value(self) -> tuple[Any, ...]:
        """Those of the attributes that have no value at all."""
        return tuple(attribute for attribute in self.attributes if attribute.Get() is None)


def find_stopped(
    stage: Any, tables: Tables, places: Iterable[ClippedPlace]
) -> Iterator[StoppedClips]:
    """What stops at instances, by prototypes and the prims with clips above each of them."""
    for place in places:
        still = {prim: list(without_samples(tables, prim)) for prim in place.prims}
        yield from _stopped(stage, place, still)


def _stopped(
    stage: Any, place: ClippedPlace, still: dict[Any, list[Any]]
) -> Iterator[StoppedClips]:
    """What the clips at and above a path bring where it is, like those above, no instance."""
    found: dict[Any, list[Any]] = defaultdict(list)
    freed = _freed(stage, place.path)
    if freed is None:
        return
    for prim, attributes in still.items():
        other = freed.GetPrimAtPath(place.on_stage(prim))
        for attribute in attributes if other else ():
            moving = other.GetAttribute(attribute.GetName())
            if moving and is_from_clips(moving):
                found[_carrier(moving)].append(attribute)
    instance = in_prototype(stage.GetPrimAtPath(place.path))
    for carrier, lost in found.items():
        yield StoppedClips(instance, _first_with(instance, "instanceable"), carrier, tuple(lost))


def _freed(stage: Any, path: Any) -> Any | None:
    """The stage around a path, without the instances there and above; None if clips do not open."""
    session = Sdf.Layer.CreateAnonymous(".usda")
    if stage.GetSessionLayer():
        session.subLayerPaths.append(stage.GetSessionLayer().identifier)
    for prefix in path.GetPrefixes():
        Sdf.CreatePrimInLayer(session, prefix)
        if stage.GetPrimAtPath(prefix).IsInstance():
            session.GetPrimAtPath(prefix).SetInfo("instanceable", False)
    mask = Usd.StagePopulationMask([path])
    context = stage.GetPathResolverContext()
    try:
        return Usd.Stage.OpenMasked(stage.GetRootLayer(), session, context, mask)
    except UNREADABLE:
        return None  # USD makes a manifest where there is none, and so opens the clips


def _carrier(attribute: Any) -> Any:
    """The strongest spec with the clips that an attribute has its values of."""
    prim = attribute.GetPrim()
    bearers: list[ClipSet] = []
    while not prim.IsPseudoRoot():
        bearers += clip_sets_on(prim)
        prim = prim.GetParent()
    certain = (each for each in bearers if each.layer_with_samples(attribute))
    return _first_with(next(certain, bearers[0]).prim, "clips")


def _first_with(prim: Any, key: str) -> Any:
    """The strongest spec of a prim that authors this, or the strongest."""
    stack = prim.GetPrimStack()
    return next((spec for spec in stack if spec.HasInfo(key)), stack[0])
