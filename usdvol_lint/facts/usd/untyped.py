"""Prims whose types say nothing of us, and which hold what Volumes and splats do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain, filterfalse
from typing import Any

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import get_property_names, has_specifier

GROUP_TYPES = frozenset({"", "Xform", "Scope"})
"""The types of prims that group others; other types may have reasons of their own."""
_TELLING = (schema.FIELD_NAMESPACE, "radiance:sphericalHarmonicsCoefficients")
"""How the names of properties begin without which a prim would be neither Volume nor splat."""
_DECLARED = frozenset(chain.from_iterable(schema.ATTRIBUTES.values()))


def with_our_data(prims: Sequence[Any]) -> list[Any]:
    """The prims on which such properties are authored."""
    names = list(map(get_property_names, prims))
    all_names = "\n".join(chain.from_iterable(names))
    if not any(name in all_names for name in _TELLING):
        return []
    return [
        prim
        for prim, own in zip(prims, names, strict=True)
        if any(name.startswith(_TELLING) for name in own)
    ]


def overs_with_our_data(prims: Iterable[Any]) -> list[Any]:
    """The prims that are only an `over`, with properties that prims of ours may have."""
    return [
        prim
        for prim in filterfalse(has_specifier, prims)
        if any(map(_may_be_of_ours, get_property_names(prim)))
    ]


def _may_be_of_ours(name: str) -> bool:
    return name in _DECLARED or name.startswith(schema.FIELD_NAMESPACE)
