"""Gprims above and below a prim: USD has each of them be a leaf among its kind."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_children, get_parent, get_type
from usdvol_lint.facts.usd.kinds import PrimKinds

_UNKNOWN = object()


class Nested(NamedTuple):
    """A Gprim below another; `place` is to blame: itself, or the instance that holds it."""

    gprim: Any
    place: Any


class Nesting:
    """Finds Gprims above and below prims, each ancestor looked at once."""

    def __init__(self, kinds: PrimKinds) -> None:
        self._kinds = kinds
        self._at_or_above: dict[Any, Any | None] = {}
        self._gprims: dict[str, bool] = {}

    def above(self, prim: Any) -> Any | None:
        """The nearest Gprim among the ancestors, those of the instances of a prototype too."""
        return self._from(get_parent(prim))

    def _from(self, prim: Any) -> Any | None:
        """The nearest Gprim from a prim upwards."""
        found = self._at_or_above.get(prim, _UNKNOWN)
        if found is _UNKNOWN:
            found = self._at_or_above[prim] = self._find_at_or_above(prim)
        return found

    def are_likely(self, batch: PrimBatch) -> list[bool]:
        """Whether there is a Gprim above or below, Volumes and particle fields counted too."""
        return [
            bool(self._from(parent)) or self._hold_gprims(children)
            for parent, children in zip(batch.parents, batch.children, strict=True)
        ]

    def below(self, prim: Any) -> Iterator[Nested]:
        """The topmost Gprims below, one for each instance; Volumes and particle fields speak for
        themselves and what is below them.
        """
        places = set()
        for descendant in self._topmost_gprims(prim):
            instance = _instance_above(descendant)
            place = descendant if instance == prim else instance
            speaks = self._kinds.is_a(descendant, schema.VOLUME)
            speaks = speaks or self._kinds.is_a(descendant, schema.PARTICLE_FIELD)
            if not speaks and place not in places:
                places.add(place)
                yield Nested(descendant, place)

    def _topmost_gprims(self, prim: Any) -> Iterator[Any]:
        # The end of a PrimRange takes longer than to look at a Volume with its fields.
        for child in get_children(prim, WITH_INSTANCES):
            if self._is_gprim(child):
                yield child
            else:
                yield from self._topmost_gprims(child)

    def _hold_gprims(self, prims: Sequence[Any]) -> bool:
        for prim in prims:
            if self._is_gprim(prim):
                return True
            below = get_children(prim, WITH_INSTANCES)
            if below and self._hold_gprims(below):
                return True
        return False

    def _is_gprim(self, prim: Any) -> bool:
        """By the type alone: no applied schema makes a Gprim."""
        type_name = get_type(prim)
        found = self._gprims.get(type_name)
        if found is None:
            found = self._gprims[type_name] = schema.GPRIM in self._kinds.names((type_name,))
        return found

    def _find_at_or_above(self, prim: Any) -> Any | None:
        if prim.IsPseudoRoot() or self._is_gprim(prim):
            return None if prim.IsPseudoRoot() else prim
        if prim.IsPrototype():
            found = map(self._find_at_or_above, prim.GetInstances())
            return next((gprim for gprim in found if gprim), None)
        return self.above(prim)


def _instance_above(prim: Any) -> Any:
    """The prim itself, or the outermost instance that shows it."""
    place = prim
    while prim.IsInstanceProxy():
        place = prim = prim.GetParent()
    return place
