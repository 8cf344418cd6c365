"""Prims whose types say nothing of us, and which hold what Volumes and splats do."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import get_property_names

GROUP_TYPES = frozenset({"", "Xform", "Scope"})
"""The types of prims that group others; other types may have reasons of their own."""
_TELLING = (schema.FIELD_NAMESPACE, "radiance:sphericalHarmonicsCoefficients")
"""How the names of properties begin without which a prim would be neither Volume nor splat."""


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
