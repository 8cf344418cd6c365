"""Overs that say something of no prim, beside a prim with nearly their name."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence, Set
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.facts.layers.undefined import InnerArcs, defines, spec_above
from usdvol_lint.facts.usd.calls import (
    WITH_INSTANCES,
    get_children,
    get_parent,
    get_path,
    get_prim_stack,
    get_property_names,
    has_specifier,
)
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import in_prototype, shown
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.usd.unselected import may_be_said
from usdvol_lint.nearest import is_one_slip_from

_LONG_ENOUGH = 5
_MOST = 100
"""How many overs are compared with their siblings."""


class Misnamed(NamedTuple):
    """An `over` that no layer defines, and the path of the sibling that was probably meant.

    `properties` are those that it says something of, as paths below it; `meant` are the prims of
    ours that have these.
    `copies` counts the prims of the stage that have the spec of this `over`.
    """

    over: Any
    similar: str
    properties: tuple[str, ...]
    meant: frozenset[Any]
    copies: int

    @property
    def spec(self) -> Any:
        """The spec of the `over` in the layer that says something of the first property."""
        first = self.properties[0]
        return spec_above(self.over, Sdf.Path(first if "." in first else f".{first}"))


class _Opinion(NamedTuple):
    path: str
    meant: Any


def find_misnamed(
    stage: Any, kinds: PrimKinds, drawn: Drawn, overs: Iterable[Any], told: Set[Any]
) -> Iterator[Misnamed]:
    """The overs at or above these that were probably meant for a sibling with properties of ours.

    Left out are those that are told of elsewhere, and all that an arc inside of a layer, or a
    variant that is not selected, may make something of.
    """
    below: dict[Any, list[Any]] = defaultdict(list)
    for each in dict.fromkeys(overs):
        below[_topmost(each)].append(each)
    by_spec: dict[Any, list[Any]] = defaultdict(list)
    for top in sorted(below.keys() - told, key=get_path)[:_MOST]:
        by_spec[get_prim_stack(top)[0]].append(top)
    arcs = InnerArcs(stage)
    for top, *copies in by_spec.values():
        found = [
            (shown(sibling).path, opinions)
            for sibling in _similar_siblings(top)
            if (opinions := list(_opinions(top, below[top], sibling, drawn, kinds)))
        ]
        if len(found) == 1 and not may_be_said(top, defines) and not arcs.lead_below(top):
            [(similar, opinions)] = found
            properties = tuple(each.path for each in opinions)
            meant = frozenset(each.meant for each in opinions)
            yield Misnamed(top, similar, properties, meant, 1 + len(copies))


def _topmost(over: Any) -> Any:
    """The highest of the overs from this one upwards."""
    while not has_specifier(above := get_parent(over)):
        over = above
    return over


def _similar_siblings(over: Any) -> list[Any]:
    name = over.GetName()
    return [
        sibling
        for sibling in get_children(over.GetParent(), WITH_INSTANCES)
        if _is_similar(name, sibling.GetName())
    ]


def _is_similar(name: str, other: str) -> bool:
    is_long = min(len(name), len(other)) >= _LONG_ENOUGH
    return is_one_slip_from(name, other) and (is_long or name.lower() == other.lower())


def _opinions(
    top: Any, overs: Sequence[Any], sibling: Any, drawn: Drawn, kinds: PrimKinds
) -> Iterator[_Opinion]:
    """What the overs say of properties that prims of ours at or below a sibling may have."""
    stage = top.GetStage()
    for over in overs:
        path = over.GetPath()
        prim = stage.GetPrimAtPath(path.ReplacePrefix(top.GetPath(), sibling.GetPath()))
        walked = in_prototype(prim) if prim else None
        if not walked or walked not in drawn:
            continue
        schemas = kinds.names(kinds.key(walked))
        declared = schema.attributes_of(schemas) if not schema.OURS.isdisjoint(schemas) else ()
        relative = "" if over == top else str(path.MakeRelativePath(top.GetPath()))
        for name in get_property_names(over):
            is_field = schema.VOLUME in schemas and name.startswith(schema.FIELD_NAMESPACE)
            if name in declared or is_field:
                yield _Opinion(f"{relative}.{name}" if relative else name, walked)
