"""Value clips that an arc leaves behind: its target lies below the prim that carries them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.calls import ARCS
from usdvol_lint.facts.usd.clips import Clips, is_from_clips
from usdvol_lint.facts.usd.instances import instances_of, prototype_of, shown
from usdvol_lint.facts.usd.nodes import nodes_of
from usdvol_lint.facts.usd.opinions import strongest_opinion


class LeftBehind(NamedTuple):
    """The clips of a prim in `layer` at `path`, which do not reach `attributes`, at least one.

    `prim` is that with the arc, which `spec` authors.
    """

    prim: Any
    spec: Any
    layer: Any
    path: Any
    attributes: tuple[Any, ...]

    @property
    def without_value(self) -> tuple[Any, ...]:
        """Those of the attributes that have no value at all."""
        return tuple(attribute for attribute in self.attributes if attribute.Get() is None)


class _Carrier(NamedTuple):
    """A prim in a layer that carries clips."""

    layer: Any
    path: Any


def find_left_behind(stage: Any, tables: Tables, clips: Clips) -> Iterator[LeftBehind]:
    """The clips of other layers that do not come along with what is below them."""
    carriers = _Carriers(stage)
    found: dict[tuple[Any, Any, _Carrier], list[Any]] = defaultdict(list)
    for table in tables.of(*schema.OURS):
        for prim, stack in zip(table.prims, table.batch.stacks, strict=True):
            for spec in stack:
                carrier = carriers.above(spec.layer, spec.path)
                if carrier and not _arrives(carrier, _reaching(prim, clips)):
                    attributes = carriers.lost(carrier, prim, spec)
                    if attributes:
                        found[(*_blamed(prim, spec), carrier)] += attributes
    for (prim, spec, carrier), lost in found.items():
        yield LeftBehind(prim, spec, *carrier, tuple(dict.fromkeys(lost)))


class _Carriers:
    """Finds the prims that carry clips in the layers of a stage, and what these hold."""

    def __init__(self, stage: Any) -> None:
        self._known: dict[tuple[Any, Any], _Carrier | None] = {}
        self._stages: dict[_Carrier, Any] = {}
        self._users = _users(stage.GetUsedLayers())

    def above(self, layer: Any, path: Any) -> _Carrier | None:
        """The nearest prim above with clips, in the layer or one that it is a sublayer of."""
        passed = []
        found = None
        while not found and not path.isEmpty and path != Sdf.Path.absoluteRootPath:
            path = path.GetParentPath()
            key = (layer, path)
            if key in self._known:
                found = self._known[key]
                break
            passed.append(key)
            found = self._carrier_at(layer, path)
        self._known.update(dict.fromkeys(passed, found))
        return found

    def _carrier_at(self, layer: Any, path: Any) -> _Carrier | None:
        for user in (layer, *self._users.get(layer, ())):
            spec = user.GetPrimAtPath(path)
            if spec and spec.HasInfo("clips"):
                return _Carrier(user, path)
        return None

    def lost(self, carrier: _Carrier, prim: Any, spec: Any) -> list[Any]:
        """The attributes of a prim that the clips hold, without samples or a stronger value."""
        root = _root_behind(prim, spec, carrier)
        if root is None:
            return []
        key = _Carrier(root, carrier.path.StripAllVariantSelections())
        if key not in self._stages:
            self._stages[key] = Usd.Stage.OpenMasked(root, Usd.StagePopulationMask([key.path]))
        source = self._stages[key].GetPrimAtPath(spec.path.StripAllVariantSelections())
        return [
            prim.GetAttribute(attribute.GetName())
            for attribute in (source.GetAttributes() if source else ())
            if is_from_clips(attribute)
            and prim.HasAttribute(attribute.GetName())
            and _is_without_own(prim.GetAttribute(attribute.GetName()), prim, spec)
        ]


def _users(layers: Iterable[Any]) -> dict[Any, list[Any]]:
    """The layers of which each is a sublayer, however deep."""
    direct: dict[Any, list[Any]] = defaultdict(list)
    for layer in layers:
        for path in layer.subLayerPaths:
            sublayer = Sdf.Layer.FindRelativeToLayer(layer, path)
            if sublayer:
                direct[sublayer].append(layer)
    every = {}
    for layer, first in direct.items():
        users = list(first)
        for user in users:  # grows while it is read
            users += [above for above in direct.get(user, []) if above not in users]
        every[layer] = users
    return every


def _root_behind(prim: Any, spec: Any, carrier: _Carrier) -> Any | None:
    """The root layer of those that a spec and a carrier are composed of; None if they differ."""
    on_stage = prim.GetStage().GetPrimAtPath(shown(prim).path)
    for node in nodes_of(on_stage.GetPrimIndex()):
        layers = node.layerStack.layers
        if node.path == spec.path and spec.layer in layers and carrier.layer in layers:
            return node.layerStack.identifier.rootLayer
    return None


def _is_without_own(attribute: Any, prim: Any, spec: Any) -> bool:
    """Whether an attribute has no samples, and no value stronger than the spec behind the arc."""
    if attribute.GetNumTimeSamples():
        return False
    opinion = strongest_opinion(attribute, None)
    if opinion is None:
        return True
    stack = prim.GetPrimStack()
    owner = opinion.spec.path.GetPrimOrPrimVariantSelectionPath()
    ranks = (
        rank
        for rank, each in enumerate(stack)
        if each.layer == opinion.spec.layer and each.path == owner
    )
    return bool(next(ranks, 0) >= stack.index(spec))


def _reaching(prim: Any, clips: Clips) -> Iterator[Any]:
    """The prims with clips that reach a prim, and all that are above an instance that it is in."""
    yield from clips.bearers(prim)
    while prim.IsInPrototype():
        prim = _first_instance(prototype_of(prim))
        while not prim.IsPseudoRoot() and not prim.IsPrototype():
            yield prim
            prim = prim.GetParent()


def _arrives(carrier: _Carrier, bearers: Iterable[Any]) -> bool:
    """Whether the clips are also on a prim of the stage that reaches what is below."""
    return any(_composes(bearer, carrier) for bearer in bearers)


def _composes(prim: Any, carrier: _Carrier) -> bool:
    return any(
        spec.layer == carrier.layer and spec.path == carrier.path for spec in prim.GetPrimStack()
    )


def _blamed(prim: Any, spec: Any) -> tuple[Any, Any]:
    """The prim with the arc, and the spec of that."""
    path = spec.path
    while path.GetParentPath() and not prim.GetParent().IsPseudoRoot():
        path = path.GetParentPath()
        parent = prim.GetParent()
        parent = _first_instance(parent) if parent.IsPrototype() else parent
        if not _composes(parent, _Carrier(spec.layer, path)):
            break
        prim = parent
        if prim.IsInstance():
            break
    return prim, _with_arc(prim)


def _first_instance(prototype: Any) -> Any:
    """A prototype has no specs; those of its instances are alike."""
    return min(instances_of(prototype), key=Usd.Prim.GetPath)


def _with_arc(prim: Any) -> Any:
    stack = prim.GetPrimStack()
    return next((spec for spec in stack if any(map(spec.HasInfo, ARCS))), stack[0])
