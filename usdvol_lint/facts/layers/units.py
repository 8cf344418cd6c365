"""Layers whose up axis or units are not the stage's, and what they bring without a correction."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from pxr import UsdGeom

from usdvol_lint import schema
from usdvol_lint.facts.layers.remedies import Remedy, find_remedy
from usdvol_lint.facts.layers.turns import Corrections, resetting
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.bringing import meeting_spec
from usdvol_lint.facts.usd.instances import as_shown
from usdvol_lint.facts.usd.nodes import nodes_of

UP_AXIS = "upAxis"
UNITS = "metersPerUnit"
_AXES = ("X", "Y", "Z")
_PLACED_TYPES = frozenset(
    name for name in schema.CONCRETE_TYPES if "VolumeFieldBase" not in schema.TYPE_BASES[name]
)
_PLACED = frozenset({"extent", "filePath", *schema.attributes_of(schema.API_ATTRIBUTES)})
"""The attributes whose values have a place or a size."""


class UnlikeStage(NamedTuple):
    """A layer that says another up axis or other units than the stage.

    `key`: the name of that metadata, with the value in the `layer` and that of the `stage`.
    `is_sublayer`: whether no reference or payload brings it, but a sublayer of the stage or of a
    layer that agrees with the stage.
    `blamed`: the spec that brings it into a layer which says otherwise.
    `prims`: those of ours that this brings without a rotation or scale up to the root, one or more.
    """

    layer: Any
    key: str
    said: Any
    stage_says: Any
    is_sublayer: bool
    blamed: Any
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        """The first of the prims."""
        return self.prims[0]

    @property
    def resetting(self) -> Any | None:
        """The prim with `!resetXformStack!` up to which a rotation or scale of it would count."""
        return resetting(self.prim)

    @property
    def remedies(self) -> list[Remedy]:
        """The transform ops that would make up for it, each on another prim."""
        found = {}
        for prim in self.prims:
            remedy = find_remedy(
                prim, self.layer, self.key, self.said, self.stage_says, resetting(prim)
            )
            found[remedy.path] = remedy
        return list(found.values())


def layers_unlike_stage(stage: Any, tables: Tables) -> tuple[UnlikeStage, ...]:
    """The layers that say another up axis or other units, and bring what nothing corrects."""
    wanted = {key: stage.GetMetadata(key) for key in _said_by(stage)}
    layers = stage.GetUsedLayers() if wanted else ()
    unlike = {key: _unlike(layers, key, value) for key, value in wanted.items()}
    if not any(unlike.values()):
        return ()
    corrections = Corrections(stage)
    found: dict[tuple[Any, str, bool], list[Any]] = defaultdict(list)
    for key, layers_of_key in unlike.items():
        for prim, layer, is_sublayer in _uncorrected(
            stage, tables, corrections, key, layers_of_key
        ):
            found[layer, key, is_sublayer].append(prim)
    return tuple(
        UnlikeStage(
            layer, key, unlike[key][layer], wanted[key], is_sublayer, blamed, tuple(brought)
        )
        for (layer, key, is_sublayer), prims in sorted(found.items(), key=_order)
        for blamed, brought in _by_arc(as_shown(prims), layer, key, unlike[key][layer])
    )


def _uncorrected(
    stage: Any, tables: Tables, corrections: Corrections, key: str, unlike: Mapping[Any, Any]
) -> Iterator[tuple[Any, Any, bool]]:
    """The prims of ours that are brought by layers unlike the stage, and that nothing corrects.

    A Volume is corrected where its fields are.
    """
    left: list[Any] = []
    corrected: set[Any] = set()
    for prim in _ours(tables) if unlike else ():
        if corrections.reach(prim, key == UP_AXIS):
            _add_with_ancestors(prim.GetPath(), corrected)
        else:
            left.append(prim)
    for prim in left:
        if prim.GetPath() not in corrected:
            for layer, is_sublayer in _bringing(stage, prim, unlike, key):
                yield prim, layer, is_sublayer


def _by_arc(
    prims: Iterable[Any], layer: Any, key: str, said: Any
) -> Iterator[tuple[Any, list[Any]]]:
    """The specs to blame, each with the prims that it brings, in the order of the first of them."""
    found: dict[tuple[str, str], tuple[Any, list[Any]]] = {}
    for prim in prims:
        spec = _blamed(prim, layer, key, said)
        _, brought = found.setdefault((spec.layer.identifier, str(spec.path)), (spec, []))
        brought.append(prim)
    yield from found.values()


def _blamed(prim: Any, layer: Any, key: str, said: Any) -> Any:
    """The spec that brings a prim's layer into one which says otherwise."""

    def differs(other: Any) -> bool:
        theirs = _said(other, key)
        return theirs is not None and not _are_equal(key, said, theirs)

    return meeting_spec(prim, layer, differs)


def _add_with_ancestors(path: Any, paths: set[Any]) -> None:
    while path not in paths:
        paths.add(path)
        path = path.GetParentPath()


def _order(item: tuple[tuple[Any, str, bool], Any]) -> tuple[str, str, bool]:
    layer, key, is_sublayer = item[0]
    return layer.identifier, key, is_sublayer


def _said_by(stage: Any) -> list[str]:
    return [key for key in (UP_AXIS, UNITS) if stage.HasAuthoredMetadata(key)]


def _unlike(layers: Any, key: str, wanted: Any) -> dict[Any, Any]:
    """The layers that say something else than is wanted, with what they say."""
    said = {layer: _said(layer, key) for layer in layers}
    return {
        layer: value
        for layer, value in said.items()
        if value is not None and not _are_equal(key, value, wanted)
    }


def _said(layer: Any, key: str) -> Any | None:
    return layer.pseudoRoot.GetInfo(key) if layer.pseudoRoot.HasInfo(key) else None


def _are_equal(key: str, one: Any, other: Any) -> bool:
    if key == UNITS:
        return bool(one <= 0 or other <= 0 or UsdGeom.LinearUnitsAre(one, other))
    return bool(one == other or one not in _AXES or other not in _AXES)


def _ours(tables: Tables) -> Iterator[Any]:
    for prims, _ in tables.authored(*schema.OURS):
        yield from prims


def _bringing(
    stage: Any, prim: Any, unlike: Mapping[Any, Any], key: str
) -> Iterator[tuple[Any, bool]]:
    """The layers unlike the stage that say where a prim is or how large, and which are sublayers.

    What the root layer of a referenced layer stack says goes for its sublayers that say nothing.
    """
    own = stage.GetRootLayer()
    for node in nodes_of(prim.GetPrimIndex()):
        if node.isInert or not node.hasSpecs:
            continue
        top = node.layerStack.identifier.rootLayer
        for layer in node.layerStack.layers:
            if not _brings_a_place(layer.GetPrimAtPath(node.path)):
                continue
            if layer in unlike:
                yield layer, top == own or (layer != top and top not in unlike)
            elif top in unlike and _said(layer, key) is None:
                yield top, False


def _brings_a_place(spec: Any | None) -> bool:
    if not spec:
        return False
    return spec.typeName in _PLACED_TYPES or any(
        name in _PLACED or name.startswith("xformOp:")
        for name in spec.properties.keys()  # noqa: SIM118
    )
