"""The colour space of coefficients: their own, or by a name on the prim or above, as USD asks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from pxr import Gf

from usdvol_lint.facts.usd.instances import on_stage
from usdvol_lint.facts.usd.kinds import raw_apis
from usdvol_lint.schema import COLOUR_SPACES
from usdvol_lint.spelling import closest_name

_API = "ColorSpaceAPI"
_NAME = "colorSpace:name"
_DEFINITION_API = "ColorSpaceDefinitionAPI"


class ColourSpace(NamedTuple):
    """An authored colour space name; `similar` is the closest name that USD knows, if any is.

    USD reads it only if `is_applied`: if the API that declares it is.  `unapplied` is the instance
    of a definition of that name whose API is not applied, if there is one.
    """

    attribute: Any
    name: str
    is_known: bool
    similar: str | None
    is_applied: bool = True
    unapplied: str | None = None


class _Applied(NamedTuple):
    """The APIs of prims: those applied, and of one prim the awaited ones too."""

    prim: Any
    awaited: frozenset[str]

    def to(self, prim: Any) -> frozenset[str]:
        """The applied APIs, those too that this USD does not know."""
        written = self.awaited if prim == self.prim else frozenset[str]()
        return written.union(prim.GetAppliedSchemas(), raw_apis(prim))


def colour_space(
    prim: Any, coefficients: Any = None, awaited: Iterable[str] = ()
) -> ColourSpace | None:
    """The coefficients' own colour space, or the nearest name on the prim or above.

    A name without its API is passed over by USD; it is told where no nearer one counts.
    `awaited`: APIs of the prim of which another rule tells that they are not applied.
    """
    applied = _Applied(prim, frozenset(awaited))
    if coefficients and coefficients.HasColorSpace():
        return _described(coefficients, str(coefficients.GetColorSpace()), prim, True, applied)
    for holder in _upward(prim):
        attribute = holder.GetAttribute(_NAME)
        name = attribute.Get() if attribute and attribute.HasAuthoredValue() else None
        if isinstance(name, str) and name:
            is_applied = _API in applied.to(holder)
            return _described(attribute, name, holder, is_applied, applied)
    return None


def _described(
    attribute: Any, name: str, holder: Any, is_applied: bool, applied: _Applied
) -> ColourSpace:
    definitions = [
        (api, api in applied.to(above))
        for above in _upward(holder)
        for api in _defined(above, name)
    ]
    is_known = _is_built_in(name) or any(is_there for _, is_there in definitions)
    similar = None if is_known else closest_name(name, COLOUR_SPACES, cutoff=0.6)
    unapplied = None if is_known or not definitions else definitions[0][0]
    return ColourSpace(attribute, name, is_known, similar, is_applied, unapplied)


def _upward(prim: Any) -> Iterator[Any]:
    prim = on_stage(prim)
    while not prim.IsPseudoRoot():
        yield prim
        prim = prim.GetParent()


def _is_built_in(name: str) -> bool:
    """Whether this USD or the schema tables of the package know the name."""
    is_valid = getattr(Gf.ColorSpace, "IsValid", COLOUR_SPACES.__contains__)
    return name in COLOUR_SPACES or is_valid(name)


def _defined(prim: Any, name: str) -> Iterator[str]:
    """The APIs of the definitions of a name on a prim."""
    for attribute in prim.GetAuthoredPropertiesInNamespace("colorSpaceDefinition"):
        _, instance, *rest = attribute.GetName().split(":")
        if rest == ["name"] and attribute.Get() == name:
            yield f"{_DEFINITION_API}:{instance}"
