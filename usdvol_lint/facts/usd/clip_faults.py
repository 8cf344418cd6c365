"""What keeps USD from using a set of value clips; of most of it USD says nothing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from math import isfinite
from typing import Any, NamedTuple

from pxr import Sdf, Usd, Vt

from usdvol_lint.nearest import closest_match
from usdvol_lint.words import format_time, quoted

_TYPES: dict[str, tuple[type | tuple[type, ...], str]] = {
    "active": (Vt.Vec2dArray, "double2[]"),
    "assetPaths": (Sdf.AssetPathArray, "asset[]"),
    "times": (Vt.Vec2dArray, "double2[]"),
    "primPath": (str, "string"),
    "templateAssetPath": (str, "string"),
    "templateStartTime": (float, "double"),
    "templateEndTime": (float, "double"),
    "templateStride": (float, "double"),
    "templateActiveOffset": (float, "double"),
}
_TEMPLATE_KEYS = ("templateStartTime", "templateEndTime", "templateStride")

Keys = Mapping[str, Any]
"""What a clip set says, composed of all layers."""


class ClipFault(NamedTuple):
    """Why USD does not use a clip set.

    `key`: the entry that is to blame; `what`: words that follow the name of the set.
    `is_block`: whether it may be meant to switch off the clips of a weaker layer.
    """

    key: str
    what: str
    advice: str | None
    is_block: bool = False


def authored_sets(prim: Any) -> dict[str, Keys]:
    """The clip sets authored on a prim, by name."""
    clips = Usd.ClipsAPI(prim).GetClips() or {}
    return {name: keys for name, keys in clips.items() if isinstance(keys, dict)}


def used_sets(prim: Any) -> dict[str, Keys]:
    """The clip sets authored on a prim, by name, without those that `clipSets` leaves out."""
    sets = authored_sets(prim)
    # ClipsAPI.GetClipSets ends the process where the list is authored in a sublayer, and the prim's
    # metadata lack the sets that count because nothing leaves them out (26.11).
    chosen = [spec.GetInfo("clipSets") for spec in _stack(prim) if spec.HasInfo("clipSets")]
    return {name: sets[name] for name in sorted(sets) if _is_chosen(name, chosen)}


def _stack(prim: Any) -> Any:
    return prim.GetPrimStack() if prim.HasAuthoredMetadata("clipSets") else ()


def _is_chosen(name: str, lists: Iterable[Any]) -> bool:
    """Whether lists of clip sets, strongest first, leave a set in."""
    for each in lists:
        if each.isExplicit:
            return name in each.explicitItems
        if name in each.deletedItems:
            return False
        if name in each.GetAddedOrExplicitItems():
            return True
    return True


def misnamed_sets(prim: Any) -> Iterator[tuple[str, Keys, ClipFault]]:
    """The clip sets that an explicit list leaves out, where it names one that is not there."""
    chosen = next((spec for spec in _stack(prim) if spec.HasInfo("clipSets")), None)
    names = chosen.GetInfo("clipSets").explicitItems if chosen else ()
    sets = authored_sets(prim)
    strange = [name for name in names if name not in sets]
    if not strange:
        return
    for name in sorted(sets.keys() - set(names)):
        meant = closest_match(name, strange, cutoff=0.8)
        what = (
            f"is not in clipSets, which name {quoted(meant or strange[0])}, a set that is not there"
        )
        advice = f"name {quoted(name)} in clipSets"
        yield name, sets[name], ClipFault("clipSets", what, advice, is_block=not meant)


def keys_without_set(prim: Any) -> Keys:
    """What is written into `clips` itself, where dictionaries for sets belong."""
    clips = Usd.ClipsAPI(prim).GetClips() or {}
    return {key: clips[key] for key in clips if key in _TYPES and not isinstance(clips[key], dict)}


def find_fault(keys: Keys) -> ClipFault | None:
    """The first fault for which USD refuses a clip set, from what the set says alone."""
    return next(_faults(keys), None)


def _faults(keys: Keys) -> Iterator[ClipFault]:
    for key, (types, name) in _TYPES.items():
        if key in keys and not isinstance(keys[key], types):
            yield ClipFault(key, f"has {key} of another type than {name}", f"author it as '{name}'")
    yield from _prim_path_faults(keys)
    if "assetPaths" in keys:
        yield from _explicit_faults(keys)
    elif "templateAssetPath" in keys:
        yield from _template_faults(keys)
    else:
        yield ClipFault(
            "assetPaths", "has no assetPaths, which name its clips", "author assetPaths"
        )


def _prim_path_faults(keys: Keys) -> Iterator[ClipFault]:
    path = keys.get("primPath")
    if not path:
        advice = "author as primPath the path of the prim in the clips"
        yield ClipFault("primPath", "has no primPath", advice)
    elif not Sdf.Path.IsValidPathString(path):
        yield ClipFault("primPath", f"has the primPath {quoted(path)}, which is no path", None)
    elif not Sdf.Path(path).IsAbsolutePath():
        what = f"has the primPath {quoted(path)}, which is not absolute"
        yield ClipFault("primPath", what, None)
    elif not Sdf.Path(path).IsPrimPath():
        yield ClipFault("primPath", f"has the primPath {quoted(path)}, which is no prim's", None)


def _explicit_faults(keys: Keys) -> Iterator[ClipFault]:
    clips, active = keys["assetPaths"], keys.get("active")
    if not clips:
        yield ClipFault("assetPaths", "has empty assetPaths", "name the clips", is_block=True)
    if not all(clip.path for clip in clips):
        advice = "name the clip, or take the path out and count the indices in active anew"
        yield ClipFault("assetPaths", "has an empty path in assetPaths", advice)
    if active is None:
        what = "has no active, which says from which frame on each clip counts"
        yield ClipFault("active", what, "author active as pairs of a frame and a clip's index")
    elif not active:
        advice = "author it as pairs of a frame and a clip's index"
        yield ClipFault("active", "has an empty active", advice, is_block=True)
    else:
        yield from _active_faults([(time, _index(value)) for time, value in active], len(clips))
    yield from _times_faults(keys)


def _index(value: float) -> float:
    """The index that a number in active is, as USD takes it; what is not finite stays so."""
    return int(value) if isfinite(value) else value


def _active_faults(active: list[tuple[float, float]], count: int) -> Iterator[ClipFault]:
    outside = [index for _, index in active if not 0 <= index < count]
    if outside:
        counted = "1 clip" if count == 1 else f"{count} clips"
        what = f"has the index {outside[0]} in active, and {counted} in assetPaths"
        yield ClipFault("active", what, f"indices count from 0: the last clip has {count - 1}")
    if repeated := _repeated([time for time, _ in active], 1):
        what = f"has several clips in active that begin at frame {format_time(repeated[0])}"
        yield ClipFault("active", what, "keep one of them")


def _times_faults(keys: Keys) -> Iterator[ClipFault]:
    if repeated := _repeated([time for time, _ in keys.get("times", ())], 2):
        frame = format_time(repeated[0])
        what = f"has more than two entries in times for frame {frame}"
        yield ClipFault("times", what, "keep two of them: where one clip ends, and the next begins")


def _template_faults(keys: Keys) -> Iterator[ClipFault]:
    missing = [key for key in _TEMPLATE_KEYS if key not in keys]
    if missing:
        what = f"has a templateAssetPath, but no {' and no '.join(missing)}"
        yield ClipFault(missing[0], what, f"author {' and '.join(missing)}")
        return
    start, end, stride = (keys[key] for key in _TEMPLATE_KEYS)
    if stride <= 0:
        what = f"has the templateStride {format_time(stride)}, which must be above 0"
        yield ClipFault("templateStride", what, "author the frames from one clip to the next")
    if end < start:
        ends = f"templateEndTime {format_time(end)} before the templateStartTime"
        what = f"has the {ends} {format_time(start)}"
        yield ClipFault("templateEndTime", what, "author a templateEndTime that is not before it")
    offset = keys.get("templateActiveOffset", 0.0)
    if abs(offset) > stride:
        what = f"has the templateActiveOffset {format_time(offset)}, which exceeds templateStride"
        yield ClipFault("templateActiveOffset", what, "author one that does not exceed it")
    template = keys["templateAssetPath"]
    if not _is_template(template):
        advice = "name the clips like 'clip.001.usd', and the template 'clip.###.usd'"
        what = f"has the templateAssetPath {quoted(template)}, without '#' alone between two dots"
        yield ClipFault("templateAssetPath", what, advice)


def _is_template(path: str) -> bool:
    """Whether one part of the file's name between dots is all '#', or two that are neighbours."""
    parts = list(filter(None, path.rpartition("/")[2].split(".")))
    marks = [index for index, part in enumerate(parts) if not part.strip("#")]
    return len(marks) == 1 or (len(marks) == 2 and marks[1] - marks[0] == 1)


def _repeated(times: list[float], most: int) -> list[float]:
    """The times that occur more than `most` times."""
    return [time for time, count in Counter(times).items() if count > most]
