"""Holes in a sequence: samples that name nothing, between others that name files."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Any, NamedTuple

from usdvol_lint.facts.files.assets import Affected, AssetSample
from usdvol_lint.facts.files.numbering import find_numbering
from usdvol_lint.facts.files.paths import is_packaged, split_path
from usdvol_lint.facts.files.sequences import SampleSequence
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.usd.clips import ClipSet
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion
from usdvol_lint.words import format_time, quoted

_NOTHING = frozenset({AssetState.EMPTY, AssetState.BLOCKED})
_LONGEST_SLIP = 3
"""A hole of more frames than these is hardly a slip."""


class Holes(NamedTuple):
    """The samples of a sequence that name nothing between others that name files.

    `paths`: of the files that belong to the samples of a single short hole, as their numbers say,
    if all of them exist.
    `clip`: the authored path of the value clip that lacks them, and `spec` the one that names it.
    """

    affected: Affected
    paths: tuple[str, ...]
    clip: str | None
    spec: Any | None

    @property
    def advice(self) -> str | None:
        """The samples to author, in the time of their layer."""
        if not self.paths:
            return None
        there = "which is there" if len(self.paths) == 1 else "which are there"
        if self.clip:
            return f"author {', '.join(map(quoted, self.paths))}, {there}, in {quoted(self.clip)}"
        pairs = zip(self._layer_times(), self.paths, strict=True)
        samples = ", ".join(f"{format_time(time)}: @{path}@" for time, path in pairs)
        return f"author {samples}, {there}"

    def _layer_times(self) -> list[float]:
        opinion = strongest_opinion(self.affected.attribute, self.affected.times[0])
        inverse = opinion.offset.GetInverse() if opinion else 1
        return [inverse * time for time in self.affected.times]


class _Hole(NamedTuple):
    """Neighbouring samples that name nothing, with the samples before and after them."""

    before: AssetSample
    samples: tuple[AssetSample, ...]
    after: AssetSample


def find_holes(sequence: SampleSequence, clips: Iterable[ClipSet]) -> Holes | None:
    """The holes of a sequence; what is empty before the first file and after the last is none."""
    if sequence.paths.states.isdisjoint(_NOTHING):
        return None
    holes = list(_holes(sequence.samples))
    affected = sequence.paths.affected(sample for hole in holes for sample in hole.samples)
    if affected is None:
        return None
    is_short = len(holes) == 1 and _frames(holes[0], sequence.step) <= _LONGEST_SLIP
    clip_set, clip = _clip(affected, clips)
    return Holes(
        affected,
        _paths(sequence, holes[0]) if is_short else (),
        clip,
        clip_set.spec_with(clip_set.key) if clip_set else None,
    )


def _clip(affected: Affected, clips: Iterable[ClipSet]) -> tuple[ClipSet | None, str | None]:
    """The clip that counts at the first of the samples, where the value should come from one."""
    time = affected.times[0]
    if is_from_clips(affected.attribute, time):
        for clip_set in clips:
            if clip := clip_set.clip_at(time):
                return clip_set, clip
    return None, None


def _holes(samples: Iterable[AssetSample]) -> Iterator[_Hole]:
    before: AssetSample | None = None
    empty: tuple[AssetSample, ...] = ()
    for is_empty, members in groupby(samples, lambda sample: sample.state in _NOTHING):
        run = tuple(members)
        if is_empty:
            empty = run
        else:
            if before and empty:
                yield _Hole(before, empty, run[0])
            before, empty = run[-1], ()


def _frames(hole: _Hole, step: float) -> int:
    """For how many frames nothing is named: until the next file, whatever samples there are."""
    start, end = (sample.time or 0.0 for sample in (hole.samples[0], hole.after))
    frames = (end - start) / step if step else 0.0
    return max(len(hole.samples), round(frames)) if math.isfinite(frames) else sys.maxsize


def _paths(sequence: SampleSequence, hole: _Hole) -> tuple[str, ...]:
    """The paths of the files that belong into a hole, if the numbers say so and all exist.

    They do where they go on behind the hole as far as the time does.
    """
    filled = [sample for sample in sequence.samples if sample.state not in _NOTHING]
    numbering = find_numbering([sample.path for sample in filled])
    around = (hole.before, hole.after)
    if numbering is None or any(sample.state is not AssetState.FILE for sample in around):
        return ()
    first, last = (numbering.numbers[filled.index(sample)] for sample in around)
    start, end = (sample.time or 0.0 for sample in around)
    pace = (last - first) / (end - start)
    numbers = [first + pace * ((sample.time or 0.0) - start) for sample in hole.samples]
    paths = [numbering.renumbered(hole.before.path, number) for number in numbers]
    there = [path for path in paths if path and _exists(sequence, hole.before, path)]
    is_new = {hole.before.path, hole.after.path}.isdisjoint(there)
    return tuple(there) if is_new and len(there) == len(paths) else ()


def _exists(sequence: SampleSequence, sample: AssetSample, path: str) -> bool:
    """Whether there is a file at a path that is authored as that of a sample is."""
    folder, name = split_path(path)
    if folder != split_path(sample.path)[0] or is_packaged(sample.resolved):
        return sequence.exists(sample, path)
    # USD does not tell which clip a value comes from where a layer offset scales time (26.11).
    return os.path.isfile(os.path.join(os.path.dirname(sample.resolved), name))
