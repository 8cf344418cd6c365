"""What is clean in its layer and wrong on the stage: an arc to a piece, or an edit, is why."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from usdvol_lint.engine.alone import Alone
from usdvol_lint.facts.usd.bringing import Crossing, crossings, path_of_prim, root_layer
from usdvol_lint.facts.usd.calls import get_prim, get_prim_stack, get_stage, prim_at
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.nodes import nodes_of

if TYPE_CHECKING:
    from usdvol_lint.rule import NotChecked, Problem, Rule


class Pieces:
    """Finds what makes something wrong of a layer that is clean by itself.

    That is an arc which brings a piece of it, a prim without those above: what stands there, such
    as a bound material or a transform, may be what a rule asks for.  Or it is what the stage's own
    layers say of the same prim, where the rule does not tell that it looks at that.
    """

    def __init__(self, alone: Alone) -> None:
        self._alone = alone
        self._whole: dict[tuple[str, str, Any], bool] = {}
        self._own: frozenset[Any] | None = None

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._whole.clear()

    def instead(
        self, rule: Rule, problem: Problem | NotChecked, spec: Any, path: str
    ) -> Any | None:
        """The spec to blame for a problem at a path of the stage, in place of `spec`.

        None if that is to blame itself: nearly always, since its layer is brought as a whole, or
        opened alone has the problem too.
        """
        local = self._local(problem)
        if spec.layer in local:
            return None
        prim = get_prim(problem.at)
        if self._is_whole(problem, spec, path):
            own = [each for each in get_prim_stack(prim) if each.layer in local and each.properties]
            return self._edit(rule, prim, spec, own) if own else None
        arcs = _arcs_to(prim, spec)
        if not any(map(_is_to_piece, arcs)):
            return None
        found = None
        for arc in reversed(arcs):
            place = arc.node.path.StripAllVariantSelections()
            if not self._alone.is_clean(rule, root_layer(arc.node), place, spec):
                break
            found = arc.spec or found
        return found

    def _edit(self, rule: Rule, prim: Any, spec: Any, own: Sequence[Any]) -> Any | None:
        """What the stage's own specs of a prim say, if nothing is wrong in the layer without it."""
        for arc in _arcs_to(prim, spec)[:1]:
            place = arc.node.path.StripAllVariantSelections()
            if self._alone.is_clean(rule, root_layer(arc.node), place, spec):
                properties = [each for spec in own for each in spec.properties]
                return properties[0] if len(properties) == 1 else own[0]
        return None

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


def _arcs_to(prim: Any, spec: Any) -> list[Crossing]:
    """The arcs from the root to a spec of a prim, or of one above it."""
    path = path_of_prim(spec)
    for node in nodes_of(index_of(prim)):
        if node.path.HasPrefix(path) and spec.layer in node.layerStack.layers:
            return crossings(node)
    return []


def _is_to_piece(arc: Crossing) -> bool:
    """Whether an arc leads to a prim that has others above it."""
    target = arc.node.GetPathAtIntroduction().StripAllVariantSelections()
    return bool(target.pathElementCount > 1)
