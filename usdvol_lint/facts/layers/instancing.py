"""Overrides below instances, which USD passes over: what an instance shows is its prototype."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.facts.usd.arcs import Layered
from usdvol_lint.facts.usd.below import each_below
from usdvol_lint.facts.usd.calls import get_prim_stack
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.usd.sameness import says_the_same


class LostOverride(NamedTuple):
    """A spec below an instance, for what is at `path`, that would count if USD looked there.

    `at` is the property or prim that is there; for a prim that is not, the one above it.
    """

    path: Any
    at: Any
    spec: Any


class LostOverrides(NamedTuple):
    """All lost overrides below one instance in one layer."""

    instance: Any
    overrides: tuple[LostOverride, ...]


def lost_overrides(
    stage: Any, layered: Iterable[Layered], kinds: PrimKinds, ours: Iterable[Any]
) -> Iterator[LostOverrides]:
    """The overrides below instances of prims of ours, by the paths of instances and by layers.

    These are properties that differ, prims made inactive, and prims that the prototype lacks.
    Only specs count that are at least as strong as the one that makes the prim an instance: who
    wrote them could know that it is one.
    """
    holders = _prototypes_of(stage, ours)
    found = []
    for instance, specs, parents in layered:
        if len(parents) > 1 and instance.IsInstance():
            shows_ours = instance.GetPrototype().GetPath() in holders
            by_layer: dict[Any, list[LostOverride]] = defaultdict(list)
            for each in _below(instance, _strong_specs(specs), kinds, shows_ours):
                by_layer[each.spec.layer].append(each)
            found += [LostOverrides(instance, tuple(each)) for each in by_layer.values()]
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


def _below(
    instance: Any, specs: list[Any], kinds: PrimKinds, shows_ours: bool
) -> Iterator[LostOverride]:
    """What the specs say below an instance; `shows_ours`: whether it has prims of ours."""
    stage = instance.GetStage()
    pending = [
        (child, instance.GetPath().AppendChild(child.name))
        for spec in reversed(specs)
        for child in spec.nameChildren
    ]
    while pending:
        spec, path = pending.pop()
        prim = stage.GetPrimAtPath(path)
        if prim and spec in get_prim_stack(prim):
            continue
        if not prim and (spec.specifier != Sdf.SpecifierDef or not spec.active):
            continue
        if not prim and _are_ours(kinds.names((spec.typeName,))):
            yield LostOverride(path, _nearest(stage, path), spec)
            continue
        pending += [(child, path.AppendChild(child.name)) for child in spec.nameChildren]
        if prim and shows_ours:
            yield from _changed(spec, prim, kinds)


def _nearest(stage: Any, path: Any) -> Any:
    """The prim at the longest part of a path that has one."""
    while not (prim := stage.GetPrimAtPath(path)):
        path = path.GetParentPath()
    return prim


def _are_ours(schemas: Iterable[str]) -> bool:
    return not schema.OURS.isdisjoint(schemas)


def _strong_specs(stack: Iterable[Any]) -> list[Any]:
    """The specs down to the first that makes the prim an instance; none if a variant says it."""
    specs: list[Any] = []
    count = 0
    for spec in stack:
        says = spec.HasInfo("instanceable")
        if says and (not spec.instanceable or spec.path.ContainsPrimVariantSelection()):
            break
        if not spec.path.ContainsPrimVariantSelection():
            specs.append(spec)
            count = len(specs) if says else count
    return specs[:count]


def _changed(prim_spec: Any, prim: Any, kinds: PrimKinds) -> Iterator[LostOverride]:
    schemas = kinds.names(kinds.key(prim))
    if not prim_spec.active and _shows_ours(prim, kinds):
        yield LostOverride(prim.GetPath(), prim, prim_spec)
        return
    if not _are_ours(schemas):
        return
    declared = schema.attributes_of(schemas)
    for spec in prim_spec.properties:
        if spec.name in declared:
            attribute = prim.GetAttribute(spec.name)
            if attribute and not says_the_same(spec, attribute):
                yield LostOverride(attribute.GetPath(), attribute, spec)
        elif schema.VOLUME in schemas and spec.name.startswith(schema.FIELD_NAMESPACE):
            relationship = prim.GetRelationship(spec.name)
            if relationship and _names(spec.targetPathList.GetAddedOrExplicitItems()) != _names(
                relationship.GetTargets()
            ):
                yield LostOverride(relationship.GetPath(), relationship, spec)


def _shows_ours(prim: Any, kinds: PrimKinds) -> bool:
    """Whether a prim, or one below it, is of ours and drawn."""
    return any(_are_ours(kinds.names(kinds.key(each))) for each in each_below(prim))


def _names(paths: Iterable[Any]) -> list[str]:
    """The last names of paths, which lie in different namespaces."""
    return sorted(path.name for path in paths)
