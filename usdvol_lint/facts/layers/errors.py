"""Reads what USD could not compose from its errors, and from the layers that clip sets name."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Any

from pxr import Pcp

from usdvol_lint.facts.layers.composition import (
    Composition,
    CompositionError,
    MissingLayer,
    unloaded_prims,
)
from usdvol_lint.facts.layers.error_texts import (
    LayerArc,
    PrimArc,
    as_sentence,
    blamed_spec,
    missing_arc,
    reason_in,
    unresolved_arc,
)
from usdvol_lint.facts.layers.unopened import missing_clips, unopened_reason, unread_extension
from usdvol_lint.facts.layers.unresolved import EmptyArc, Fault, Targets
from usdvol_lint.facts.usd.calls import ARCS, get_prim_stack
from usdvol_lint.facts.usd.clips import ClipSet
from usdvol_lint.facts.usd.instances import as_shown

_ASSET_ERRORS = frozenset({Pcp.ErrorType_InvalidAssetPath, Pcp.ErrorType_InvalidSublayerPath})


def read_composition(
    stage: Any, errors: Iterable[Any], clip_sets: Iterable[ClipSet]
) -> Composition:
    """Reads the composition errors of the stage, and opens the layers that clip sets name.

    An error in a layer that many prims compose becomes one error, known by its spec.
    """
    found = _Found()
    targets = Targets()
    for arc, prim in missing_clips(clip_sets):
        found.missing[arc].append(prim)
    for fault, prims in _faults(stage, errors, targets).items():
        for prim in prims:
            found.add(fault, prim)
    return Composition(
        _missing_layers(found.missing, found.reasons),
        _empty_arcs(found.empty, targets),
        _others(found.errors),
        unloaded_prims(stage),
    )


class _Found:
    """The composition errors by what they are about, with the prims where they occur."""

    def __init__(self) -> None:
        self.missing: dict[LayerArc, list[Any]] = defaultdict(list)
        self.reasons: dict[str, set[str]] = defaultdict(set)
        self.empty: dict[PrimArc, list[Any]] = defaultdict(list)
        self.errors: dict[tuple[str, Any], list[Any]] = defaultdict(list)

    def add(self, fault: Fault, prim: Any) -> None:
        """Adds an error that occurs at a prim."""
        text = fault.text
        unopened = missing_arc(text) if fault.type in _ASSET_ERRORS else None
        is_unresolved = fault.type == Pcp.ErrorType_UnresolvedPrimPath
        empty = unresolved_arc(text) if is_unresolved else None
        if unopened:
            self.missing[unopened].append(prim)
            self.reasons[unopened.path].add(reason_in(text, unopened.path))
        elif empty:
            self.empty[empty].append(prim)
        else:
            self.errors[as_sentence(text), blamed_spec(text) or _with_arcs(prim)].append(prim)


def _with_arcs(prim: Any) -> Any | None:
    """The strongest spec of a prim that has arcs, or the strongest."""
    stack = get_prim_stack(prim)
    return next((spec for spec in stack if any(map(spec.HasInfo, ARCS))), next(iter(stack), None))


def _faults(stage: Any, errors: Iterable[Any], targets: Targets) -> dict[Fault, list[Any]]:
    """The composition errors, each with the prims where it occurs; none of inactive prims.

    USD blames some on prims that are not on the stage, because an arc leads to one below them.
    """
    own: dict[Fault, list[Any]] = defaultdict(list)
    behind_arcs: dict[Fault, list[Any]] = defaultdict(list)
    elsewhere: dict[Fault, list[Any]] = {}
    for error in errors:
        prim = stage.GetPrimAtPath(error.rootSite.path)
        fault = Fault(str(error), error.errorType)
        if not prim:
            elsewhere[fault] = [stage.GetPseudoRoot()]
        elif prim.IsActive():
            for cause in targets.causes(fault):
                (own if cause == fault else behind_arcs)[cause].append(prim)
    return elsewhere | behind_arcs | own


def _missing_layers(
    missing: Mapping[LayerArc, Iterable[Any]], reported: Mapping[str, set[str]]
) -> tuple[MissingLayer, ...]:
    paths = {arc.path for arc in missing}
    reasons = {path: unopened_reason(path, reported.get(path, ())) for path in paths}
    extensions = {path: unread_extension(path) for path in paths}
    layers = (
        MissingLayer(*arc, reasons[arc.path], extensions[arc.path], _sorted(prims))
        for arc, prims in missing.items()
    )
    return tuple(sorted(layers, key=_missing_order))


def _missing_order(missing: MissingLayer) -> tuple[str, ...]:
    spec = missing.spec
    return (str(missing.prim.GetPath()), spec.layer.identifier, str(spec.path), missing.asset)


def _empty_arcs(empty: Mapping[PrimArc, Iterable[Any]], targets: Targets) -> tuple[EmptyArc, ...]:
    arcs = (targets.empty_arc(arc, _sorted(prims)) for arc, prims in empty.items())
    return tuple(sorted(arcs, key=_empty_order))


def _empty_order(arc: EmptyArc) -> tuple[str, ...]:
    spec = arc.spec
    where = (str(arc.prim.GetPath()), spec.layer.identifier, str(spec.path))
    return (*where, arc.asset, arc.target)


def _others(errors: Mapping[tuple[str, Any], Iterable[Any]]) -> tuple[CompositionError, ...]:
    found = (CompositionError(*error, _sorted(prims)) for error, prims in errors.items())
    return tuple(sorted(found, key=lambda error: (str(error.prim.GetPath()), error.message)))


def _sorted(prims: Iterable[Any]) -> tuple[Any, ...]:
    return tuple(as_shown(prims))
