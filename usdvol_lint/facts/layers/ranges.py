"""Which arc brings the values of an attribute into a stage whose time range does not suit them."""

from __future__ import annotations

from typing import Any

from usdvol_lint.facts.usd.bringing import Crossing, arc_that, root_layer
from usdvol_lint.facts.usd.opinions import strongest_opinion

_KEYS = ("startTimeCode", "endTimeCode")


def bringing_to_range(
    attribute: Any, time: float | None, time_range: tuple[float, float]
) -> Any | None:
    """The spec with the first arc to a layer of that range, or None if the values lie in one.

    What is between, with another range or none, has nothing to do with it.
    """
    strongest = strongest_opinion(attribute, time)
    if strongest is None:
        return None

    def is_it(crossing: Crossing) -> bool:
        info = root_layer(crossing.source).pseudoRoot
        if not all(map(info.HasInfo, _KEYS)):
            return bool(crossing.source.IsRootNode())
        offset = crossing.source.mapToRoot.timeOffset
        said = [offset * info.GetInfo(key) for key in _KEYS]
        return all(abs(one - other) < 1e-6 for one, other in zip(said, time_range, strict=True))

    return arc_that(attribute.GetPrim(), strongest.spec.layer, is_it)
