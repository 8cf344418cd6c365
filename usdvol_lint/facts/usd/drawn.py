"""Which prims are drawn: what traversals visit, and what PointInstancers draw besides."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from itertools import chain, filterfalse
from typing import Any

from pxr import Usd

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.usd.below import each_below
from usdvol_lint.facts.usd.calls import (
    DRAWN_BELOW,
    get_parent,
    has_specifier,
    is_defined,
    is_in_prototype,
)
from usdvol_lint.facts.usd.instances import in_prototype, prototype_of
from usdvol_lint.facts.usd.settled import settle

_COMPOSED = Usd.TraverseInstanceProxies(
    Usd.PrimIsActive & Usd.PrimIsLoaded & Usd.PrimHasDefiningSpecifier
)


class Drawn:
    """The prims that are drawn, each as the walk meets it: in its prototype, if it is in one.

    A prim is drawn if it is defined up to the root, or up to a target of a PointInstancer's
    `prototypes`, which may lie below an `over`; what is in a prototype is if one of its instances
    is.  Imaging passes over a `class` there too.
    `live_instancers` are the PointInstancers that are drawn, in no certain order.
    `roots` are such targets that no traversal reaches, those in a `class` among them.
    """

    def __init__(self, instancers: Iterable[Any] = ()) -> None:
        """`instancers`: the PointInstancers of the stage, also those that are not drawn."""
        self.roots: set[Any] = set()
        self.live_instancers: set[Any] = set()
        self._appearing: dict[Any, bool] = {}
        waiting = set(instancers)
        while ready := set(filter(self.__contains__, waiting)):
            waiting -= ready
            self.live_instancers |= ready
            targets = chain.from_iterable(map(prototypes_of, ready))
            self.roots.update(root for root in targets if root not in self)
            self._appearing.clear()

    def __contains__(self, prim: Any) -> bool:
        return bool(DRAWN_BELOW(prim)) and (self._is_reached(prim) or self._is_below_root(prim))

    @cached_property
    def instancers(self) -> Mapping[Any, Sequence[Any]]:
        """The drawn PointInstancers, by each prim that they target."""
        by_target: dict[Any, list[Any]] = defaultdict(list)
        for instancer in self.live_instancers:
            for target in prototypes_of(instancer):
                by_target[target].append(instancer)
        return by_target

    @property
    def out_of_reach(self) -> Iterator[Any]:
        """What is at the roots and below them, also in instances."""
        return chain.from_iterable(map(_composed, self.roots))

    @property
    def passed_over(self) -> Iterator[Any]:
        """What of that is not drawn, since it is in a `class`."""
        return chain.from_iterable(map(_composed, filterfalse(self.__contains__, self.roots)))

    def appears(self, prototype: Any) -> bool:
        """Whether an instance of a prototype is drawn."""
        return settle(prototype, self._find_appearing, self._appearing)

    def _find_appearing(self, prototype: Any) -> Generator[Any, None, bool]:
        for instance in prototype.GetInstances():
            around = prototype_of(instance) if is_in_prototype(instance) else None
            if around and around not in self._appearing:
                yield around
            if instance in self:
                return True
        return False

    def _is_reached(self, prim: Any) -> bool:
        if not is_defined(prim):
            return False
        return not is_in_prototype(prim) or self.appears(prototype_of(prim))

    def _is_below_root(self, prim: Any) -> bool:
        while self.roots and prim and has_specifier(prim):
            if prim in self.roots:
                return True
            prim = get_parent(prim)
        return False


def _composed(root: Any) -> Iterator[Any]:
    return each_below(root, _COMPOSED)


def prototypes_of(instancer: Any) -> Iterator[Any]:
    """The targets of a PointInstancer, as the walk meets them."""
    for path in instancer.GetRelationship("prototypes").GetForwardedTargets():
        target = instancer.GetStage().GetPrimAtPath(path.GetPrimPath())
        if target:
            yield in_prototype(target)
