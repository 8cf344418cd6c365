"""Prims whose type, from a stronger layer, hides one of ours."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.usd.arcs import Layered
from usdvol_lint.facts.usd.calls import get_type
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.paths import display


class Retyped(NamedTuple):
    """A prim with a type that hides one of ours.

    `hidden` is the spec with our type; `stronger` are those with another, strongest first.
    `is_field`: whether our type is that of a field, which is not drawn itself.
    """

    prim: Any
    hidden: Any
    stronger: tuple[Any, ...]
    is_field: bool

    @property
    def hidden_type(self) -> str:
        """Our type."""
        return str(self.hidden.typeName)

    @property
    def hidden_in(self) -> str:
        """The layer that gives the prim our type."""
        return display(self.hidden.layer.realPath or self.hidden.layer.identifier)


def retyped_prims(layered: Iterable[Layered], kinds: PrimKinds) -> dict[Any, Retyped]:
    """By path: the prims that would be a Volume, field or particle field but for a stronger type.

    What USD takes a prim for counts, so a type with a fallback of ours hides nothing.
    """
    found = []
    for prim, specs, _ in layered:
        type_name = get_type(prim)
        if type_name and not _is_ours(kinds, (type_name,)):
            found.append(_retyped(prim, specs, kinds))
    by_path = {each.prim.GetPath(): each for each in found if each}
    return dict(sorted(by_path.items()))


def _retyped(prim: Any, specs: list[Any], kinds: PrimKinds) -> Retyped | None:
    typed = [spec for spec in specs if spec.typeName]
    for number, spec in enumerate(typed):
        if _is_ours(kinds, (spec.typeName,)):
            is_field = schema.FIELD in kinds.names((spec.typeName,))
            return Retyped(prim, spec, tuple(typed[:number]), is_field)
    return None


def _is_ours(kinds: PrimKinds, key: tuple[str, ...]) -> bool:
    return not schema.OURS.isdisjoint(kinds.names(key))
