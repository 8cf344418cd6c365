"""What to write on a prim so that a layer's up axis or units are those of the stage."""

from __future__ import annotations

from typing import Any, NamedTuple

from pxr import Sdf, Usd, UsdGeom

from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.facts.usd.nodes import nodes_of

_TURNS = {
    ("X", "Y"): ("Z", 90),
    ("X", "Z"): ("Y", -90),
    ("Y", "X"): ("Z", -90),
    ("Y", "Z"): ("X", 90),
    ("Z", "X"): ("Y", 90),
    ("Z", "Y"): ("X", -90),
}
"""From one up axis to another: about which axis and by how much."""
_ORDER = "xformOpOrder"
_RESET = "!resetXformStack!"


class Remedy(NamedTuple):
    """A transform op on a prim of the stage, as statements.

    `name`: that of the op in the xformOpOrder; `order`: the statement of that.
    `is_in_instance`: whether only the layer that has the arc can say so.
    """

    path: str
    op: str
    name: str
    order: str
    is_in_instance: bool


def find_remedy(prim: Any, layer: Any, key: str, said: Any, wanted: Any, reset: Any) -> Remedy:
    """The op that takes a prim of a layer from the up axis or the units said to those wanted.

    It belongs to the prim whose reference or payload brings the layer, or to the first below that
    can have one; or to that which resets the transform stack, if it is further below.
    """
    stage = prim.GetStage()
    path = Sdf.Path(shown(prim).path)
    top = _introduced_at(prim, path, layer, key, said)
    if reset:
        top = max(top, Sdf.Path(shown(reset).path), key=lambda each: int(each.pathElementCount))
    below = (each for each in path.GetPrefixes() if each.HasPrefix(top))
    place = next(filter(UsdGeom.Xformable, map(stage.GetPrimAtPath, below)), prim)
    type_name, kind, value = _turn(said, wanted) if key == "upAxis" else _scale(said / wanted)
    ordered = list(place.GetAttribute(_ORDER).Get() or ()) if place.HasAttribute(_ORDER) else []
    name = f"xformOp:{kind}"
    if place.HasAttribute(name) and (
        name in ordered or place.GetAttribute(name).GetTypeName() != type_name
    ):
        name += ":unitsResolve"
    listed = ", ".join(f'"{each}"' for each in _with(name, ordered, place))
    order = f"uniform token[] {_ORDER} = [{listed}]"
    op = f"{type_name} {name} = {value}"
    return Remedy(str(place.GetPath()), op, name, order, place.IsInstanceProxy())


def _introduced_at(prim: Any, path: Any, layer: Any, key: str, said: Any) -> Any:
    """The path of the prim with the outermost arc to a layer that says this, or to this layer."""
    index = prim.GetPrimIndex()
    for node in nodes_of(index):
        root = node.layerStack.identifier.rootLayer.pseudoRoot
        says_so = root.HasInfo(key) and root.GetInfo(key) == said
        if not node.IsRootNode() and (says_so or layer in node.layerStack.layers):
            for _ in range(node.GetDepthBelowIntroduction()):
                path = path.GetParentPath()
            break
    return path


def _turn(said: str, wanted: str) -> tuple[str, str, str]:
    axis, degrees = _TURNS[said, wanted]
    return "float", f"rotate{axis}", str(degrees)


def _scale(factor: float) -> tuple[str, str, str]:
    return "float3", "scale", f"({', '.join([f'{factor:g}'] * 3)})"


def _with(name: str, ordered: list[str], place: Any) -> list[str]:
    """An order with an op: after what the stage says, and before what the layer does."""
    if not ordered:
        return [name]
    [opinion, *_] = place.GetAttribute(_ORDER).GetPropertyStack(Usd.TimeCode.Default())
    first = ordered.index(_RESET) + 1 if _RESET in ordered else 0
    is_of_stage = opinion.layer in place.GetStage().GetLayerStack()
    at = len(ordered) if is_of_stage else first
    return [*ordered[:at], name, *ordered[at:]]
