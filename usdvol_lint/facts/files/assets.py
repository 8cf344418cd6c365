"""The values of an asset attribute, classified, and those of them that a finding is about."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, NamedTuple

from usdvol_lint.facts.files.paths import anchored, extension_of
from usdvol_lint.facts.files.states import PLACES, AssetState
from usdvol_lint.facts.usd.opinions import is_from_clips, opinion
from usdvol_lint.facts.usd.values import Occurrences
from usdvol_lint.model import frame_ranges, quoted

_LAYERS_NAMED = 3
_PATH_OF = attrgetter("path")


class AssetSample(NamedTuple):
    """One value of an asset attribute.

    `time` is None for the default; `authored` is as written, an expression where it is one and
    `path` what it evaluates to; `resolved` is the file, without arguments for a file format;
    `detail` says more of the state: the fault, the error, the variable, the scheme, the pattern.
    """

    time: float | None
    authored: str
    path: str
    resolved: str
    state: AssetState
    detail: str = ""

    @property
    def is_there(self) -> bool:
        """Whether it is a readable file with content."""
        return self.state is AssetState.FILE

    @property
    def extension(self) -> str:
        """The extension of the path in lower case with its dot, or empty."""
        return extension_of(self.path)


class AssetSamples(NamedTuple):
    """All samples of one asset attribute in ascending time, the default first.

    `states` are those that occur: most rules find nothing, and need not look at each sample.
    """

    attribute: Any
    samples: tuple[AssetSample, ...]
    states: frozenset[AssetState]

    def of(self, *states: AssetState) -> Affected | None:
        """The samples in one of these states, or None if there are none."""
        if self.states.isdisjoint(states):
            return None
        return self.affected(sample for sample in self.samples if sample.state in states)

    def matching(self, pattern: re.Pattern[str]) -> Affected | None:
        """The samples that name a file, there or not, whose paths match from their start."""
        if not any(map(pattern.match, map(_PATH_OF, self.samples))):  # no loop of ours: most do not
            return None
        return self.affected(
            sample
            for sample in self.samples
            if sample.state in PLACES and pattern.match(sample.path)
        )

    def affected(self, samples: Iterable[AssetSample]) -> Affected | None:
        """Some of the samples, or None if there are none."""
        found = tuple(samples)
        timed = sum(sample.time is not None for sample in self.samples) if found else 0
        return Affected(self.attribute, found, timed) if found else None

    def anchored(self, sample: AssetSample) -> str:
        """The absolute path that a sample would have, did it exist."""
        return anchored(self.attribute, sample.time, sample.path)

    def by_detail(self, *states: AssetState) -> Iterator[Affected]:
        """The samples in one of these states, apart for each detail."""
        found = self.of(*states)
        if found:
            apart: dict[str, list[AssetSample]] = defaultdict(list)
            for sample in found.samples:
                apart[sample.detail].append(sample)
            yield from (replace(found, samples=tuple(samples)) for samples in apart.values())

    @property
    def names_a_path(self) -> bool:
        """Whether there is a value of some kind at some time."""
        return not self.states <= {AssetState.EMPTY, AssetState.BLOCKED}


@dataclass(frozen=True, slots=True)
class Affected(Occurrences):
    """Some of an attribute's samples, with what a finding says of them."""

    samples: tuple[AssetSample, ...]

    @property
    def first(self) -> AssetSample:
        return self.samples[0]

    @property
    def asset(self) -> str:
        return self.first.authored

    @property
    def shown(self) -> str:
        """The first path in quotes, with the expression that it was evaluated from."""
        first = self.first
        origin = "" if first.authored == first.path else f" (from {quoted(first.authored)})"
        return f"{quoted(first.path)}{origin}"

    def _more(self, times: Sequence[float]) -> Iterator[str]:
        """The frames as authored where they differ, and the layers where there are several."""
        authored = self._authored(times)
        if authored != times:
            frames = "frame" if len(authored) == 1 else "frames"
            yield f"authored as {frames} {frame_ranges(authored)}"
        layers = self._layers(times)
        if len(layers) > 1:
            more = f" and {len(layers) - _LAYERS_NAMED} more" if len(layers) > _LAYERS_NAMED else ""
            yield f"in {len(layers)} layers: {', '.join(layers[:_LAYERS_NAMED])}{more}"

    def _authored(self, times: Sequence[float]) -> Sequence[float]:
        """The times as the layer of the first sample has them, before its layer offset."""
        held = opinion(self.attribute, times[0])
        if held is None or held.offset.IsIdentity():
            return times
        inverse = held.offset.GetInverse()
        return tuple(sorted(inverse * time for time in times))

    def _layers(self, times: Sequence[float]) -> list[str]:
        """The names of the layers that hold the samples; only clips spread them over several."""
        from_clips = is_from_clips(self.attribute, times[0])
        asked = self.samples if from_clips else (self.samples[0], self.samples[-1])
        held = (opinion(self.attribute, sample.time) for sample in asked)
        return list(dict.fromkeys(found.spec.layer.GetDisplayName() for found in held if found))

    def anchored(self) -> str:
        """The absolute path that the first sample would have, did it exist."""
        return anchored(self.attribute, self.first.time, self.first.path)
