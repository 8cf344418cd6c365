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

    def arc_to_it(self, attribute: Any, time: float | None) -> Any | None:
        """The spec with the first arc that brings values to a layer which says this range.

        None if they lie in one.  What is between, with another range or none, has nothing to do
        with it.
        """
        from usdvol_lint.facts.usd.bringing import arc_that  # costs start-up time; few need it

        strongest = strongest_opinion(attribute, time)
        return strongest and arc_that(
            attribute.GetPrim(), strongest.spec.layer, lambda arc: self._is_said_by(arc.source)
        )

    def _is_said_by(self, node: Any) -> bool:
        """Whether the layers of a node say this range; what only the stage says, its root does."""
        info = node.layerStack.identifier.rootLayer.pseudoRoot
        if not all(map(info.HasInfo, _KEYS)):
            return bool(node.IsRootNode())
        said = [node.mapToRoot.timeOffset * info.GetInfo(key) for key in _KEYS]
        return all(abs(one - other) < _ROUNDING for one, other in zip(said, self, strict=True))
