"""References and payloads that bring nothing, because the prim that they name is not there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from pxr import Pcp, Sdf, Usd

from usdvol_lint.facts.layers.error_texts import PrimArc, unresolved_arc
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.spelling import closest_name

_WHY_NOT_THERE = frozenset(
    {
        Pcp.ErrorType_InvalidAssetPath,
        Pcp.ErrorType_InvalidSublayerPath,
        Pcp.ErrorType_UnresolvedPrimPath,
    }
)
_NOWHERE = "/__nowhere__"
_CLOSE = 0.78
"""Of five letters one may be another."""


class EmptyArc(NamedTuple):
    """A reference or payload to a prim that its layer does not hold.

    `arc`, `asset` and `spec` are as in `LayerArc`; `asset` is "" for an arc inside a layer stack.
    `target`: the prim's path as authored, or "" for the layer's default prim.
    `default`: the `defaultPrim` that leads to no prim, as authored; "" if the layer has none.
    `similar`: the path of the prim that was probably meant, if there is one.
    `roots`: the names of the prims that are defined at the root of the layer.
    `prims`: those of the stage that are composed without it, at least one.
    """

    arc: str
    asset: str
    target: str
    default: str
    spec: Any
    similar: str | None
    roots: tuple[str, ...]
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        """The first of the prims."""
        return self.prims[0]

    @property
    def place(self) -> str | None:
        """The arc in the text of its layer, as `TextLayer.find` takes it."""
        return f"{self.asset}<{self.target}>" if self.target else self.asset or None


class Fault(NamedTuple):
    """A composition error: `type` is one of `Pcp.ErrorType`."""

    text: str
    type: Any


class _Sought(NamedTuple):
    """What was found where an arc asks for a prim.

    `faults`: the errors in composing the prim and its ancestors.
    """

    faults: tuple[Fault, ...] = ()
    similar: str | None = None
    roots: tuple[str, ...] = ()


class Targets:
    """The prims that arcs ask for and USD does not find, each looked for once."""

    def __init__(self) -> None:
        self._sought: dict[tuple[str, str, str], _Sought] = {}

    def causes(self, fault: Fault) -> Iterator[Fault]:
        """The faults that keep away the prim that an arc asks for, or the fault itself.

        A layer that does not open may hold the prim, if an ancestor of the prim names that layer.
        """
        return self._causes(fault, frozenset())

    def empty_arc(self, arc: PrimArc, prims: tuple[Any, ...]) -> EmptyArc:
        """What is known of an arc to a prim that is not there."""
        layer = Sdf.Layer.Find(arc.path)
        default = "" if arc.target or not layer else layer.defaultPrim
        _, similar, roots = self._seek(arc)
        if similar and not arc.asset and _are_nested(similar, arc.spec.path):
            similar = None  # USD would call it a cycle
        return EmptyArc(arc.arc, arc.asset, arc.target, default, arc.spec, similar, roots, prims)

    def _causes(self, fault: Fault, above: frozenset[Fault]) -> Iterator[Fault]:
        above |= {fault}
        is_unresolved = fault.type == Pcp.ErrorType_UnresolvedPrimPath
        arc = unresolved_arc(fault.text) if is_unresolved else None
        deeper = [each for each in self._seek(arc).faults if each not in above] if arc else []
        for each in deeper:
            yield from self._causes(each, above)
        if not deeper:
            yield fault

    def _seek(self, arc: PrimArc) -> _Sought:
        key = arc.path, arc.target, arc.wanted
        if key not in self._sought:
            self._sought[key] = _seek(arc)
        return self._sought[key]


def _seek(arc: PrimArc) -> _Sought:
    stage = _compose(arc.path, arc.wanted or _NOWHERE)
    if not stage:
        return _Sought()
    roots = () if arc.target else _roots(stage)
    if not arc.wanted:
        return _Sought(roots=roots)
    errors = stage.GetCompositionErrors()
    faults = [Fault(str(error), error.errorType) for error in errors]
    return _Sought(
        tuple(fault for fault in faults if fault.type in _WHY_NOT_THERE),
        _similar(stage, arc),
        roots,
    )


def _compose(layer_path: str, path: str) -> Any | None:
    """A layer as a stage, with the prim at a path and its ancestors alone."""
    layer = Sdf.Layer.Find(layer_path)
    try:
        return Usd.Stage.OpenMasked(layer, Usd.StagePopulationMask([path])) if layer else None
    except UNREADABLE:  # such as for value clips that do not open
        return None


def _similar(stage: Any, arc: PrimArc) -> str | None:
    """The path that an arc probably means: its first name that is not there is misspelt."""
    path = Sdf.Path(arc.wanted)
    missing = next((each for each in path.GetPrefixes() if not stage.GetPrimAtPath(each)), None)
    if missing is None:
        return None
    parent = missing.GetParentPath()
    names, _ = stage.GetPrimAtPath(parent).GetPrimIndex().ComputePrimChildNames()
    name = closest_name(missing.name, frozenset(names), _CLOSE)
    if name is None:
        return None
    similar = path.ReplacePrefix(missing, parent.AppendChild(name))
    composed = _compose(arc.path, str(similar))
    return str(similar) if composed and composed.GetPrimAtPath(similar) else None


def _are_nested(path: str, other: Any) -> bool:
    """Whether a path is the other one, or above or below it."""
    one, other = Sdf.Path(path), other.StripAllVariantSelections()
    return bool(one.HasPrefix(other) or other.HasPrefix(one))


def _roots(stage: Any) -> tuple[str, ...]:
    names = (
        spec.name
        for layer in stage.GetLayerStack(includeSessionLayers=False)
        for spec in layer.rootPrims
        if spec.specifier == Sdf.SpecifierDef
    )
    return tuple(dict.fromkeys(names))
