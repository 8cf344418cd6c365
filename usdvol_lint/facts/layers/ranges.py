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
        from usdvol_lint.facts.usd.bringing import (  # costs start-up time; few need it
            crossings,
            node_of,
            root_layer,
        )

        prim, own = _source(attribute, time)
        if own is None:
            return None
        spec, node = own, node_of(prim, own)
        if not self._is_said_by(node):
            for arc in reversed(list(crossings(node))):
                spec, node = arc.spec or spec, arc.source
                if self._is_said_by(node):
                    break
        top = root_layer(node)
        if spec.layer != top:
            return top.pseudoRoot
        return None if spec == own else spec

    def _is_said_by(self, node: Any) -> bool:
        """Whether the layers of a node say this range; what only the stage says, its root does."""
        info = node.layerStack.identifier.rootLayer.pseudoRoot
        if not all(map(info.HasInfo, _KEYS)):
            return bool(node.IsRootNode())
        said = [node.mapToRoot.timeOffset * info.GetInfo(key) for key in _KEYS]
        return all(abs(one - other) < _ROUNDING for one, other in zip(said, self, strict=True))


def _source(attribute: Any, time: float | None) -> tuple[Any, Any | None]:
    """The prim and its spec that values come from: of those in value clips that with the clips."""
    from usdvol_lint.facts.usd.bringing import node_of

    prim = attribute.GetPrim()
    strongest = strongest_opinion(attribute, time)
    if strongest is None or node_of(prim, strongest.spec):
        return prim, strongest and strongest.spec
    while not (prim.IsPseudoRoot() or prim.HasAuthoredMetadata("clips")):
        prim = prim.GetParent()
    return prim, next((spec for spec in prim.GetPrimStack() if spec.HasInfo("clips")), None)
