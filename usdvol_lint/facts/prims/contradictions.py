"""Attributes that contradict the schemas: another type, a misspelt name, a token not allowed."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import repeat
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import get_attribute, get_prim_stack, own_attribute, type_of_spec
from usdvol_lint.facts.usd.values import Values, values_of


class Mistyped(NamedTuple):
    """A spec of another type than the schema declares.

    `only_role` says that the values are the same and only what they stand for differs.
    """

    attribute: Any
    spec: Any
    found: str
    wanted: str
    only_role: bool


class Misspelt(NamedTuple):
    """An attribute that no schema declares, and the name that was probably meant."""

    attribute: Any
    meant: str


class Unlisted(NamedTuple):
    """A token that is not one of those that the schema allows, and where it is a value."""

    name: str
    token: str
    allowed: tuple[str, ...]
    values: Values


def may_be_mistyped(batch: PrimBatch, authored: Authored) -> list[bool]:
    """Whether `mistyped` may find anything, for each of many prims that are alike."""
    if authored.is_layered:
        return [any(mistyped(prim, authored)) for prim in batch.prims]
    holders = [stack[0] for stack in batch.stacks]
    found = [False] * len(holders)
    for name, wanted in authored.types:
        specs = map(own_attribute, holders, repeat(Sdf.Path(f".{name}")))
        types = [None if spec is None else type_of_spec(spec) for spec in specs]
        if types.count(wanted) < len(types):
            found = [odd or own != wanted for odd, own in zip(found, types, strict=True)]
    return found


def mistyped(prim: Any, authored: Authored) -> Iterator[Mistyped]:
    """The specs, in every layer, whose type is not the one that the schema declares."""
    types = authored.types
    stack = get_prim_stack(prim) if types else ()
    for holder in stack:
        for name, wanted in types:
            place = Sdf.Path(f".{name}")
            spec = own_attribute(holder, place)
            if spec is None:
                spec = holder.GetRelationshipAtPath(place)
                if spec:
                    yield Mistyped(get_attribute(prim, name), spec, "rel", str(wanted), False)
            elif (found := type_of_spec(spec)) != wanted:
                same_values = found.type == wanted.type
                attribute = get_attribute(prim, name)
                yield Mistyped(attribute, spec, str(found), str(wanted), same_values)


def misspelt(prim: Any, authored: Authored) -> Iterator[Misspelt]:
    """The attributes with values that nobody reads for a slip in their names.

    Where the right one has a value, or could not hold this one, it is none.
    """
    for name, meant, wanted in authored.misspellings:
        attribute = prim.GetAttribute(name)
        if not attribute or not attribute.HasAuthoredValue():
            continue
        names_another = name.startswith("particleField:")
        could_hold = names_another or schema.is_alike(str(attribute.GetTypeName()), wanted)
        if could_hold and not prim.GetAttribute(meant).HasAuthoredValue():
            yield Misspelt(attribute, meant)


def unlisted_tokens(prim: Any, authored: Authored) -> Iterator[Unlisted]:
    """The tokens that the schema does not allow; an empty one is as good as none."""
    for name, allowed in authored.tokens:
        for token, values in values_of(get_attribute(prim, name)).grouped(_token):
            if token not in allowed:
                yield Unlisted(name, token, allowed, values)


def may_have_unlisted(batch: PrimBatch, authored: Authored) -> list[bool]:
    """Whether `unlisted_tokens` may find anything, for each of many prims that are alike."""
    found = [False] * len(batch.prims)
    for name, allowed in authored.tokens:
        columns = zip(found, batch.values(name), batch.counts(name), strict=True)
        found = [odd or value not in allowed or count > 0 for odd, value, count in columns]
    return found


def _token(value: Any) -> str | None:
    return value if isinstance(value, str) and value else None
