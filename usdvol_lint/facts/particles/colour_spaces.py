"""The colour space of a prim: by a name that USD knows, or one that the stage defines."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from pxr import Gf

from usdvol_lint.schema import COLOUR_SPACES
from usdvol_lint.spelling import closest_name

_NAME = "colorSpace:name"
_DEFINITIONS = "colorSpaceDefinition"


class ColourSpace(NamedTuple):
    """An authored colour space name; `similar` is the closest name that USD knows, if any is."""

    attribute: Any
    name: str
    is_known: bool
    similar: str | None


def colour_space(prim: Any) -> ColourSpace | None:
    """The name on the prim or on the nearest ancestor that has one, as USD inherits it."""
    for holder in _upward(prim):
        attribute = holder.GetAttribute(_NAME)
        name = attribute.Get() if attribute and attribute.HasAuthoredValue() else None
        if isinstance(name, str) and name:
            is_known = _is_built_in(name) or any(
                name in _defined(above) for above in _upward(holder)
            )
            similar = None if is_known else closest_name(name, COLOUR_SPACES, cutoff=0.6)
            return ColourSpace(attribute, name, is_known, similar)
    return None


def _upward(prim: Any) -> Iterator[Any]:
    while not prim.IsPseudoRoot():
        yield prim
        prim = prim.GetParent()


def _is_built_in(name: str) -> bool:
    """Whether this USD or the schema tables of the package know the name."""
    is_valid = getattr(Gf.ColorSpace, "IsValid", COLOUR_SPACES.__contains__)
    return name in COLOUR_SPACES or is_valid(name)


def _defined(prim: Any) -> Iterator[str]:
    """The names of the colour spaces that a prim defines."""
    for attribute in prim.GetAuthoredPropertiesInNamespace(_DEFINITIONS):
        if attribute.GetName().endswith(":name"):
            yield attribute.Get()
