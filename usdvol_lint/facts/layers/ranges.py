"""The time range of a stage, and which arc brings values into it that do not suit it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from usdvol_lint.facts.usd.firsts import first_to_say
from usdvol_lint.words import from_to

_KEYS = ("startTimeCode", "endTimeCode")


def time_range(
    authored: tuple[float, float] | None, asked: tuple[float, float] | None
) -> TimeRange | None:
    """The range that was asked for, or that of the stage, if that is in ascending order."""
    if asked:
        return AskedRange(*asked)
    return TimeRange(*authored) if authored and authored[0] <= authored[1] else None


class TimeRange(NamedTuple):
    """The first and the last time code of a stage."""

    start: float
    end: float

    @property
    def is_asked(self) -> bool:
        """Whether it is that of the production, which no layer says."""
        return False

    @property
    def words(self) -> str:
        """What it is, and from where to where: `the stage's range is 1-48`."""
        whose = "the production's" if self.is_asked else "the stage's"
        return f"{whose} range is {from_to(*self)}"

    def beside(self, first: float, last: float) -> str:
        """What a message about samples that lie elsewhere says of both."""
        return f"are at {from_to(first, last)}, {self.words}"

    def meeting(
        self,
        attribute: Any,
        time: float | None,
        is_wrong: Callable[[TimeRange], bool],
    ) -> Any | None:
        """The spec that brings values of an attribute into this range; None if they lie in one.

        It is that with the first arc to a layer whose range is wrong for the values, or this
        layer's own top if the arc, or the values, are in a sublayer of it.  What is between, with a
        range that suits them or none, has nothing to do with it.
        `is_wrong` is asked of ranges in the time of the stage.
        """
        from usdvol_lint.facts.usd.bringing import (  # costs start-up time; few need it
            crossings,
            node_of,
        )

        prim, own, offset = _source(attribute, time)
        if own is None:
            return None
        said = _said_by(own.layer, offset)
        if said and is_wrong(said):
            return None
        spec, node = own, node_of(prim, own)
        if not _is_wrong_in(node, is_wrong):
            for arc in reversed(crossings(node)):
                spec, node = arc.spec or spec, arc.source
                if _is_wrong_in(node, is_wrong):
                    break
        saying = _saying(node, spec.layer, is_wrong)
        if saying != spec.layer:
            return saying.pseudoRoot
        return None if spec == own else spec

    def meeting_value(self, held: Any) -> Any | None:
        """The same for one value, an occurrence, that is held throughout, as in any range."""
        return self.meeting(held.attribute, held.first.time, lambda other: other.start < other.end)

    def meeting_samples(self, attribute: Any, first: float, last: float) -> Any | None:
        """The same for samples from one time to another, which leave this range, or part of it."""

        def are_far(other: TimeRange) -> bool:
            return last < other.start or first > other.end

        def leave_part(other: TimeRange) -> bool:
            return first > other.start or last < other.end

        return self.meeting(attribute, first, are_far if are_far(self) else leave_part)


class AskedRange(TimeRange):
    """The range of the production: what does not suit it is to blame itself."""

    @property
    def is_asked(self) -> bool:
        return True

    def meeting(
        self, attribute: Any, time: float | None, is_wrong: Callable[[TimeRange], bool]
    ) -> Any | None:
        return None


def _said_by(layer: Any, offset: Any) -> TimeRange | None:
    """The range that a layer says, in the time of the stage, to which `offset` leads."""
    info = layer.pseudoRoot
    if not all(map(info.HasInfo, _KEYS)):
        return None
    return TimeRange(*(offset * info.GetInfo(key) for key in _KEYS))


def _is_wrong_in(node: Any, is_wrong: Callable[[TimeRange], bool]) -> bool:
    """Whether the layers of a node say a wrong range; what only the stage says, its root does."""
    said = _said_by(node.layerStack.identifier.rootLayer, node.mapToRoot.timeOffset)
    return is_wrong(said) if said else bool(node.IsRootNode())


def _saying(node: Any, layer: Any, is_wrong: Callable[[TimeRange], bool]) -> Any:
    """The layer that says a wrong range first, of those of a node that lead to one of its layers.

    Those above it have it as sublayer, and merely say as much.
    """
    from usdvol_lint.facts.usd.bringing import root_layer, way_to

    found = root_layer(node)
    for tree in way_to(node, layer):
        said = _said_by(tree.layer, node.mapToRoot.timeOffset * tree.offset)
        found = tree.layer if said and is_wrong(said) else found
    return found


def _source(attribute: Any, time: float | None) -> tuple[Any, Any | None, Any]:
    """The prim, its spec that values come from, and the offset from that; of clips the same."""
    from usdvol_lint.facts.usd.bringing import node_of

    prim = attribute.GetPrim()
    first = first_to_say(attribute, time)
    if first is None or node_of(prim, first.spec):
        return (prim, *(first or (None, None)))
    while not (prim.IsPseudoRoot() or prim.HasAuthoredMetadata("clips")):
        prim = prim.GetParent()
    stack = prim.GetPrimStackWithLayerOffsets()
    return (prim, *next((each for each in stack if each[0].HasInfo("clips")), (None, None)))
