"""Whether what a prim says of purpose, visibility or transform reaches anything of ours below."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from usdvol_lint import schema
from usdvol_lint.facts.prims.transforms import resets
from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_children
from usdvol_lint.facts.usd.drawn import prototypes_of
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.usd.kinds import PrimKinds

_DRAWN = frozenset({schema.VOLUME, schema.PARTICLE_FIELD})


def is_handed_down(above: Any, name: str, kinds: PrimKinds) -> bool:
    """Whether a Volume or particle field takes what a prim above it says of a property.

    It does not where it, or a prim in between, says a purpose of its own or resets the stack of
    transforms.  What a PointInstancer draws is below it.
    """
    says_its_own = _ENDS.get(name)
    seen = set()
    pending = [above]
    while pending:
        for prim in _below(pending.pop(), kinds):
            schemas = kinds.names(kinds.key(prim))
            if prim in seen or (says_its_own and says_its_own(prim, schemas)):
                continue
            if not _DRAWN.isdisjoint(schemas):
                return True
            seen.add(prim)
            pending.append(prim)
    return False


def _below(prim: Any, kinds: PrimKinds) -> Iterator[Any]:
    yield from map(in_prototype, get_children(prim, WITH_INSTANCES))
    if kinds.is_a(prim, schema.POINT_INSTANCER):
        yield from prototypes_of(prim)


def _says_purpose(prim: Any, schemas: frozenset[str]) -> bool:
    return "Imageable" in schemas and bool(prim.GetAttribute("purpose").HasAuthoredValue())


def _resets(prim: Any, schemas: frozenset[str]) -> bool:
    return "Xformable" in schemas and resets(prim)


_ENDS: dict[str, Callable[[Any, frozenset[str]], bool]] = {
    "purpose": _says_purpose,
    "xformOpOrder": _resets,
}
"""By the name of a property, what keeps it from a prim and all below it."""
