"""The prims with value clips, and those of ours below, also in instances that no clips reach."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Generator, Iterable, Iterator
from typing import Any, NamedTuple, TypeAlias

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.clips import Clips
from usdvol_lint.facts.usd.instances import instances_of, path_in_prototype, prototype_of, tell_cut
from usdvol_lint.facts.usd.settled import settle

_Places: TypeAlias = dict[tuple[Any, ...], str]

_MOST_PLACES = 100
"""So many groups of prims with clips are told apart: a stage is opened for each."""


def decided_bearers(
    tables: Tables, clips: Clips, instanced: Iterable[tuple[Any, Any]]
) -> Iterator[tuple[Any, list[Any]]]:
    """The prims with clip sets, each with those of ours that it reaches.

    `instanced` are more such pairs, in instances, of a prim with clips and one of ours.
    Left out are those on which an unselected variant may still say something.
    """
    prims = [prim for table in tables.of(*schema.OURS) for prim in table.prims]
    below: dict[Any, list[Any]] = {}
    for prim in prims:
        for bearer in clips.bearers(prim):
            below.setdefault(bearer, []).append(prim)
    for bearer, prim in instanced:
        below.setdefault(bearer, []).append(prim)
    return ((bearer, ours) for bearer, ours in below.items() if not _is_undecided(bearer))


class ClippedPlace(NamedTuple):
    """The first path of a prototype below some prims with clips, and the prims of ours in it."""

    path: Any
    prims: tuple[Any, ...]

    def on_stage(self, prim: Any) -> Any:
        """The path of one of the prims there."""
        return Sdf.Path(f"{self.path}{path_in_prototype(prim)}")


def clipped_places(tables: Tables) -> tuple[ClippedPlace, ...]:
    """Where prototypes with prims of ours appear at or below clips, each group of these once."""
    inside: dict[Any, list[Any]] = defaultdict(list)
    for table in tables.of(*schema.OURS):
        for prim in filter(Usd.Prim.IsInPrototype, table.prims):
            inside[prototype_of(prim)].append(prim)
    return tuple(
        ClippedPlace(Sdf.Path(path), tuple(prims))
        for prototype, prims in inside.items()
        for path in _first_paths(prototype)
    )


def bearers_above(stage: Any, places: Iterable[ClippedPlace]) -> Iterator[tuple[Any, Any]]:
    """The prims with clips at and above places, each with each prim of ours that is there.

    USD lets no clips reach there; what is wrong with the clips themselves is told all the same.
    """
    for place in places:
        for bearer in _bearers(stage.GetPrimAtPath(place.path)):
            for prim in place.prims:
                yield bearer, stage.GetPrimAtPath(place.on_stage(prim))


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
        left_out: set[tuple[Any, ...]] = set()
        for instance in instances_of(prototype):
            own, around = _bearers(instance), {(): ""}
            if instance.IsInPrototype():
                outer = prototype_of(instance)
                if outer not in known:
                    yield outer
                around = known[outer]
            below = path_in_prototype(instance)
            for above, path in around.items():
                group, place = own + above, path + below
                if len(first) < _MOST_PLACES or group in first:
                    first[group] = min(place, first.get(group, place))
                else:
                    left_out.add(group)
        if left_out:
            _tell_left_out(prototype, len(first), len(left_out))
        return first

    return sorted(path for above, path in settle(prototype, find, known).items() if above)


def _tell_left_out(prototype: Any, kept: int, left_out: int) -> None:
    tell_cut(
        prototype,
        f"whether value clips reach it was looked at below {kept:,} of {kept + left_out:,} groups "
        "of prims with clips that it stands below",
    )


def _is_undecided(prim: Any) -> bool:
    """Whether a variant set of the prim, or of one above it, has no selection."""
    while not prim.IsPseudoRoot():
        sets = prim.GetVariantSets()
        if any(not sets.GetVariantSelection(name) for name in sets.GetNames()):
            return True
        prim = prim.GetParent()
    return False
