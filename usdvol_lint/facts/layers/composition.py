"""What USD could not compose, and which prims of the stage may lack opinions or values."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any, NamedTuple

from pxr import Pcp, Sdf, Usd

from usdvol_lint.facts.files.paths import is_uri
from usdvol_lint.facts.layers.error_texts import (
    ARCS,
    LayerArc,
    PrimArc,
    as_sentence,
    blamed_spec,
    missing_arc,
    reason_in,
    unresolved_arc,
)
from usdvol_lint.facts.layers.unopened import missing_clips, unopened_reason
from usdvol_lint.facts.layers.unresolved import EmptyArc, Fault, Targets
from usdvol_lint.facts.usd.clips import ClipSet
from usdvol_lint.facts.usd.instances import as_shown, in_prototype

_ASSET_ERRORS = frozenset({Pcp.ErrorType_InvalidAssetPath, Pcp.ErrorType_InvalidSublayerPath})


class MissingLayer(NamedTuple):
    """A layer that USD can't open, named by an arc or a clip set.

    `arc`, `asset`, `path` and `spec` are as in `LayerArc`.
    `reason`: what is wrong with a file that exists, or "".
    `prims`: those of the stage that are composed without it, at least one.
    """

    arc: str
    asset: str
    path: str
    spec: Any
    reason: str
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        """The first of the prims."""
        return self.prims[0]

    @property
    def is_uri(self) -> bool:
        """Whether the authored path is a URI."""
        return is_uri(self.asset)


class CompositionError(NamedTuple):
    """Any other error.

    `message`: USD's text in one line.
    `spec`: the one to blame, if the text names it.
    `prims`: those of the stage where it occurs, at least one.
    """

    message: str
    spec: Any | None
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        """The first of the prims."""
        return self.prims[0]


class Composition:
    """What a stage could not compose, without duplicates and in the same order in every run.

    `unloaded`: the prims with payloads that were not loaded.
    """

    def __init__(
        self,
        missing_layers: tuple[MissingLayer, ...],
        empty_arcs: tuple[EmptyArc, ...],
        errors: tuple[CompositionError, ...],
        unloaded: tuple[Any, ...],
    ) -> None:
        self.missing_layers = missing_layers
        self.empty_arcs = empty_arcs
        self.errors = errors
        self.unloaded = unloaded

    @property
    def is_whole(self) -> bool:
        """Whether every arc could be followed and every payload was loaded."""
        return not self.unloaded and not self._lack_opinions

    def may_lack(self, prim: Any) -> bool:
        """Whether an arc that brings nothing may have opinions on a prim or those below it."""
        return _is_at_or_below(prim, self._lack_opinions)

    def may_lack_values(self, prim: Any) -> bool:
        """As `may_lack`, and value clips count too, which supply only attribute values."""
        return _is_at_or_below(prim, self._lack_opinions | self._lack_clips)

    @cached_property
    def _lack_opinions(self) -> frozenset[Any]:
        missing = [missing for missing in self.missing_layers if missing.arc in ARCS]
        return _as_walked([*missing, *self.empty_arcs])

    @cached_property
    def _lack_clips(self) -> frozenset[Any]:
        return _as_walked(missing for missing in self.missing_layers if missing.arc not in ARCS)


def read_composition(stage: Any, clip_sets: Iterable[ClipSet]) -> Composition:
    """Reads the composition errors of the stage and opens the layers that clip sets name.

    An error in a layer that many prims compose becomes one error, known by its spec.
    """
    found = _Found()
    targets = Targets()
    for arc, prim in missing_clips(clip_sets):
        found.missing[arc].append(prim)
    for fault, prims in _faults(stage, targets).items():
        for prim in prims:
            found.add(fault, prim)
    return Composition(
        _missing_layers(found.missing, found.reasons),
        _empty_arcs(found.empty, targets),
        _others(found.errors),
        _unloaded(stage),
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
            self.errors[as_sentence(text), blamed_spec(text)].append(prim)


def _faults(stage: Any, targets: Targets) -> dict[Fault, list[Any]]:
    """The composition errors, each with the prims where it occurs; none of inactive prims.

    USD blames some on prims that are not on the stage, because an arc leads to one below them.
    """
    own: dict[Fault, list[Any]] = defaultdict(list)
    behind_arcs: dict[Fault, list[Any]] = defaultdict(list)
    elsewhere: dict[Fault, list[Any]] = {}
    for error in stage.GetCompositionErrors():
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
    layers = (
        MissingLayer(*arc, reasons[arc.path], _sorted(prims)) for arc, prims in missing.items()
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


def _unloaded(stage: Any) -> tuple[Any, ...]:
    if stage.GetLoadRules() == Usd.StageLoadRules.LoadAll():
        return ()  # FindLoadable would traverse the whole stage
    loadable = map(stage.GetPrimAtPath, sorted(stage.FindLoadable()))
    return tuple(prim for prim in loadable if prim and not prim.IsLoaded())


def _sorted(prims: Iterable[Any]) -> tuple[Any, ...]:
    return tuple(as_shown(prims))


def _as_walked(lacking: Iterable[MissingLayer | EmptyArc]) -> frozenset[Any]:
    """The paths of the prims as the walk visits them: those in instances are in prototypes."""
    prims = [prim for each in lacking for prim in each.prims]
    prims += [prim.GetPrototype() for prim in prims if prim.IsInstance()]
    return frozenset(in_prototype(prim).GetPath() for prim in prims)


def _is_at_or_below(prim: Any, paths: frozenset[Any]) -> bool:
    path = in_prototype(prim).GetPath()
    return not paths.isdisjoint([Sdf.Path.absoluteRootPath, *path.GetPrefixes()])
