"""Layers that say no rate, and what USD makes of their time samples for that reason."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

from usdvol_lint.facts.prims.animated import animated
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.bringing import meeting_spec
from usdvol_lint.facts.usd.clips import Clips
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.instances import as_shown
from usdvol_lint.facts.usd.nodes import nodes_of
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion

_USUAL = 24.0
"""The rate that USD takes for that of a layer that says none."""

_FEW = 4
"""Samples outside of the range count from a quarter of them on: some overhang at an end is none."""


@dataclass(frozen=True, slots=True)
class Displaced:
    """Time samples that land elsewhere because their layer says no rate: an `Occurrence`.

    `times`: those that land between frames, or else outside of the stage's time range.
    `total`: the number of the attribute's samples.
    """

    attribute: Any
    times: tuple[float, ...]
    are_between: bool
    total: int
    at_default: ClassVar[bool] = False
    asset: ClassVar[None] = None


class UnsaidRate(NamedTuple):
    """A layer that says neither timeCodesPerSecond nor framesPerSecond.

    `rate`: the stage's; `scale`: that by which USD therefore scales times in the layer.
    `displaced`: the attributes with samples in the layer, at least one, sorted by path.
    """

    layer: Any
    rate: float
    scale: float
    displaced: tuple[Displaced, ...]

    @property
    def blamed(self) -> Any:
        """The spec that first brings the layer into one of the stage's rate."""
        prim = self.displaced[0].attribute.GetPrim()
        return meeting_spec(prim, self.layer, lambda other: other.timeCodesPerSecond == self.rate)

    def displaces(self, attribute: Any) -> bool:
        """Whether samples of an attribute are at other times because of it."""
        return any(each.attribute == attribute for each in self.displaced)


def unsaid_rates(
    stage: Any, tables: Tables, clips: Clips, time_range: tuple[float, float] | None
) -> tuple[UnsaidRate, ...]:
    """The layers that say no rate and whose samples the stage therefore has at other times."""
    rate = stage.GetTimeCodesPerSecond()
    layers = _without_rate(stage) if rate != _USUAL else frozenset()
    own = rate / _USUAL
    found: dict[Any, dict[Any, list[Displaced]]] = defaultdict(lambda: defaultdict(list))
    for attribute, times in animated(tables) if layers else ():
        layer, offset = _source(attribute, times[0], clips)
        if layer in layers and not _is_undone(attribute.GetPrim(), layer, offset.scale, own):
            start = offset.offset
            meant = [start + (time - start) / own for time in times]
            displaced = _displaced(attribute, list(zip(times, meant, strict=True)), time_range)
            if displaced and not _is_meant(layer, offset, times, own, time_range):
                found[layer][attribute.GetPrim()].append(displaced)
    return tuple(
        UnsaidRate(layer, rate, own, tuple(_in_order(by_prim)))
        for layer, by_prim in sorted(found.items(), key=lambda item: item[0].identifier)
    )


def _in_order(by_prim: Mapping[Any, Iterable[Displaced]]) -> Iterator[Displaced]:
    for prim in as_shown(by_prim):
        yield from sorted(by_prim[prim], key=lambda displaced: str(displaced.attribute.GetName()))


def _without_rate(stage: Any) -> frozenset[Any]:
    return frozenset(
        layer
        for layer in stage.GetUsedLayers(includeClipLayers=False)
        if not layer.HasTimeCodesPerSecond() and not layer.HasFramesPerSecond()
    )


def _source(attribute: Any, time: float, clips: Clips) -> tuple[Any | None, Any]:
    """The layer whose times are meant by the samples, and the offset from them to the stage's.

    Those of value clips are in the times of the layer that names the clips, whatever these say.
    """
    if not is_from_clips(attribute, time):
        opinion = strongest_opinion(attribute, time)
        return (opinion.spec.layer, opinion.offset) if opinion else (None, None)
    for clip_set in clips.reaching(attribute.GetPrim()):
        spec, offset = clip_set.opinion_with(clip_set.key if clip_set.template else "times")
        return spec.layer, offset
    return None, None


def _is_undone(prim: Any, layer: Any, scale: float, own: float) -> bool:
    """Whether the scales that arcs author undo that which USD adds by itself.

    `scale` is all of them together.  A slow motion may come on top, with the same arc or another:
    then the whole is an even multiple or fraction, and what was authored is none.
    """
    if _is_close(scale, 1) or (_is_even(scale) and not _is_even(scale / own)):
        return True
    return any(_is_close(arc, 1) for arc in _corrected_scales(prim, layer, own))


def _corrected_scales(prim: Any, layer: Any, own: float) -> Iterator[float]:
    """For each arc that brings a layer to a prim, its authored scale times one that USD adds.

    USD adds a scale at arcs between layers of different rates; one of the others may undo it too.
    """
    for node in nodes_of(index_of(prim)):
        if layer in node.layerStack.layers:
            while node.parent:
                scale = node.mapToParent.timeOffset.scale
                yield scale * own if _rate(node.parent) == _rate(node) else scale
                node = node.parent


def _rate(node: Any) -> float:
    """The rate of the layers of a node."""
    return float(node.layerStack.identifier.rootLayer.timeCodesPerSecond)


def _displaced(
    attribute: Any, times: Sequence[tuple[float, float]], time_range: tuple[float, float] | None
) -> Displaced | None:
    """The samples that are not on frames, or not in the range, though they are meant to be.

    `times`: where each is, and where it would be without the scale that USD adds.
    """
    between = tuple(time for time, meant in times if not _is_frame(time) and _is_frame(meant))
    if between:
        return Displaced(attribute, between, True, len(times))
    if time_range is None:
        return None
    start, end = time_range
    beyond = tuple(
        time for time, meant in times if not start <= time <= end and start <= meant <= end
    )
    if len(beyond) > 1 and len(beyond) * _FEW >= len(times):
        return Displaced(attribute, beyond, False, len(times))
    return None


def _is_meant(
    layer: Any,
    offset: Any,
    times: Sequence[float],
    own: float,
    time_range: tuple[float, float] | None,
) -> bool:
    """Whether the layer's range, or that of the samples, is the stage's for being scaled by USD."""
    ends = times[0], times[-1]
    if layer.HasStartTimeCode() and layer.HasEndTimeCode():
        ends = offset * layer.startTimeCode, offset * layer.endTimeCode
    unscaled = [offset.offset + (end - offset.offset) / own for end in ends]
    return _are_within(own, ends, time_range) and not _are_within(own, unscaled, time_range)


def _are_within(most: float, times: Iterable[float], others: tuple[float, float] | None) -> bool:
    """Whether times differ from others by less than `most`."""
    return bool(others) and all(
        abs(one - other) < most for one, other in zip(times, others or (), strict=True)
    )


def _is_frame(time: float) -> bool:
    return _is_close(time, round(time))


def _is_even(scale: float) -> bool:
    return scale > 0 and _is_frame(max(scale, 1 / scale))


def _is_close(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-6)
