"""Overrides below instances, which USD passes over: what an instance shows is its prototype."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.usd.arcs import Layered
from usdvol_lint.facts.usd.calls import get_prim_stack
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.usd.sameness import says_the_same


class LostOverride(NamedTuple):
    """A property below an instance, and a spec that would change it if USD looked there."""

    property: Any
    spec: Any


class LostOverrides(NamedTuple):
    """All lost overrides below one instance, in its stronger layers first."""

    instance: Any
    overrides: tuple[LostOverride, ...]


def lost_overrides(
    stage: Any, layered: Iterable[Layered], kinds: PrimKinds, ours: Iterable[Any]
) -> Iterator[LostOverrides]:
    """The overrides below instances that show some of our prims, by the instances' paths.

    Only specs count that are at least as strong as the one that makes the prim an instance: who
    wrote them could know that it is one.
    """
    holders = _prototypes_of(stage, ours)
    found = []
    for instance, specs, parents in layered:
        is_overridden = len(parents) > 1 and instance.IsInstance()
        if is_overridden and instance.GetPrototype().GetPath() in holders:
            overrides = tuple(_below(instance, _strong_specs(specs), kinds))
            if overrides:
                found.append(LostOverrides(instance, overrides))
    yield from sorted(found, key=lambda each: each.instance.GetPath())


def _prototypes_of(stage: Any, ours: Iterable[Any]) -> set[Any]:
    """The paths of the prototypes that hold some of these prims, also in other instances."""
    pending = {_root(prim) for prim in ours if prim.IsInPrototype()}
    found: set[Any] = set()
    while pending:
        path = pending.pop()
        found.add(path)
        instances = stage.GetPrimAtPath(path).GetInstances()
        pending |= {_root(each) for each in instances if each.IsInPrototype()} - found
    return found


def _root(prim: Any) -> Any:
    return prim.GetPath().GetPrefixes()[0]


def _below(instance: Any, specs: list[Any], kinds: PrimKinds) -> Iterator[LostOverride]:
    stage = instance.GetStage()
    pending = [
        (child, instance.GetPath().AppendChild(child.name))
        for spec in reversed(specs)
        for child in spec.nameChildren
    ]
    while pending:
        spec, path = pending.pop()
        prim = stage.GetPrimAtPath(path)
        if not prim or spec in get_prim_stack(prim):
            continue
        pending += [(child, path.AppendChild(child.name)) for child in spec.nameChildren]
        yield from _changed(spec, prim, kinds)


def _strong_specs(stack: Iterable[Any]) -> list[Any]:
    """The specs down to the one that makes the prim an instance; none if a variant says it."""
    specs: list[Any] = []
    for spec in stack:
        if spec.path.ContainsPrimVariantSelection():
            if spec.HasInfo("instanceable"):
                return []
            continue
        specs.append(spec)
        if spec.HasInfo("instanceable"):
            return specs
    return []


def _changed(prim_spec: Any, prim: Any, kinds: PrimKinds) -> Iterator[LostOverride]:
    schemas = kinds.names(kinds.key(prim))
    if schema.OURS.isdisjoint(schemas):
        return
    declared = schema.attributes_of(schemas)
    for spec in prim_spec.properties:
        if spec.name in declared:
            attribute = prim.GetAttribute(spec.name)
            if attribute and not says_the_same(spec, attribute):
                yield LostOverride(attribute, spec)
        elif schema.VOLUME in schemas and spec.name.startswith(schema.FIELD_NAMESPACE):
            relationship = prim.GetRelationship(spec.name)
            if relationship and _names(spec.targetPathList.GetAddedOrExplicitItems()) != _names(
                relationship.GetTargets()
            ):
                yield LostOverride(relationship, spec)


def _names(paths: Iterable[Any]) -> list[str]:
    """The last names of paths, which lie in different namespaces."""
    return sorted(path.name for path in paths)
