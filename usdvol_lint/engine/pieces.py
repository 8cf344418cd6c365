"""Pieces of layers that are brought without what they need: then the arc to them is to blame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from usdvol_lint.engine.alone import Alone
from usdvol_lint.facts.usd.bringing import Crossing, crossings, path_of_prim, root_layer
from usdvol_lint.facts.usd.calls import get_prim, get_prim_stack, get_stage, prim_at
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.nodes import nodes_of

if TYPE_CHECKING:
    from usdvol_lint.rule import NotChecked, Problem, Rule


class Pieces:
    """Finds the arcs that bring a piece of a layer: a prim without those above it.

    What stands above, such as a bound material or a transform, may be what a rule asks for.
    """

    def __init__(self, alone: Alone) -> None:
        self._alone = alone
        self._whole: dict[tuple[str, str, Any], bool] = {}
        self._own: frozenset[Any] | None = None

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._whole.clear()

    def arc(self, rule: Rule, problem: Problem | NotChecked, spec: Any, path: str) -> Any | None:
        """The spec with the arc to blame for a problem at a path of the stage, in place of `spec`.

        None if that is to blame itself: nearly always, since its layer is brought as a whole, or
        opened alone has the problem too.
        """
        if spec.layer in self._local(problem) or self._is_whole(problem, spec, path):
            return None
        node = _node_with(get_prim(problem.at), spec)
        arcs = crossings(node) if node else []
        if not any(map(_is_to_piece, arcs)):
            return None
        found = None
        for arc in reversed(arcs):
            place = arc.node.path.StripAllVariantSelections()
            if not self._alone.is_clean(rule, root_layer(arc.node), place, spec):
                break
            found = arc.spec or found
        return found

    def _local(self, problem: Problem | NotChecked) -> frozenset[Any]:
        """The root layer and its sublayers, which no arc brings."""
        if self._own is None:
            self._own = frozenset(get_stage(problem.at).GetLayerStack())
        return self._own

    def _is_whole(self, problem: Problem | NotChecked, spec: Any, path: str) -> bool:
        """Whether what stands above a spec in its layer stands above the problem too, to the top.

        It is the same for all that one arc brings, so that USD is hardly ever asked.
        """
        if path == "/" or spec.path == spec.path.absoluteRootPath:
            return True
        own = str(spec.path.GetPrimPath().StripAllVariantSelections()).split("/")
        names = path.split("/")
        top = len(names) - len(own) + 1
        if top < 1 or names[top + 1 :] != own[2:]:
            return False
        above = "/".join(names[: top + 1])
        key = above, own[1], spec.layer
        if key not in self._whole:
            prim = prim_at(get_stage(problem.at), above)
            stack = get_prim_stack(prim) if prim else ()
            self._whole[key] = spec.layer.GetPrimAtPath(f"/{own[1]}") in stack
        return self._whole[key]


def _node_with(prim: Any, spec: Any) -> Any | None:
    """The node of a prim that a spec is in, of it or of a prim above it."""
    path = path_of_prim(spec)
    for node in nodes_of(index_of(prim)):
        if node.path.HasPrefix(path) and spec.layer in node.layerStack.layers:
            return node
    return None


def _is_to_piece(arc: Crossing) -> bool:
    """Whether an arc leads to a prim that has others above it."""
    target = arc.node.GetPathAtIntroduction().StripAllVariantSelections()
    return bool(target.pathElementCount > 1)
