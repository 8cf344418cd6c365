"""Fields that show one frame of a sequence on disk at all times."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.facts.files.assets import Affected, AssetSample, AssetSamples
from usdvol_lint.facts.files.families import Families, Family, Frames, read_family
from usdvol_lint.facts.files.library import is_library_item
from usdvol_lint.facts.files.named import in_layer, in_variants, numbers_in
from usdvol_lint.facts.files.places import place_of
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.usd.clips import ClipSet
from usdvol_lint.facts.usd.instances import on_stage, shown
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion
from usdvol_lint.words import format_time, quoted

_FEWEST = 5
"""A range of fewer frames than these proves nothing, however well the files fit."""
_MOST = 1000
_STAND_INS = frozenset({"proxy", "guide"})
"""The purposes of what stands in for the picture itself."""


class Still(NamedTuple):
    """A file that a field shows at all times, though it is one of a sequence.

    `is_sampled`: whether several time samples name it; `is_lost`: whether its name lacks the frame
    number; `is_certain`: whether the sequence leaves no doubt, if need be `by_range`, that it runs
    over the range of the stage; `beside`: another field of its Volume that plays the sequence.
    `numbers`: those of the files on disk; `advice`: the samples to author instead.
    """

    affected: Affected
    numbers: tuple[float, ...]
    is_sampled: bool
    is_lost: bool
    is_certain: bool
    by_range: bool
    beside: Any | None
    advice: str


class Packs:
    """Which files of one family several fields show, each its own: they are no frames.

    Where another field plays a family, they are, and one that is held may be meant to be.
    """

    def __init__(self, every: Iterable[AssetSamples]) -> None:
        self._shown: dict[Family, set[int]] = defaultdict(set)
        self._played: dict[Family, list[Any]] = defaultdict(list)
        for paths in every:
            timed = _timed(paths)
            if sample := _only_file(paths):
                if found := read_family(sample.resolved):
                    self._shown[found[1]].add(found[0].number)
            elif timed and (found := read_family(timed[0].resolved)):
                self._played[found[1]].append(paths.attribute.GetPrim())

    def are_played(self, frames: Frames) -> bool:
        """Whether another field shows one file of a family after the other."""
        return frames.family in self._played

    def played_beside(self, frames: Frames, field: Any) -> Any | None:
        """Another field of the same Volume that does so."""
        volume = _volume_above(field)
        played = self._played.get(frames.family, ()) if volume else ()
        return next((other for other in played if _volume_above(other) == volume), None)

    def are_shown(self, frames: Frames, field: Any) -> bool:
        """Whether other fields, of its layer too, or variants above it name others of a family."""
        others = self._shown[frames.family] | set(in_variants(field, frames.family))
        others.update(in_layer(field, frames.family))
        return bool(others - {frames.name.number})


def find_still(
    paths: AssetSamples,
    families: Families,
    packs: Callable[[], Packs],
    clips: Sequence[ClipSet],
    time_range: tuple[float, float] | None,
) -> Still | None:
    """The file of a sequence that is shown at all times, or None if there is none."""
    sample = _only_file(paths)
    if sample is None:
        return None
    if len(_timed(paths)) > 1:
        return _animated_in_name_only(paths, sample, families, packs)
    frames = families.around(sample, is_lost=False)
    if frames is None or time_range is None:
        return None
    if frames.on_disk.keys().isdisjoint((frames.name.number - 1, frames.name.number + 1)):
        return None
    if _is_one_of_a_kind(paths, frames, packs()):
        return None
    inverse = _to_layer(paths, sample)
    in_layer = (inverse * time_range[0], inverse * time_range[1])
    are_layer_times = _fills(frames, in_layer)
    beside = packs().played_beside(frames, paths.attribute.GetPrim())
    is_animated = bool(beside) or _is_animated_below(paths, frames, clips)
    is_filled = are_layer_times or _fills(frames, time_range)
    is_forgotten = is_filled and not _may_be_held(paths, frames, packs())
    low, high = in_layer if are_layer_times else time_range
    numbers = [number for number in sorted(frames.on_disk) if low <= number <= high]
    times = [float(n) if are_layer_times else inverse * n for n in numbers]
    return _still(
        paths,
        sample,
        frames,
        dict(zip(numbers, times, strict=True)),
        is_certain=is_animated or is_forgotten,
        by_range=not is_animated,
        beside=beside,
    )


def _animated_in_name_only(
    paths: AssetSamples, sample: AssetSample, families: Families, packs: Callable[[], Packs]
) -> Still | None:
    """Several samples that all name one file, where their times are the numbers of the others."""
    frames = families.around(sample, is_lost=False) or families.around(sample, is_lost=True)
    if frames is None:
        return None
    times = _times(paths)
    are_numbers = all(time in frames.on_disk for time in times)
    beside = (
        packs().played_beside(frames, paths.attribute.GetPrim()) if frames.name.digits else None
    )
    if not frames.name.digits:
        is_still = are_numbers or frames.name.has_dots
    else:
        is_still = (are_numbers or bool(beside)) and not _is_one_of_a_kind(paths, frames, packs())
    played = [n for n in sorted(frames.on_disk) if are_numbers and times[0] <= n <= times[-1]]
    # Samples that are there already stay at their times.
    at = {number: float(number) for number in played}
    return _still(paths, sample, frames, at, True, beside=beside) if is_still else None


def _volume_above(field: Any) -> Any | None:
    """The Volume that a field is below."""
    from pxr import UsdVol  # costs start-up time

    prim = on_stage(field).GetParent()
    while prim and not prim.IsA(UsdVol.Volume):
        prim = prim.GetParent()
    return prim or None


def _is_one_of_a_kind(paths: AssetSamples, frames: Frames, packs: Packs) -> bool:
    """Whether the file is one of a pack or of a library, each of which stands for itself."""
    field = paths.attribute.GetPrim()
    return packs.are_shown(frames, field) or is_library_item(field, frames.name)


def _still(
    paths: AssetSamples,
    sample: AssetSample,
    frames: Frames,
    times: Mapping[int, float],
    is_certain: bool,
    by_range: bool = False,
    beside: Any | None = None,
) -> Still | None:
    """What is said of it; `times` are those in the layer at which the numbers belong."""
    timed = _timed(paths)
    affected = paths.affected(timed or (sample,))
    if affected is None:
        return None
    return Still(
        affected,
        tuple(map(float, sorted(frames.on_disk))),
        len(timed) > 1,
        not frames.name.digits,
        is_certain,
        by_range,
        beside,
        _advice_beside(beside) if beside else _advice(paths, sample, frames, times),
    )


def _timed(paths: AssetSamples) -> tuple[AssetSample, ...]:
    return tuple(sample for sample in paths.samples if sample.time is not None)


def _only_file(paths: AssetSamples) -> AssetSample | None:
    """The one file that all time samples name, or the default where there are none."""
    timed = _timed(paths) or paths.samples
    if not timed or timed[0].state is not AssetState.FILE:
        return None
    return timed[0] if all(sample.path == timed[0].path for sample in timed) else None


def _times(paths: AssetSamples) -> list[float]:
    """The times of the samples in their layer; a clip's are those of the stage."""
    times = [sample.time or 0.0 for sample in _timed(paths)]
    opinion = strongest_opinion(paths.attribute, times[0])
    if opinion is None or is_from_clips(paths.attribute, times[0]):
        return times
    inverse = opinion.offset.GetInverse()
    return [round(inverse * time, 6) for time in times]


