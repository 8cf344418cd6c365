"""What a stage brings to the layers below its root: what these lack by themselves."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from typing import Any, TypeAlias

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.engine.lacking import levels_to, places_of, prim_above
from usdvol_lint.engine.spec_parts import (
    COEFFICIENTS,
    DEGREE,
    EXTENT,
    applies,
    either,
    has_beside,
    has_fields,
    has_targets,
    has_type,
    holds_value,
    is_brought,
    is_def,
    is_field,
    is_in_variant,
    wanted,
)
from usdvol_lint.facts import Facts
from usdvol_lint.facts.prims.tables import Table
from usdvol_lint.facts.usd.calls import ARCS, get_prim_stack
from usdvol_lint.facts.usd.clips import ClipSet
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.volumes.states import TargetState
from usdvol_lint.model import Completed, Completion
from usdvol_lint.schema import CLIPS, FIELD_NAMESPACE, PRIMS, SPECIFIER, TYPE_NAME

_Layers: TypeAlias = tuple[str, ...]


def completion(facts: Facts) -> Completion | None:
    """What a stage of several layers completes; None if nothing."""
    found = _Completions(facts)
    found.find()
    return found.result()


class _Completions:
    """Collects what is completed, by layers and path; whatever can't be read completes nothing."""

    def __init__(self, facts: Facts) -> None:
        stage = facts.stage
        own = {stage.GetRootLayer(), stage.GetSessionLayer()}
        used = [layer for layer in stage.GetUsedLayers() if layer not in own]
        self._facts = facts
        self._used = used
        self._paths = {layer: (layer.realPath,) for layer in used if layer.realPath}
        self._clips: set[str] = set()
        self._found: dict[tuple[_Layers, str], set[str]] = defaultdict(set)
        self._local = frozenset(stage.GetLayerStack())

    def result(self) -> Completion | None:
        if not self._found:
            return None
        layers = {path for paths in self._paths.values() for path in paths} | self._clips
        return Completion(
            tuple(sorted(layers)),
            tuple(
                Completed(layers, path, tuple(sorted(what)))
                for (layers, path), what in sorted(self._found.items())
            ),
        )

    def find(self) -> None:
        tables = self._facts.tables
        for table in tables.of(*schema.OURS):
            for find in (self._find_values, self._find_types, self._find_apis, self._find_clipped):
                with suppress(*UNREADABLE):  # what can't be read, a rule that asks for it reports
                    find(table)
        for table in tables.of(schema.VOLUME):
            with suppress(*UNREADABLE):
                self._find_bindings(table)
        for find_any in (self._find_definitions, self._find_clips, self._find_prims):
            with suppress(*UNREADABLE):
                find_any()

    def _add(self, prim: Any, spec: Any, *what: str) -> None:
        """Adds what a spec of a prim lacks, and where that shows, in layers below the root."""
        for layer, path in ((spec.layer, str(spec.path)), *places_of(prim)):
            if layers := self._paths.get(layer):
                self._found[layers, path].update(what)

    def _find_values(self, table: Table) -> None:
        """The attributes of which another spec has the value."""
        authored = table.authored
        names = wanted(authored.schemas)
        if DEGREE in names and DEGREE not in authored.declared:
            names.remove(DEGREE)  # nothing but a spec has it, and often none
        if not authored.is_layered and not authored.is_clipped:
            names = [name for name in names if authored.declared.keys().isdisjoint(either(name))]
        for prim, stack, makers in self._rows(table) if names else ():
            for spec in makers:
                for name in names:
                    has = partial(holds_value, name)
                    if not self._has_itself(spec, stack, has) and self._has(prim, name):
                        self._add(prim, spec, name)

    def _rows(self, table: Table) -> Iterator[tuple[Any, Sequence[Any], Sequence[Any]]]:
        """The prims with their specs, and those specs that make a prim in a layer below."""
        for prim, stack in zip(table.prims, table.batch.stacks, strict=True):
            makers = list(filter(self._makes, stack))
            if makers:
                yield prim, stack, makers

    def _has_itself(self, spec: Any, stack: Sequence[Any], has: Callable[[Any], bool]) -> bool:
        """Whether a spec has something, or a weaker one that its own arcs may bring."""
        if has(spec):
            return True
        if not any(map(spec.HasInfo, ARCS)):
            return False
        siblings = self._local if spec.layer in self._local else ()
        weaker = stack[stack.index(spec) + 1 :]
        return any(has(each) for each in weaker if each.layer not in siblings)

    def _makes(self, spec: Any) -> bool:
        """Whether a spec in a layer below the root makes a prim."""
        return spec.layer in self._paths and spec.specifier == Sdf.SpecifierDef

    def _has(self, prim: Any, name: str) -> bool:
        if name == EXTENT and not prim.GetAttribute(EXTENT).HasAuthoredValue():
            return prim not in self._bare
        if name == COEFFICIENTS and self._facts.particles.material_is_bound(prim):
            return True
        return any(is_brought(prim, each) for each in either(name))

    @cached_property
    def _bare(self) -> frozenset[Any]:
        return frozenset(self._facts.prims.without_extent)

    def _find_types(self, table: Table) -> None:
        """The types of which another spec has a better one."""
        if not table.authored.is_layered:
            return
        for prim, stack, makers in self._rows(table):
            for spec in makers:
                if not self._has_itself(spec, stack, has_type):
                    self._add(prim, spec, TYPE_NAME)

    def _find_apis(self, table: Table) -> None:
        """The APIs of particle fields that another spec applies."""
        apis = sorted(schema.API_INCLUDES.keys() & table.authored.schemas)
        for prim, stack, makers in self._rows(table) if apis and table.authored.is_layered else ():
            for spec in makers:
                for api in apis:
                    if not self._has_itself(spec, stack, partial(applies, api)):
                        self._add(prim, spec, schema.applied(api))

    def _find_clipped(self, table: Table) -> None:
        """What the prims have that value clips and their manifests need not have."""
        if not table.authored.is_clipped:
            return
        names = wanted(table.authored.schemas)
        for prim in table.prims:
            bindings = prim.GetAuthoredPropertiesInNamespace(FIELD_NAMESPACE)
            has = {name for name in names if self._has(prim, name)} | {TYPE_NAME, FIELD_NAMESPACE}
            has.update(each.GetName() for each in bindings)
            for clip_set in self._facts.layers.clips.reaching(prim):
                self._find_in_clips(prim, clip_set, has)

    def _find_in_clips(self, prim: Any, clip_set: ClipSet, has: set[str]) -> None:
        assets = [*clip_set.clips, *filter(None, (clip_set.manifest,))]
        layers = tuple(sorted({each.resolvedPath for each in assets} - {""}))
        if layers:
            path = prim.GetPath().ReplacePrefix(clip_set.prim.GetPath(), clip_set.prim_path)
            self._clips.update(layers)
            self._found[layers, str(path)] |= has
            for above in path.GetPrefixes():
                self._found[layers, str(above)].add(SPECIFIER)

    def _find_bindings(self, table: Table) -> None:
        """The fields of Volumes in other layers, and the Volumes of fields in other layers."""
        columns = zip(
            table.prims,
            table.batch.stacks,
            self._facts.volumes.bound_fields.all(table),
            strict=True,
        )
        relationships = [Sdf.Path(f".{name}") for name in table.authored.bound]
        for volume, stack, fields in columns:
            is_below = fields.bindings is None
            if is_below and not table.authored.is_layered:
                continue  # nearly always: no other layer has a spec of the Volume
            stacks = [get_prim_stack(chunk.prims[index]) for chunk, index in fields.slots]
            if not stacks or (is_below and self._are_whole(stack, relationships, stacks)):
                continue
            for binding, target in self._facts.volumes.bindings(volume).with_target(
                TargetState.FIELD
            ):
                self._find_binding(stack, binding.property, target.prim)

    def _are_whole(
        self, volume: Sequence[Any], relationships: Sequence[Any], fields: Sequence[Sequence[Any]]
    ) -> bool:
        """Whether each layer that makes a Volume makes its fields too, and the other way round."""
        makers = list(filter(self._makes, volume))
        layers = [spec.layer for spec in makers]
        for field in fields:
            own = [spec for spec in filter(self._makes, field) if has_type(spec)]
            if [spec.layer for spec in own] != layers or any(map(is_in_variant, own)):
                return False
        return all(has_targets(spec, path) for spec in makers for path in relationships)

    def _find_binding(self, volume: Sequence[Any], binding: Any, target: Any) -> None:
        prim, field = binding.GetPrim(), get_prim_stack(target)
        opinions = [spec for spec in binding.GetPropertyStack() if spec.HasInfo("targetPaths")]

        def binds(spec: Any) -> bool:
            return has_beside(spec, filter(is_field, field)) and has_beside(spec, opinions)

        def is_bound(spec: Any) -> bool:
            return has_beside(spec, filter(is_def, volume)) and has_beside(spec, opinions)

        for spec in filter(self._makes, volume):
            if not self._has_itself(spec, volume, binds):
                self._add(prim, spec, binding.GetName())
            if not self._has_itself(spec, volume, has_fields):
                self._add(prim, spec, FIELD_NAMESPACE)
        for spec in filter(self._makes, field):
            if not self._has_itself(spec, field, is_bound):
                self._add(target, spec, FIELD_NAMESPACE)

    def _find_definitions(self) -> None:
        """The overs with a prim of ours below them in the same layer that another layer defines."""
        overs: dict[Any, set[Any]] = defaultdict(set)
        for _, _, parents in self._facts.layers.layered:
            for spec in parents:
                if spec.specifier == Sdf.SpecifierOver and spec.layer in self._paths:
                    overs[spec.layer].add(spec.path)
        for table in self._facts.tables.of(*schema.OURS) if overs else ():
            for prim, stack in zip(table.prims, table.batch.stacks, strict=True):
                for spec in (each for each in stack if each.layer in overs and is_def(each)):
                    for path in overs[spec.layer].intersection(spec.path.GetPrefixes()):
                        over = spec.layer.GetPrimAtPath(path)
                        above = prim_above(prim, levels_to(spec, over))
                        if above and over in get_prim_stack(above):  # else only a piece is brought
                            self._add(above, over, SPECIFIER)

    def _find_clips(self) -> None:
        """The clip sets of which other specs have a part."""
        for prim in self._facts.layers.clips.bearing:
            specs = [spec for spec in get_prim_stack(prim) if spec.HasInfo("clips")]
            if len(specs) > 1:
                for spec in specs:
                    self._add(prim, spec, CLIPS)

    def _find_prims(self) -> None:
        """The sublayers without prims."""
        below = {
            Sdf.Layer.FindRelativeToLayer(layer, path)
            for layer in (self._facts.stage.GetRootLayer(), *self._used)
            for path in layer.subLayerPaths
        }
        if self._facts.stage.GetPseudoRoot().GetAllChildren():
            for layer in below.intersection(self._paths):
                if not layer.rootPrims:
                    self._found[self._paths[layer], "/"].add(PRIMS)
