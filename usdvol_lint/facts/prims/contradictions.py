"""Attributes that contradict the schemas: another type, a misspelt name, a token not allowed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import repeat
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint import spelling
from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import (
    get_attribute,
    get_prim_stack,
    holder_of,
    own_attribute,
    type_of_spec,
)
from usdvol_lint.facts.usd.values import Values, values_of


class Mistyped(NamedTuple):
    """A spec of another type than the schema declares: `found` instead of `wanted`.

    `only_role`: whether the types differ only in role, as float3 and color3f do.
    """

    attribute: Any
    spec: Any
    found: str
    wanted: str
    only_role: bool


class Misspelt(NamedTuple):
    """An attribute that no schema declares, and the name that was probably intended.

    `overridden`: the attribute of that name in a weaker layer, whose value stays.
    `hiding`: the type that the schema declares where it knows the name, for something else.
    """

    attribute: Any
    intended: str
    overridden: Any | None = None
    hiding: str = ""

    @property
    def pair(self) -> str:
        """The intended name, or of a half array, `positionsh`, that of the float array."""
        return self.intended[:-1] if self.intended.endswith("sh") else self.intended

    @property
    def shown(self) -> str:
        """The attribute as messages name it, with both types where the type makes the slip."""
        name = self.attribute.GetName()
        if not self.hiding:
            return f"{name!r}"
        own, declared = f"{_authored_type(self.attribute)} {name}", f"{self.hiding} {name}"
        return f"{own!r}, only {declared!r}"

    @property
    def has_elements(self) -> bool:
        """Whether it is an array, and holds something at some time."""
        is_array = self.attribute.GetTypeName().isArray
        return is_array and any(map(len, values_of(self.attribute)))


class Unlisted(NamedTuple):
    """A token that is not one of the `allowed`, and the values of attribute `name` that it is."""

    name: str
    token: str
    allowed: tuple[str, ...]
    values: Values


def may_be_mistyped(batch: PrimBatch, authored: Authored) -> list[bool]:
    """Whether `mistyped` may find anything on each prim of a batch; all have these properties."""
    if authored.is_layered:
        return [any(mistyped(prim, authored)) for prim in batch.prims]
    prim_specs = [stack[0] for stack in batch.stacks]
    differ = [False] * len(prim_specs)
    for name, wanted in authored.types:
        specs = map(own_attribute, prim_specs, repeat(_path_of(name)))
        types = [None if spec is None else type_of_spec(spec) for spec in specs]
        if types.count(wanted) < len(types):
            differ = [known or own != wanted for known, own in zip(differ, types, strict=True)]
    return differ


def mistyped(prim: Any, authored: Authored) -> Iterator[Mistyped]:
    """The specs, in all layers, whose type is not the one that the schema declares.

    Left out are those that a stronger one corrects, and those of a name that is misspelt.
    """
    slips = misspelt(prim, authored) if authored.misspellings else ()
    misnamed = {slip.attribute.GetName() for slip in slips}
    types = [(name, wanted) for name, wanted in authored.types if name not in misnamed]
    stack = get_prim_stack(prim) if types else ()
    for strength, prim_spec in enumerate(stack):
        for name, wanted in types:
            path = _path_of(name)
            spec = own_attribute(prim_spec, path)
            if spec is None:
                spec = prim_spec.GetRelationshipAtPath(path)
                if spec:
                    yield Mistyped(get_attribute(prim, name), spec, "rel", str(wanted), False)
            elif (found := type_of_spec(spec)) != wanted:
                stronger = (own_attribute(other, path) for other in stack[:strength])
                if any(_corrects(other, spec, wanted) for other in stronger if other):
                    continue
                only_role = found.type == wanted.type
                yield Mistyped(get_attribute(prim, name), spec, str(found), str(wanted), only_role)


@cache
def _path_of(name: str) -> Any:
    """The path of a property that a schema declares, below its prim: to parse one takes long."""
    return Sdf.Path(f".{name}")


def _corrects(stronger: Any, weaker: Any, wanted: Any) -> bool:
    """Whether a spec has values of the type that is wanted at all times at which a weaker has."""
    is_animated = stronger.HasInfo("timeSamples") and not weaker.HasDefaultValue()
    is_right = type_of_spec(stronger).type == wanted.type
    return bool(is_right and (is_animated or stronger.HasDefaultValue()))


def misspelt(prim: Any, authored: Authored) -> Iterator[Misspelt]:
    """The attributes with values that are not read because their names are misspelt.

    One whose name the schema knows is so only if its own type is rather that of the intended one.

    Skipped if the type of the intended attribute can't hold the value, if it may be meant to be
    another attribute, or if the intended one has a value too, unless the misspelt one is of the
    same type, in a stronger layer, and says something else.
    """
    for name, intended, wanted in authored.misspellings:
        attribute = prim.GetAttribute(name)
        if not attribute or not attribute.HasAuthoredValue():
            continue
        right = prim.GetAttribute(intended)
        if right.HasAuthoredValue():
            if authored.is_layered and _fails_to_override(attribute, right, wanted):
                yield Misspelt(attribute, intended, right)
            continue
        names_another = name.startswith("particleField:")
        is_alike = spelling.is_alike(str(_authored_type(attribute)), wanted)
        if names_another or (is_alike and not _may_be_own(attribute, intended, wanted)):
            known = authored.declared.get(name)
            yield Misspelt(attribute, intended, hiding=known.type_name if known else "")


def _authored_type(attribute: Any) -> Any:
    """The type that the strongest spec has, whatever the schema declares."""
    specs = attribute.GetPropertyStack()
    return specs[0].typeName if specs else attribute.GetTypeName()  # in value clips are none


def _may_be_own(attribute: Any, intended: str, wanted: str) -> bool:
    """Whether an attribute may be somebody's own: of another type, and no near-certain slip."""
    is_other = attribute.GetTypeName().type != Sdf.ValueTypeNames.Find(wanted).type
    is_slip = spelling.is_certainly_misspelt(attribute.GetName(), intended)
    return bool(attribute.IsCustom() and is_other and not is_slip)


