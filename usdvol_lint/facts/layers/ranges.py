"""The time range of a stage, and which arc brings values into it that do not suit it."""

from __future__ import annotations

from typing import Any, NamedTuple

from usdvol_lint.facts.usd.opinions import strongest_opinion

_KEYS = ("startTimeCode", "endTimeCode")
_ROUNDING = 1e-6


class TimeRange(NamedTuple):
    """The first and the last time code of a stage."""

    start: float
    end: float

    def meeting(self, attribute: Any, time: float | None) -> Any | None:
        """The spec that brings values of an attribute into this range; None if they lie in one.

        It is that with the first arc to a layer which says the range, or this layer's own top if
        the arc, or the values, are in a sublayer of it.  What is between, with another range or
        none, has nothing to do with it.
        """
        from usdvol_lint.facts.usd.bringing import arc_that  # costs start-up time; few need it

        strongest = strongest_opinion(attribute, time)
        if strongest is None:
            return None
        said_by: list[Any] = []

        def is_it(arc: Any) -> bool:
            is_said = self._is_said_by(arc.source)
            said_by.extend([arc.source.layerStack.identifier.rootLayer] if is_said else [])
            return is_said

        spec = arc_that(attribute.GetPrim(), strongest.spec.layer, is_it) or strongest.spec
        top = said_by[0] if said_by else attribute.GetStage().GetRootLayer()
        if spec.layer != top:
            return top.pseudoRoot
        return None if spec == strongest.spec else spec

    def _is_said_by(self, node: Any) -> bool:
        """Whether the layers of a node say this range; what only the stage says, its root does."""
        info = node.layerStack.identifier.rootLayer.pseudoRoot
        if not all(map(info.HasInfo, _KEYS)):
            return bool(node.IsRootNode())
        said = [node.mapToRoot.timeOffset * info.GetInfo(key) for key in _KEYS]
        return all(abs(one - other) < _ROUNDING for one, other in zip(said, self, strict=True))
