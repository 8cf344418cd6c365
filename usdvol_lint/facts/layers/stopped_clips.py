"""Value clips on an instance or above one, which do not reach into its prototype."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Generator, Iterable, Iterator
from typing import Any, NamedTuple, TypeAlias

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.layers.lost_clips import without_samples
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.clips import ClipSet, clip_sets_on, is_from_clips
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.instances import (
    in_prototype,
    instances_of,
    path_in_prototype,
    prototype_of,
)
from usdvol_lint.facts.usd.settled import settle

_Places: TypeAlias = dict[tuple[Any, ...], str]

_MOST_PLACES = 100
"""So many groups of prims with clips are told apart: a stage is opened for each."""


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


def find_stopped(stage: Any, tables: Tables) -> Iterator[StoppedClips]:
    """What stops at instances, by prototypes and the prims with clips above each of them."""
    inside: dict[Any, list[Any]] = defaultdict(list)
    for table in tables.of(*schema.OURS):
        for prim in filter(Usd.Prim.IsInPrototype, table.prims):
            inside[prototype_of(prim)].append(prim)
    for prototype, prims in inside.items():
        for path in _first_paths(prototype):
            still = {prim: list(without_samples(tables, prim)) for prim in prims}
            yield from _stopped(stage, Sdf.Path(path), still)


def _bearers(prim: Any) -> tuple[Any, ...]:
    """A prim and its ancestors, those of them on which clip sets are authored."""
    found = []
    while not prim.IsPseudoRoot():
        if prim.HasAuthoredMetadata("clips"):
            found.append(prim)
        prim = prim.GetParent()
    return tuple(found)


def _first_paths(prototype: Any) -> Iterable[str]:
    """The first path at which the prototype appears below each group of prims with clips."""
    known: dict[Any, _Places] = {}

    def find(prototype: Any) -> Generator[Any, None, _Places]:
        first: _Places = {}
        for instance in instances_of(prototype):
            own, around = _bearers(instance), {(): ""}
            if instance.IsInPrototype():
                outer = prototype_of(instance)
                if outer not in known:
                    yield outer
                around = known[outer]
            below = path_in_prototype(instance)
            for above, path in around.items():
                if len(first) < _MOST_PLACES or own + above in first:
                    group, place = own + above, path + below
                    first[group] = min(place, first.get(group, place))
        return first

    return sorted(path for above, path in settle(prototype, find, known).items() if above)


def _stopped(stage: Any, path: Any, still: dict[Any, list[Any]]) -> Iterator[StoppedClips]:
    """What the clips at and above a path bring where it is, like those above, no instance."""
    found: dict[Any, list[Any]] = defaultdict(list)
    freed = _freed(stage, path)
    if freed is None:
        return
    for prim, attributes in still.items():
        other = freed.GetPrimAtPath(Sdf.Path(f"{path}{path_in_prototype(prim)}"))
        for attribute in attributes if other else ():
            moving = other.GetAttribute(attribute.GetName())
            if moving and is_from_clips(moving):
                found[_carrier(moving)].append(attribute)
    instance = in_prototype(stage.GetPrimAtPath(path))
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
