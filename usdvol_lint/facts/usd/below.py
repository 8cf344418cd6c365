"""What is drawn below a prim, also in instances, of which there may be more than can be counted."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_children


def each_below(prim: Any, predicate: Any = WITH_INSTANCES) -> Iterator[Any]:
    """The prim and all below it, depth first; what is in a prototype once, where it is met first.

    `predicate` has to lead into instances.
    """
    prototypes: set[Any] = set()
    waiting = [prim]
    while waiting:
        prim = waiting.pop()
        yield prim
        if prim.IsInstance():
            prototype = prim.GetPrototype()
            if prototype in prototypes:
                continue
            prototypes.add(prototype)
        waiting += reversed(get_children(prim, predicate))
