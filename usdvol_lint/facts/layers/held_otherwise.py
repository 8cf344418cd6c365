"""Sound value clips that hold what prims need elsewhere, or in another way, than USD reads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.usd.clip_faults import ClipFault
from usdvol_lint.facts.usd.held import default_of, misspelt_in
from usdvol_lint.words import quoted


def bring_anything(prim: Any, prim_path: str, layers: Iterable[Any]) -> bool:
    """Whether clips have time samples of any attribute that a prim, or one below it, has."""
    stage, own = prim.GetStage(), prim.GetPath()
    return any(
        layer.GetNumTimeSamplesForPath(path)
        and stage.GetAttributeAtPath(path.ReplacePrefix(prim_path, own))
        for layer in layers
        for path in _attributes_below(layer.GetPrimAtPath(prim_path))
    )


def _attributes_below(spec: Any | None) -> Iterator[Any]:
    waiting = [spec] if spec else []
    while waiting:
        each = waiting.pop()
        yield from (attribute.path for attribute in each.attributes)
        waiting += each.nameChildren


def held_otherwise(attribute: Any, path: Any, layers: Sequence[Any]) -> ClipFault | None:
    """Why an attribute without samples gets nothing from clips that hold values meant for it.

    `path` is that of the attribute in the clips.
    """
    slips = filter(None, (misspelt_in(layer, path) for layer in layers))
    for slip in slips:
        if not attribute.GetPrim().HasAttribute(slip):
            what = f"has {quoted(slip)} in its clips, where {path.name} is wanted"
            return ClipFault("assetPaths", what, f"rename it in each clip: {quoted(path.name)}")
    defaults = list(filter(None, (default_of(layer, path) for layer in layers)))
    # Where all are alike, the clips may be layers with all that they are of, static values too.
    if defaults and (attribute.Get() is None or len(set(defaults)) > 1):
        what = "has only defaults in its clips, from which USD takes time samples alone"
        return ClipFault("assetPaths", what, "write them as time samples, in each clip")
    return None


def path_in_clips(attribute: Any, prim: Any, prim_path: str) -> Any:
    """The path in the clips of an attribute of the prim that bears them, or of one below it."""
    below: Sdf.Path = attribute.GetPath()
    return below.ReplacePrefix(prim.GetPath(), prim_path)
