"""Defined prims that are not on the stage because a prim above them is only an `over`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_children, get_path, get_prim_stack
from usdvol_lint.facts.usd.instances import as_shown, in_prototype, shown
from usdvol_lint.facts.usd.nodes import nodes_of
from usdvol_lint.facts.usd.unselected import may_be_said
from usdvol_lint.nearest import is_one_slip_from

_PROTOTYPES = "prototypes"


class Undefined(NamedTuple):
    """An `over` that no layer defines, and the topmost prims of ours with a `def` below it.

    `similar` is the path of a defined sibling with nearly the same name; None if there is none.
    `copies` counts the prims of the stage that have the spec of this `over`.
    """

    over: Any
    prims: tuple[Any, ...]
    similar: str | None
    copies: int

    @property
    def spec(self) -> Any:
        """The spec of the `over` in the layer that defines the first of the prims below it."""
        below = self.prims[0].GetPath().MakeRelativePath(self.over.GetPath())
        return spec_above(self.over, below, defines)


def spec_above(over: Any, below: Any, says: Callable[[Any], bool] = bool) -> Any:
    """The weakest spec of an `over` in a layer that says something at a relative path below it."""
    stack: list[Any] = get_prim_stack(over)
    found = [(each, each.layer.GetObjectAtPath(each.path.AppendPath(below))) for each in stack]
    saying = [each for each, said in found if said and says(said)]
    return (saying or stack)[-1]


def find_undefined(
    stage: Any,
    undefined: Mapping[Any, Sequence[Any]],
    drawn: Callable[[], Iterable[Any]],
    may_lack: Callable[[Any], bool],
) -> Iterator[Undefined]:
    """The overs that take these prims off the stage, where that is probably a slip.

    An `over` without a defined prim above it is left out, unless a sibling has nearly its name:
    a layer of overs is meant to be composed below another one.
    So is a library: an `over` from below which an arc or a PointInstancer brings something onto
    the stage, and one whose prims are among those that are `drawn`, by another path.
    `may_lack` tells whether a layer that did not open may define a prim.
    """
    arcs = InnerArcs(stage)
    shared = _Shared(undefined.values(), drawn)
    faulty = _faulty(stage)
    by_spec: dict[Any, list[Any]] = defaultdict(list)
    for over in sorted(undefined, key=get_path):
        by_spec[get_prim_stack(over)[0]].append(over)
    for over, *copies in by_spec.values():
        similar = _similar_sibling(over)
        if not similar and over.GetParent().IsPseudoRoot():
            continue
        is_composed = not may_lack(over) and faulty.isdisjoint(over.GetPath().GetPrefixes())
        if not is_composed or may_be_said(over, defines):
            continue
        prims = undefined[over]
        if not arcs.lead_below(over) and not shared.draw_one_of(prims):
            yield Undefined(over, tuple(_topmost(prims)), similar, 1 + len(copies))


def _faulty(stage: Any) -> frozenset[Any]:
    """The paths of the prims with an arc that brought nothing, as the walk visits them."""
    prims = [stage.GetPrimAtPath(error.rootSite.path) for error in stage.GetCompositionErrors()]
    prims += [prim.GetPrototype() for prim in prims if prim and prim.IsInstance()]
    return frozenset(in_prototype(prim).GetPath() for prim in prims if prim)


def _similar_sibling(over: Any) -> str | None:
    """The path of a defined sibling whose name is one slip away; None where there are several."""
    siblings = [
        sibling
        for sibling in get_children(over.GetParent(), WITH_INSTANCES)
        if is_one_slip_from(over.GetName(), sibling.GetName())
    ]
    return shown(siblings[0]).path if len(siblings) == 1 else None


def defines(spec: Any) -> bool:
    """Whether a spec defines its prim."""
    return bool(spec.specifier != Sdf.SpecifierOver)


def _topmost(prims: Iterable[Any]) -> Iterator[Any]:
    """Those of the prims that are not below another of them, by the paths that show them."""
    last = Sdf.Path.emptyPath
    for prim in as_shown(prims):
        if last.isEmpty or not prim.GetPath().HasPrefix(last):
            last = prim.GetPath()
            yield prim


class _Shared:
    """What undefined prims have in common with those that are drawn."""

    def __init__(
        self, undefined: Iterable[Iterable[Any]], drawn: Callable[[], Iterable[Any]]
    ) -> None:
        self._undefined = undefined
        self._drawn = drawn

    def draw_one_of(self, prims: Iterable[Any]) -> bool:
        """Whether a spec of these undefined prims is also that of a prim which is drawn."""
        return any(not self._shared.isdisjoint(get_prim_stack(prim)) for prim in prims)

    @cached_property
    def _shared(self) -> frozenset[Any]:
        """The specs that undefined prims have in common with prims that are drawn."""
        undefined = chain.from_iterable(self._undefined)
        specs = frozenset(chain.from_iterable(map(get_prim_stack, undefined)))
        stacks = map(get_prim_stack, self._drawn())
        return frozenset(chain.from_iterable(map(specs.intersection, stacks)))


class InnerArcs:
    """Where the arcs inside of layers lead, selected or not; read only if there is a question."""

    def __init__(self, stage: Any) -> None:
        self._stage = stage

    def lead_below(self, over: Any) -> bool:
        """Whether an arc leads to an `over` or below it, by one of its paths."""
        nodes = nodes_of(over.ComputeExpandedPrimIndex())
        return not self._targets.isdisjoint(node.path.StripAllVariantSelections() for node in nodes)

    @cached_property
    def _targets(self) -> frozenset[Any]:
        """The paths that arcs lead to, and all above them."""
        targets: set[Any] = set()
        for layer in self._stage.GetUsedLayers():
            layer.Traverse(
                Sdf.Path.absoluteRootPath,
                lambda path, layer=layer: targets.update(_targets_at(layer, path)),
            )
        bare = (target.StripAllVariantSelections() for target in targets)
        return frozenset(prefix for target in bare for prefix in target.GetPrefixes())


def _targets_at(layer: Any, path: Any) -> Iterator[Any]:
    """The paths inside of the layer that arcs on this spec lead to."""
    if path.IsPropertyPath():
        if path.name == _PROTOTYPES and (relationship := layer.GetRelationshipAtPath(path)):
            yield from relationship.targetPathList.GetAddedOrExplicitItems()
        return
    is_of_prim = path.IsPrimPath() or path.IsPrimVariantSelectionPath()
    spec = layer.GetPrimAtPath(path) if is_of_prim else None
    if not spec:
        return
    for key in filter(spec.HasInfo, ("inheritPaths", "specializes")):
        yield from spec.GetInfo(key).GetAppliedItems()
    for key in filter(spec.HasInfo, ("references", "payload")):
        arcs = spec.GetInfo(key).GetAppliedItems()
        yield from (arc.primPath for arc in arcs if not arc.assetPath and arc.primPath)
