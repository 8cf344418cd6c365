"""Whether fields are seen at certain times."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import Any

from pxr import UsdGeom

from usdvol_lint.facts.usd.instances import shown_paths


def is_hidden(
    field: Any, volumes: Sequence[Any], times: Sequence[float], between: bool = False
) -> bool:
    """Whether a field, or each of the Volumes that bind it, is invisible at all these times.

    `between`: also from the first to the last of them.
    """
    is_used_hidden = bool(volumes) and _are_invisible(volumes, times, between)
    return is_used_hidden or _are_invisible([field], times, between)


def _are_invisible(prims: Iterable[Any], times: Sequence[float], between: bool) -> bool:
    """Whether all of these prims are, wherever on the stage they appear."""
    return all(
        imageable.ComputeVisibility(time) == UsdGeom.Tokens.invisible
        for prim in prims
        for path in shown_paths(prim)
        for imageable in [UsdGeom.Imageable(prim.GetStage().GetPrimAtPath(path))]
        for time in (chain(times, _changes(imageable.GetPrim(), times)) if between else times)
    )


def _changes(prim: Any, times: Sequence[float]) -> Iterator[float]:
    """The times from the first to the last at which a prim may become visible."""
    while prim and not prim.IsPseudoRoot():
        if attribute := prim.GetAttribute("visibility"):
            changes = attribute.GetTimeSamples()
            yield from (time for time in changes if times[0] <= time <= times[-1])
        prim = prim.GetParent()
