"""What a layer of value clips holds of an attribute in another way than as time samples."""

from __future__ import annotations

from typing import Any

from pxr import Sdf

from usdvol_lint.spelling import is_certainly_misspelt


def has_default(layer: Any, path: Any) -> bool:
    """Whether a layer has a default of an attribute, which USD does not take from a clip."""
    spec = layer.GetAttributeAtPath(path)
    return bool(spec and spec.HasInfo("default"))


def default_of(layer: Any, path: Any) -> str:
    """A text that stands for the default of an attribute in a layer; "" if it has none."""
    if not has_default(layer, path):
        return ""
    value = layer.GetAttributeAtPath(path).default
    return str(layer.ComputeAbsolutePath(value.path) if isinstance(value, Sdf.AssetPath) else value)


def misspelt_in(layer: Any, path: Any) -> str:
    """The name that a layer has in the place of one at a path, by a slip of the hand; or ""."""
    prim = layer.GetPrimAtPath(path.GetPrimPath())
    names = (str(spec.name) for spec in (prim.attributes if prim else ()))
    return next((name for name in names if is_certainly_misspelt(name, path.name)), "")


def attribute_paths(layer: Any, name: str) -> list[str]:
    """The paths of all attributes of this name in a layer."""
    found: list[str] = []

    def visit(path: Any) -> None:
        if path.IsPropertyPath() and path.name == name:
            found.append(str(path))

    layer.Traverse(Sdf.Path.absoluteRootPath, visit)
    return found
