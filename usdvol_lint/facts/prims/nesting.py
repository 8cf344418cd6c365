"""Gprims above and below a prim: USD asks for none to be nested in another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain, repeat
from typing import Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_children, get_parent, get_path, get_type
from usdvol_lint.facts.usd.instances import as_shown
from usdvol_lint.facts.usd.kinds import PrimKinds

_NOT_CACHED = object()


class Nested(NamedTuple):
    """A Gprim below another, and the prim to blame for it: itself, or the instance that has it."""

    gprim: Any
    to_blame: Any


class Nesting:
    """Finds Gprims above and below prims; what is found for an ancestor is cached."""

    def __init__(self, kinds: PrimKinds) -> None:
        self._kinds = kinds
        self._cache: dict[Any, Any | None] = {}
        self._is_gprim_type: dict[str, bool] = {}

    def above(self, prim: Any) -> Any | None:
        """The nearest Gprim among the ancestors; above a prototype, those of its instances."""
        return self._at_or_above(get_parent(prim))

    def _at_or_above(self, prim: Any) -> Any | None:
        """The prim itself if it is a Gprim, or else the nearest above."""
        gprim = self._cache.get(prim, _NOT_CACHED)
        if gprim is not _NOT_CACHED:
            return gprim
        passed = []
        while gprim is _NOT_CACHED:  # no recursion: prims may be nested deeper than that goes
            passed.append(prim)
            if prim.IsPseudoRoot() or prim.IsPrototype() or self._is_gprim(prim):
                gprim = self._find_here(prim)
            else:
                prim = get_parent(prim)
                gprim = self._cache.get(prim, _NOT_CACHED)
        self._cache.update(dict.fromkeys(passed, gprim))
        return gprim

    def are_likely(self, batch: PrimBatch) -> list[bool]:
        """Whether each prim has any Gprim above or below, Volumes and particle fields included."""
        families = (
            repeat(bool(self._at_or_above(parent)), count) for parent, count in batch.families
        )
        return [
            has_above or self._any_has_gprims(children)
            for has_above, children in zip(chain(*families), batch.children, strict=True)
        ]

    def below(self, prim: Any) -> Iterator[Nested]:
        """The topmost Gprims below a prim, of those in each instance the first by path.

        Volumes and particle fields are left out: they are reported as nested themselves.
        """
        first: dict[Any, Any] = {}
        for gprim in self._topmost_gprims(prim):
            instance = _outermost_instance(gprim)
            to_blame = gprim if instance == prim else instance
            if not self._is_reported_itself(gprim):
                first[to_blame] = min(first.get(to_blame, gprim), gprim, key=get_path)
        return (Nested(gprim, to_blame) for to_blame, gprim in first.items())

    def _is_reported_itself(self, gprim: Any) -> bool:
        is_volume = self._kinds.is_a(gprim, schema.VOLUME)
        return is_volume or self._kinds.is_a(gprim, schema.PARTICLE_FIELD)

    def _topmost_gprims(self, prim: Any) -> Iterator[Any]:
        # To end a Usd.PrimRange takes longer than to visit a Volume with its fields this way.
        waiting = [iter(get_children(prim, WITH_INSTANCES))]
        while waiting:
            child = next(waiting[-1], None)
            if child is None:
                waiting.pop()
            elif self._is_gprim(child):
                yield child
            else:
                waiting.append(iter(get_children(child, WITH_INSTANCES)))

    def _any_has_gprims(self, prims: Sequence[Any]) -> bool:
        """Whether one of these prims is a Gprim or has one below it."""
        waiting = list(prims)
        while waiting:
            prim = waiting.pop()
            if self._is_gprim(prim):
                return True
            waiting += get_children(prim, WITH_INSTANCES)
        return False

    def _is_gprim(self, prim: Any) -> bool:
        """Looks at the type alone, since no applied schema makes a prim a Gprim."""
        type_name = get_type(prim)
        known = self._is_gprim_type.get(type_name)
        if known is None:
            known = schema.GPRIM in self._kinds.names((type_name,))
            self._is_gprim_type[type_name] = known
        return known

    def _find_here(self, prim: Any) -> Any | None:
        """The prim, if it is a Gprim; above a prototype, the first that its instances have."""
        if self._is_gprim(prim):
            return prim
        instances = as_shown(prim.GetInstances()) if prim.IsPrototype() else ()
        return next(filter(None, map(self._at_or_above, instances)), None)


def _outermost_instance(prim: Any) -> Any:
    """The outermost instance above an instance proxy; any other prim itself."""
    while prim.IsInstanceProxy():
        prim = prim.GetParent()
    return prim
