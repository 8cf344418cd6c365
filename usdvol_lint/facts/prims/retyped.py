"""Whether a type of ours hides another one of ours, of which a prim has the data."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.prims.data import has_data_of
from usdvol_lint.facts.usd.kinds import PrimKinds, is_registered, raw_apis
from usdvol_lint.paths import display


class Retyped(NamedTuple):
    """A prim with a type that hides one of ours.

    `hidden` is the spec with our type; `stronger` are those with another, strongest first.
    `is_field`: whether our type is that of a field, which is not drawn itself.
    `stands_in`: whether the stronger type may be meant: it is drawn, in place of what it hides.
    """

    prim: Any
    hidden: Any
    stronger: tuple[Any, ...]
    is_field: bool
    stands_in: bool

    @property
    def hidden_type(self) -> str:
        """Our type."""
        return str(self.hidden.typeName)

    @property
    def hidden_in(self) -> str:
        """The layer that gives the prim our type."""
        return display(self.hidden.layer.realPath or self.hidden.layer.identifier)


def retyped_ours(prim: Any, specs: Sequence[Any], kinds: PrimKinds) -> Retyped | None:
    """The type of ours that one of ours hides: a Volume over a splat, a base without its APIs.

    A field over what is no field is none, since it says itself that it lacks a file.
    """
    names = kinds.names(kinds.key(prim))
    typed = [spec for spec in specs if spec.typeName]
    for number, spec in enumerate(typed):
        if spec.typeName not in schema.CONCRETE_TYPES or spec.typeName in names:
            continue
        hidden = kinds.names((spec.typeName,))
        is_field = schema.FIELD in hidden
        if not schema.OURS.isdisjoint(names & hidden):
            is_lost, stands_in = _lacks_built_in(prim, spec.typeName, kinds), False
        else:
            stands_in = _has_data(prim, names)
            is_lost = _has_data(prim, hidden) and not (is_field and stands_in)
        if is_lost:
            return Retyped(prim, spec, tuple(typed[:number]), is_field, stands_in)
    return None


def is_bared(prim: Any, kinds: PrimKinds) -> bool:
    """Whether a type takes the APIs of a particle field away, and is not meant to."""
    retyped = retyped_ours(prim, prim.GetPrimStack(), kinds)
    return retyped is not None and not retyped.stands_in


def _lacks_built_in(prim: Any, hidden: str, kinds: PrimKinds) -> bool:
    """Whether a prim lacks positions, kernel or radiance, which a hidden type has built in.

    An API that this USD does not know may bring it.
    """
    built_in = schema.expand_apis(schema.BUILT_IN_APIS.get(hidden, ()))
    lost = {*schema.BASE_APIS}.intersection(built_in).difference(kinds.applied(prim))
    known = (api in schema.API_INCLUDES or is_registered(api) for api in raw_apis(prim))
    return bool(lost) and all(known)


def _has_data(prim: Any, names: Collection[str]) -> bool:
    """Whether a prim of these schemas has fields, positions or a file."""
    if schema.PARTICLE_FIELD in names:
        positions = map(prim.GetAttribute, schema.API_ATTRIBUTES[schema.POSITIONS_API])
        return any(attribute.HasAuthoredValue() for attribute in positions)
    return has_data_of(prim, schema.VOLUME if schema.VOLUME in names else schema.FIELD_ASSET)