def _to_layer(paths: AssetSamples, sample: AssetSample) -> Any:
    """The offset from the time of the stage to that of the layer which names the file."""
    opinion = strongest_opinion(paths.attribute, sample.time)
    return opinion.offset.GetInverse() if opinion else Sdf.LayerOffset()


def _fills(frames: Frames, time_range: tuple[float, float]) -> bool:
    """Whether the numbers run without a gap over all of a range that is long enough."""
    start, end = map(round, time_range)
    is_plain = len(frames.name.digits) >= 4 or frames.name.has_dots
    is_long = end - start + 1 >= _FEWEST
    return is_plain and is_long and all(n in frames.on_disk for n in range(start, end + 1))


def _may_be_held(paths: AssetSamples, frames: Frames, packs: Packs) -> bool:
    """Whether one frame may do: for a proxy or guide, or beside a field that plays them all."""
    from pxr import UsdGeom  # costs start-up time

    purpose = UsdGeom.Imageable(paths.attribute.GetPrim()).ComputePurpose()
    return purpose in _STAND_INS or packs.are_played(frames)


def _is_animated_below(paths: AssetSamples, frames: Frames, clips: Sequence[ClipSet]) -> bool:
    """Whether weaker time samples or clips name two or more files of the sequence."""
    named: set[int] = set()
    for spec in paths.attribute.GetPropertyStack():
        for time in spec.layer.ListTimeSamplesForPath(spec.path):
            named |= numbers_in(spec, spec.layer.QueryTimeSample(spec.path, time), frames.family)
    in_clips = (len(each.clips) > 1 and each.layer_with_samples(paths.attribute) for each in clips)
    return len(named) > 1 or any(in_clips)


def _advice_beside(field: Any) -> str:
    return f"give it the filePath of <{shown(field).path}>, which plays the sequence"


def _advice(
    paths: AssetSamples, sample: AssetSample, frames: Frames, times: Mapping[int, float]
) -> str:
    """The time samples to author, in the time of the layer."""
    opinion = strongest_opinion(paths.attribute, sample.time)
    if len(times) < 2 or opinion is None or sample.authored != sample.path:
        return "author a time sample for each frame"
    if is_from_clips(paths.attribute, sample.time):
        return "name in each clip the file of its frame"
    before, _, after = sample.path.rpartition(place_of(sample.resolved).split[1])
    pairs = [
        f"{format_time(time)}: @{before}{frames.on_disk[number]}{after}@"
        for number, time in times.items()
    ]
    pairs[_MOST:] = ["…"] * (len(pairs) > _MOST)
    # Pasted into another layer they would be at other times.
    is_at_home = opinion.offset.IsIdentity()
    where = "" if is_at_home else f" in {quoted(opinion.spec.layer.GetDisplayName())}"
    return f"author filePath.timeSamples = {{ {', '.join(pairs)} }}{where}"
