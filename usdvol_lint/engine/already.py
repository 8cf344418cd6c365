"""What was wrong already: an edit of one side of a contradiction that mends nothing of it."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, Any

from usdvol_lint.engine.alone import Alone
from usdvol_lint.engine.blame import Blame, Blaming
from usdvol_lint.facts.usd.bringing import root_layer
from usdvol_lint.facts.usd.calls import get_prim, get_stage
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.nodes import nodes_of

if TYPE_CHECKING:
    from usdvol_lint.rule import Problem, Rule


class Already:
    """Finds problems that a layer has by itself, of which a stronger layer only changes one side.

    So other positions, of which there are as many too few, are not to blame for that.
    """

    def __init__(self, alone: Alone) -> None:
        self._alone = alone
        self._blaming: dict[Any, Blaming] = defaultdict(Blaming)
        """By layer: each is a stage of its own, of which some is looked up once."""

    def blame(self, rule: Rule, problem: Problem, blame: Blame) -> Blame | None:
        """What is to blame in the layer of the other side; None where that is clean by itself."""
        stronger = blame.spec.layer if blame.spec else None
        for other in blame.beside:
            found = other.layer != stronger and self._in(rule, problem, stronger, other)
            # What it was blamed on there may be what the stronger layer says anew.
            if found and found.spec in blame.beside:
                return found
        if stronger != get_stage(problem.at).GetRootLayer() and any(
            other.layer != stronger for other in blame.beside
        ):
            # What contradicts it may say first what the layer of the stronger one says too.
            own = self._in(rule, problem, stronger, blame.spec)
            if own and own.spec and own.spec.layer == stronger:
                return own
        return None

    def _in(self, rule: Rule, problem: Problem, stronger: Any, other: Any) -> Blame | None:
        """What is to blame in the layer of another spec by itself, or in the one with the arc."""
        for node in nodes_of(index_of(get_prim(problem.at))):
            if other.layer not in node.layerStack.layers:
                continue
            is_sublayer = stronger in node.layerStack.layers
            layer = other.layer if is_sublayer else root_layer(node)
            place = node.path.StripAllVariantSelections()
            alike = self._alone.alike(rule, layer, place, problem)
            found = alike and self._blaming[layer].blame(alike)
            if found:
                offset = node.mapToRoot.timeOffset
                return found._replace(offset=offset * found.offset if found.offset else None)
        return None
