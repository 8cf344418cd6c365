"""The prims above Volumes and particle fields, whose purpose, visibility and transform count."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from typing import Any

from usdvol_lint import schema
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import get_parent, get_property_names
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import instances_of
from usdvol_lint.facts.usd.kinds import PrimKinds

_INHERITED = frozenset({"purpose", "visibility", "xformOpOrder"})


def ancestors_of(batches: Iterable[PrimBatch], kinds: PrimKinds, drawn: Drawn) -> list[Any]:
    """The prims above those of the batches that author what is inherited, by path.

    Above a prototype there are its instances, and above what a PointInstancer draws is that too.
    Prims of our types are left out: rules get these by themselves.
    """
    seen: set[Any] = set()
    pending: list[Any] = []
    instancers = drawn.instancers
    for batch in batches:
        pending += (parent for parent, _ in batch.families)
        if instancers:
            pending += chain.from_iterable(instancers.get(prim, ()) for prim in batch.prims)
    while pending:
        prim = pending.pop()
        if prim.IsPseudoRoot() or prim in seen:
            continue
        seen.add(prim)
        pending += instancers.get(prim, ())
        pending += instances_of(prim) if prim.IsPrototype() else (get_parent(prim),)
    authors = (prim for prim in seen if not _INHERITED.isdisjoint(get_property_names(prim)))
    groups = (prim for prim in authors if schema.OURS.isdisjoint(kinds.names(kinds.key(prim))))
    return sorted(groups, key=lambda prim: prim.GetPath())