def _fails_to_override(misspelt: Any, right: Any, wanted: str) -> bool:
    """Whether a misspelt attribute was probably meant to override the right one of that type."""
    said, held = (list(filter(_has_value, each.GetPropertyStack())) for each in (misspelt, right))
    if str(misspelt.GetTypeName()) != wanted or not said or not held:
        return False  # in value clips there are no specs
    if any(spec.layer == said[0].layer for spec in right.GetPropertyStack()):
        return False  # who wrote it knows the right name too
    from usdvol_lint.facts.usd.sameness import says_the_same

    stack = get_prim_stack(right.GetPrim())
    is_stronger = stack.index(holder_of(said[0])) < stack.index(holder_of(held[0]))
    return is_stronger and not says_the_same(said[0], right)


def _has_value(spec: Any) -> bool:
    return any(map(spec.HasInfo, ("default", "timeSamples", "spline")))


def unlisted_tokens(prim: Any, authored: Authored) -> Iterator[Unlisted]:
    """The tokens that the schema does not allow; an empty one counts as none."""
    for name, allowed in authored.tokens:
        for token, values in values_of(get_attribute(prim, name)).grouped(_token):
            if token not in allowed:
                yield Unlisted(name, token, allowed, values)


def may_have_unlisted(batch: PrimBatch, authored: Authored) -> list[bool]:
    """Whether `unlisted_tokens` may find anything on each prim of a batch, as `may_be_mistyped`."""
    may_have = [False] * len(batch.prims)
    for name, allowed in authored.tokens:
        columns = zip(may_have, batch.values(name), batch.counts(name), strict=True)
        may_have = [known or value not in allowed or count > 0 for known, value, count in columns]
    return may_have


def _token(value: Any) -> str | None:
    return value if isinstance(value, str) and value else None
