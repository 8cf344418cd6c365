"""The authored attributes of prims, held against what the schemas declare."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import repeat
from typing import Any, NamedTuple, TypeAlias

from pxr import Sdf

from usdvol_lint import schema, spelling
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import get_attribute, get_prim_stack, own_attribute, type_of_spec
from usdvol_lint.facts.usd.clips import Clips
from usdvol_lint.facts.usd.kinds import Key, Kinds
from usdvol_lint.facts.usd.values import Values, values_of

Shape: TypeAlias = tuple[tuple[str, ...], bool, bool]
"""The names of authored properties; whether there are several specs; whether there are clips."""


@dataclass(frozen=True, slots=True, eq=False)
class Authored:
    """What prims of one kind share on which the same properties are authored.

    `schemas` are those that they answer to.
    `declared` are those that UsdVol's schemas, or the ones they derive from, declare, with those
    that have values in clips alone; `types` are theirs, `tokens` and `uniform` are some of them.
    `bound` are the names of a Volume's `field:` namespace.
    `undeclared` are names that no schema declares; `misspellings` are those of them with a likely
    correction, and the type that this one has.
    `is_layered` says that several specs have a say, `is_clipped` that value clips may.
    """

    schemas: frozenset[str]
    declared: Mapping[str, schema.Attribute]
    types: tuple[tuple[str, Any], ...]
    tokens: tuple[tuple[str, tuple[str, ...]], ...]
    uniform: tuple[str, ...]
    bound: tuple[str, ...]
    undeclared: frozenset[str]
    misspellings: tuple[tuple[str, str, str], ...]
    is_layered: bool
    is_clipped: bool


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


class AuthoredReader:
    """Finds what is authored on prims: there are few combinations, and many prims of each."""

    def __init__(self, kinds: Kinds, clips: Clips) -> None:
        self._kinds = kinds
        self._clips = clips
        self._shared: dict[tuple[Key, Shape], Authored] = {}

    def shapes(self, batch: PrimBatch, key: Key) -> list[Shape]:
        """What makes prims of one kind alike: names, and who else may have a say in the values."""
        are_clipped = self._clips.reach(batch)
        are_layered = [len(stack) > 1 for stack in batch.stacks]
        shapes = list(zip(batch.names, are_layered, are_clipped, strict=True))
        if any(are_clipped):
            known = schema.attributes_of(self._kinds.names(key))
            for row, prim in enumerate(batch.prims):
                if are_clipped[row]:
                    also = (name for name in known if prim.GetAttribute(name).HasAuthoredValue())
                    shapes[row] = ((*batch.names[row], *also), are_layered[row], True)
        return shapes

    def read(self, prim: Any, key: Key, shape: Shape) -> Authored:
        """What is authored on all prims of a kind that are of a shape; `prim` is one of them."""
        found = self._shared.get((key, shape))
        if found is None:
            found = self._shared[key, shape] = _compare(prim, self._kinds.names(key), *shape)
        return found


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
        could_hold = names_another or spelling.is_alike(str(attribute.GetTypeName()), wanted)
        if could_hold and not prim.GetAttribute(meant).HasAuthoredValue():
            yield Misspelt(attribute, meant)


def unlisted_tokens(prim: Any, authored: Authored) -> Iterator[Unlisted]:
    """The tokens that the schema does not allow; an empty one is as good as none."""
    for name, allowed in authored.tokens:
        for token, values in values_of(get_attribute(prim, name)).apart(_token):
            if token not in allowed:
                yield Unlisted(name, token, allowed, values)


def may_have_unlisted(batch: PrimBatch, authored: Authored) -> list[bool]:
    """Whether `unlisted_tokens` may find anything, for each of many prims that are alike."""
    found = [False] * len(batch.prims)
    for name, allowed in authored.tokens:
        columns = zip(found, batch.values(name), batch.counts(name), strict=True)
        found = [odd or value not in allowed or count > 0 for odd, value, count in columns]
    return found


def _compare(
    prim: Any, schemas: frozenset[str], names: Iterable[str], is_layered: bool, is_clipped: bool
) -> Authored:
    known = schema.attributes_of(schemas)
    candidates = dict(known)
    if schema.PARTICLE_FIELD in schemas:
        candidates.update(schema.attributes_of(schema.API_ATTRIBUTES))  # whether applied or not
    registered = prim.GetPrimDefinition().GetPropertyNames()
    declared = {name: known[name] for name in names if name in known}
    undeclared = frozenset(names).difference(candidates, registered)
    bound: tuple[str, ...] = ()
    if schema.VOLUME in schemas:
        bound = tuple(name for name in names if name.startswith(schema.FIELD_NAMESPACE))
        undeclared = undeclared.difference(bound)
    return Authored(
        schemas=schemas,
        declared=declared,
        types=tuple(
            (name, Sdf.ValueTypeNames.Find(attribute.type_name))
            for name, attribute in declared.items()
        ),
        tokens=tuple((name, known.tokens) for name, known in declared.items() if known.tokens),
        uniform=tuple(name for name, known in declared.items() if known.uniform),
        bound=bound,
        undeclared=undeclared,
        misspellings=tuple(
            (name, meant, candidates[meant].type_name)
            for name in sorted(undeclared)
            if (meant := spelling.misspelt_attribute(name, candidates))
        ),
        is_layered=is_layered,
        is_clipped=is_clipped,
    )


def _token(value: Any) -> str | None:
    return value if isinstance(value, str) and value else None
