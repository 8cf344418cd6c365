"""Fallbacks for types that USD does not know, which only the root layer of a stage can say."""

from __future__ import annotations

from itertools import takewhile
from typing import Any

from usdvol_lint.facts.usd.bringing import losing_spec
from usdvol_lint.facts.usd.calls import get_prim_stack, get_type

_KEY = "fallbackPrimTypes"


def losing_fallback(prim: Any) -> Any | None:
    """The spec that brings a prim without the fallback for its type that the layer below has."""
    name = get_type(prim)
    typed = [spec for spec in get_prim_stack(prim) if spec.typeName]
    alike = takewhile(lambda spec: spec.typeName == name, typed)

    def says(layer: Any) -> bool:
        top = layer.pseudoRoot
        return bool(top.HasInfo(_KEY) and name in top.GetInfo(_KEY))

    return next(filter(None, (losing_spec(prim, spec, says) for spec in alike)), None)
