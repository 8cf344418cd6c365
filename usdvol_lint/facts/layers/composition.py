"""What USD could not compose, and which prims of the stage may lack opinions or values."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from pxr import Pcp, Sdf, Usd

from usdvol_lint.facts.files.paths import is_uri
from usdvol_lint.facts.layers.error_texts import (
    ARCS,
    LayerArc,
    as_sentence,
    blamed_spec,
    missing_arc,
    reason_in,
)
from usdvol_lint.facts.layers.unopened import missing_clips, unopened_reason
from usdvol_lint.facts.usd.clips import ClipSet
from usdvol_lint.facts.usd.instances import in_prototype

_ASSET_ERRORS = frozenset({Pcp.ErrorType_InvalidAssetPath, Pcp.ErrorType_InvalidSublayerPath})


@dataclass(frozen=True, slots=True)
class MissingLayer:
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


@dataclass(frozen=True, slots=True)
class CompositionError:
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


@dataclass(frozen=True)
class Composition:
    """What a stage could not compose, without duplicates and in the same order in every run.

    `unloaded`: the prims with payloads that were not loaded.
    """

    missing_layers: tuple[MissingLayer, ...]
    errors: tuple[CompositionError, ...]
    unloaded: tuple[Any, ...]

    @property
    def is_whole(self) -> bool:
        """Whether every layer that an arc names could be opened and was loaded."""
        return not self.unloaded and not self._lack_opinions

    def may_lack(self, prim: Any) -> bool:
        """Whether a layer that failed to open may have opinions on a prim or those below it."""
        return _is_at_or_below(prim, self._lack_opinions)

    def may_lack_values(self, prim: Any) -> bool:
        """As `may_lack`, and value clips count too, which supply only attribute values."""
        return _is_at_or_below(prim, self._lack_opinions | self._lack_clips)

    @cached_property
    def _lack_opinions(self) -> frozenset[Any]:
        return _as_walked(missing for missing in self.missing_layers if missing.arc in ARCS)

    @cached_property
    def _lack_clips(self) -> frozenset[Any]:
        return _as_walked(missing for missing in self.missing_layers if missing.arc not in ARCS)


def read_composition(stage: Any, clip_sets: Iterable[ClipSet]) -> Composition:
    """Reads the composition errors of the stage and opens the layers that clip sets name.

    An error in a layer that many prims compose becomes one error, known by its spec.
    """
    missing: dict[LayerArc, list[Any]] = defaultdict(list)
    reported: dict[str, set[str]] = defaultdict(set)
    errors: dict[tuple[str, Any], list[Any]] = defaultdict(list)
    for arc, prim in missing_clips(clip_sets):
        missing[arc].append(prim)
    for error, prim in _errors(stage):
        text = str(error)
        unopened = missing_arc(text) if error.errorType in _ASSET_ERRORS else None
        if unopened:
            missing[unopened].append(prim)
            reported[unopened.path].add(reason_in(text, unopened.path))
        else:
            errors[as_sentence(text), blamed_spec(text)].append(prim)
    return Composition(_missing_layers(missing, reported), _others(errors), _unloaded(stage))


def _errors(stage: Any) -> Iterator[tuple[Any, Any]]:
    """The composition errors, each with the prim where it occurs; none of inactive prims."""
    for error in stage.GetCompositionErrors():
        prim = stage.GetPrimAtPath(error.rootSite.path) or stage.GetPseudoRoot()
        if prim.IsActive():
            yield error, prim


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


def _others(errors: Mapping[tuple[str, Any], Iterable[Any]]) -> tuple[CompositionError, ...]:
    found = (CompositionError(*error, _sorted(prims)) for error, prims in errors.items())
    return tuple(sorted(found, key=lambda error: (str(error.prim.GetPath()), error.message)))


def _unloaded(stage: Any) -> tuple[Any, ...]:
    if stage.GetLoadRules() == Usd.StageLoadRules.LoadAll():
        return ()  # FindLoadable would traverse the whole stage
    loadable = map(stage.GetPrimAtPath, sorted(stage.FindLoadable()))
    return tuple(prim for prim in loadable if prim and not prim.IsLoaded())


def _sorted(prims: Iterable[Any]) -> tuple[Any, ...]:
    return tuple(sorted(dict.fromkeys(prims), key=lambda prim: prim.GetPath()))


def _as_walked(missing_layers: Iterable[MissingLayer]) -> frozenset[Any]:
    """The paths of the prims as the walk visits them: those in instances are in prototypes."""
    prims = [prim for missing in missing_layers for prim in missing.prims]
    prims += [prim.GetPrototype() for prim in prims if prim.IsInstance()]
    return frozenset(in_prototype(prim).GetPath() for prim in prims)


def _is_at_or_below(prim: Any, paths: frozenset[Any]) -> bool:
    path = in_prototype(prim).GetPath()
    return not paths.isdisjoint([Sdf.Path.absoluteRootPath, *path.GetPrefixes()])
