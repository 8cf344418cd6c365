"""Whether fields are seen at certain times."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from pxr import UsdGeom

from usdvol_lint.facts.usd.instances import shown_paths


def is_hidden(field: Any, volumes: Sequence[Any], times: Sequence[float]) -> bool:
    """Whether a field, or each of the Volumes that bind it, is invisible at all these times."""
    is_used_hidden = bool(volumes) and _are_invisible(volumes, times)
    return is_used_hidden or _are_invisible([field], times)


def _are_invisible(prims: Iterable[Any], times: Sequence[float]) -> bool:
    """Whether all of these prims are, wherever on the stage they appear."""
    return all(
        UsdGeom.Imageable(prim.GetStage().GetPrimAtPath(path)).ComputeVisibility(time)
        == UsdGeom.Tokens.invisible
        for prim in prims
        for path in shown_paths(prim)
        for time in times
    )
