"""Gprims above and below a prim: USD asks for none to be nested in another."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from itertools import chain, repeat
from typing import Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_children, get_parent, get_type
from usdvol_lint.facts.usd.instances import as_shown
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.usd.settled import settle


class Nested(NamedTuple):
    """A Gprim below another, and the prim to blame for it: itself, or the instance that has it."""

    gprim: Any
    to_blame: Any


class Nesting:
    """Finds Gprims above and below prims; what is found for an ancestor is cached."""

    def __init__(self, kinds: PrimKinds) -> None:
        self._kinds = kinds
        self._cache: dict[Any, Any | None] = {}
        self._first_in: dict[Any, Any | None] = {}
        self._is_gprim_type: dict[str, bool] = {}

    def above(self, prim: Any) -> Any | None:
        """The nearest Gprim among the ancestors; above a prototype, those of its instances."""
        return self._at_or_above(get_parent(prim))

    def _at_or_above(self, prim: Any) -> Any | None:
        """The prim itself if it is a Gprim, or else the nearest above."""
        if prim not in self._cache:
            upwards = self._upwards(prim)
            gprim = settle(upwards[-1], self._find_here, self._cache)
            self._cache.update(dict.fromkeys(upwards, gprim))
        return self._cache[prim]

    def _upwards(self, prim: Any) -> list[Any]:
        """The prim and those above it, up to one of which it is known, or can be said."""
        passed = [prim]
        while prim not in self._cache and not (
            prim.IsPseudoRoot() or prim.IsPrototype() or self._is_gprim(prim)
        ):
            prim = get_parent(prim)
            passed.append(prim)
        return passed

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
        for child in self._topmost(prim):
            if not self._is_gprim(child):
                if gprim := self._first_of(child):
                    yield Nested(gprim, child)
            elif not self._is_reported_itself(child):
                yield Nested(child, child)

    def _is_reported_itself(self, gprim: Any) -> bool:
        is_volume = self._kinds.is_a(gprim, schema.VOLUME)
        return is_volume or self._kinds.is_a(gprim, schema.PARTICLE_FIELD)

    def _topmost(self, prim: Any) -> Iterator[Any]:
        """The topmost Gprims and instances below a prim."""
        # To end a Usd.PrimRange takes longer than to visit a Volume with its fields this way.
        waiting = [iter(get_children(prim, WITH_INSTANCES))]
        while waiting:
            child = next(waiting[-1], None)
            if child is None:
                waiting.pop()
            elif self._is_gprim(child) or child.IsInstance():
                yield child
            else:
                waiting.append(iter(get_children(child, WITH_INSTANCES)))

    def _first_of(self, instance: Any) -> Any | None:
        """The first Gprim in an instance that is not reported itself."""
        path = settle(instance.GetPrototype(), self._find_first, self._first_in)
        at = path and path.ReplacePrefix(instance.GetPrototype().GetPath(), instance.GetPath())
        return at and instance.GetStage().GetPrimAtPath(at)

    def _find_first(self, prototype: Any) -> Generator[Any, None, Any]:
        """The path of the first Gprim in a prototype that is not reported itself."""
        paths: list[Any] = []
        for child in self._topmost(prototype):
            if self._is_gprim(child):
                paths += () if self._is_reported_itself(child) else (child.GetPath(),)
                continue
            inner = child.GetPrototype()
            if inner not in self._first_in:
                yield inner
            if path := self._first_in[inner]:
                paths.append(path.ReplacePrefix(inner.GetPath(), child.GetPath()))
        return min(paths, default=None)

    def _any_has_gprims(self, prims: Sequence[Any]) -> bool:
        """Whether one of these prims is a Gprim or has one below it."""
        waiting = list(prims)
        prototypes: set[Any] = set()
        while waiting:
            prim = waiting.pop()
            if self._is_gprim(prim):
                return True
            if prim.IsInstance():
                if prim.GetPrototype() in prototypes:
                    continue
                prototypes.add(prim.GetPrototype())
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

    def _find_here(self, prim: Any) -> Generator[Any, None, Any]:
        """The prim, if it is a Gprim; above a prototype, the first that its instances have."""
        if self._is_gprim(prim):
            return prim
        for instance in as_shown(prim.GetInstances()) if prim.IsPrototype() else ():
            top = self._upwards(instance)[-1]
            if top not in self._cache:
                yield top
            if gprim := self._at_or_above(instance):
                return gprim
        return None
