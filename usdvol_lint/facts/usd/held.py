"""What a layer of value clips holds of an attribute in another way than as time samples."""

from __future__ import annotations

from typing import Any

from usdvol_lint import schema
from usdvol_lint.spelling import is_certainly_misspelt


def has_default(layer: Any, path: Any) -> bool:
    """Whether a layer has a default of an attribute, which USD does not take from a clip."""
    spec = layer.GetAttributeAtPath(path)
    return bool(spec and spec.HasInfo("default"))


def misspelt_in(layer: Any, path: Any) -> str:
    """The name that a layer has in the place of one at a path, by a slip of the hand; or ""."""
    prim = layer.GetPrimAtPath(path.GetPrimPath())
    names = (str(spec.name) for spec in (prim.attributes if prim else ()))
    unknown = (name for name in names if name not in schema.DECLARED_BY)
    return next((name for name in unknown if is_certainly_misspelt(name, path.name)), "")
