"""The values of an asset attribute, and those of them that a finding is about."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.files.paths import anchored, extension_of
from usdvol_lint.facts.files.patterns import as_expression, has_frame
from usdvol_lint.facts.files.states import ON_DISK_OR_PATTERN, AssetState
from usdvol_lint.facts.usd.calls import holder_of
from usdvol_lint.facts.usd.opinions import by_opinion, is_from_clips, strongest_opinion
from usdvol_lint.facts.usd.values import Occurrences
from usdvol_lint.words import frame_ranges, quoted

_LAYERS_NAMED = 3
_NOTHING = frozenset({AssetState.EMPTY, AssetState.BLOCKED})
_PATH_OF = attrgetter("path")


class AssetSample(NamedTuple):
    """One value of an asset attribute.

    `time` is a time code of the stage, None for the default.
    `authored` is the text in the layer; where that is an expression, `path` is what it evaluates
    to, elsewhere the same text.
    `resolved` is the file that USD finds, without file format arguments; empty if it finds none.
    `detail` depends on the state: the fault, the error, the variable, the scheme or the pattern.
    `led_to` is the absolute path that the configuration leads to, whether or not a file is there.
    """

    time: float | None
    authored: str
    path: str
    resolved: str
    state: AssetState
    detail: str = ""
    led_to: str = ""

    @property
    def is_arranged(self) -> bool:
        """Whether the configuration says where it is, whatever the path is on this machine."""
        return self.state is AssetState.ASSUMED or bool(self.led_to)

    @property
    def is_there(self) -> bool:
        """Whether it names a readable file with content."""
        return self.state is AssetState.FILE

    @property
    def extension(self) -> str:
        """The extension of the file in lower case with its dot, or empty.

        Readers are chosen by what the resolver answers, which may end in another one than the path.
        """
        return extension_of(self.resolved or self.path)


class AssetSamples(NamedTuple):
    """All samples of one asset attribute in ascending time, the default first.

    `states` are the states that occur: most rules see from them that there is nothing to find.
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
        """The samples that name files, there or not, whose paths match from their start."""
        # Most match nowhere, which `any` and `map` find without a loop in Python.
        if not any(map(pattern.match, map(_PATH_OF, self.samples))):
            return None
        return self.affected(
            sample
            for sample in self.samples
            if sample.state in ON_DISK_OR_PATTERN and pattern.match(sample.path)
        )

    def affected(self, samples: Iterable[AssetSample]) -> Affected | None:
        """These samples as what a finding is about, or None if there are none."""
        found = tuple(samples)
        timed = sum(sample.time is not None for sample in self.samples) if found else 0
        return Affected(self.attribute, found, timed) if found else None

    def anchored(self, sample: AssetSample) -> str:
        """The absolute path of a sample, whether or not anything is there."""
        return _place_of(self.attribute, sample)

    def by_detail(self, *states: AssetState) -> Iterator[Affected]:
        """The samples in one of these states, grouped by their detail."""
        affected = self.of(*states)
        if affected:
            groups: dict[str, list[AssetSample]] = defaultdict(list)
            for sample in affected.samples:
                groups[sample.detail].append(sample)
            for group in groups.values():
                yield from replace(affected, samples=tuple(group)).by_opinion

    @property
    def names_a_path(self) -> bool:
        """Whether any value is neither empty nor blocked, of the time samples where there are some.

        These hide the default at all times but the default time.
        """
        if self.states.isdisjoint(_NOTHING):
            return bool(self.states)
        counted = self.samples if self.hidden_default is None else self.samples[1:]
        return any(sample.state not in _NOTHING for sample in counted)

    @property
    def hidden_default(self) -> AssetSample | None:
        """The default where there are time samples beside it."""
        samples = self.samples
        return samples[0] if len(samples) > 1 and samples[0].time is None else None

    @property
    def is_only_declared(self) -> bool:
        """Whether the stage's own layer makes the field and declares it, and none gives it a value.

        Such a layer may be a part that another stage completes; one on top of others is no part.
        """
        root, specs = self.attribute.GetStage().GetRootLayer(), self.attribute.GetPropertyStack()
        return not self.samples and any(
            spec.layer == root and holder_of(spec).specifier == Sdf.SpecifierDef for spec in specs
        )


@dataclass(frozen=True)
class Affected(Occurrences):
    """The samples that a finding is about, and what its message says of them."""

    samples: tuple[AssetSample, ...]

    @property
    def first(self) -> AssetSample:
        return self.samples[0]

    @property
    def by_opinion(self) -> Iterator[Affected]:
        """These samples, or the default and the others where two specs hold them."""
        return by_opinion(self)

    @property
    def has_missing(self) -> bool:
        """Whether nothing is at one of the paths."""
        return any(sample.state is AssetState.MISSING for sample in self.samples)

    @property
    def asset(self) -> str:
        """The first path as authored, which the line of the finding points to."""
        return self.first.authored

    @property
    def shown(self) -> str:
        """The first path in quotes, with the expression that it was evaluated from."""
        first = self.first
        origin = "" if first.authored == first.path else f" (from {quoted(first.authored)})"
        return f"{quoted(first.path)}{origin}"

    @property
    def nothing_there(self) -> tuple[str, str]:
        """That nothing is at the paths, and the count, in words before the reason and after it."""
        is_all = bool(self.total) and len(self.times) == self.total
        files = len({sample.path for sample in self.samples})
        if not is_all or files == 1:
            return f"no file at {self.shown}", self.count
        more = ", ".join(self._more(self.times))
        what = f"none of the {files} files is there, the first is {self.shown}"
        return what, f" ({more})" if more else ""

    @property
    def as_expression(self) -> str | None:
        """The first path as an expression with the environment variables that it has; or None."""
        return as_expression(self.first.path)

    @property
    def has_frame(self) -> bool:
        """Whether the first path has a placeholder for a frame."""
        return has_frame(self.first.path)

    @property
    def below_layer(self) -> str | None:
        """The first path relative to the folder of its layer, if it lies below that; else None."""
        strongest = strongest_opinion(self.attribute, self.first.time)
        folder = os.path.dirname(strongest.spec.layer.realPath) if strongest else ""
        below = self.first.path.removeprefix(f"{folder}/")
        return f"./{below}" if folder and below != self.first.path else None

    def _more(self, times: Sequence[float]) -> Iterator[str]:
        """The frames as authored if a layer offset moves them, and the layers if several."""
        authored = self._authored(times)
        if authored != times:
            frames = "frame" if len(authored) == 1 else "frames"
            yield f"authored as {frames} {frame_ranges(authored)}"
        layers = self._layers(times)
        if len(layers) > 1:
            more = f" and {len(layers) - _LAYERS_NAMED} more" if len(layers) > _LAYERS_NAMED else ""
            yield f"in {len(layers)} layers: {', '.join(layers[:_LAYERS_NAMED])}{more}"

    def _authored(self, times: Sequence[float]) -> Sequence[float]:
        """The stage times in the time of the layer that holds the first sample."""
        strongest = strongest_opinion(self.attribute, times[0])
        if strongest is None or strongest.offset.IsIdentity():
            return times
        inverse = strongest.offset.GetInverse()
        return tuple(sorted(inverse * time for time in times))

    def _layers(self, times: Sequence[float]) -> list[str]:
        """The names of the layers that hold the samples; only clips spread them over several."""
        from_clips = is_from_clips(self.attribute, times[0])
        samples = self.samples if from_clips else (self.samples[0], self.samples[-1])
        opinions = (strongest_opinion(self.attribute, sample.time) for sample in samples)
        names = (each.spec.layer.GetDisplayName() for each in opinions if each)
        return list(dict.fromkeys(names))

    @cached_property
    def place(self) -> str:
        """The absolute path of the first sample, whether or not anything is there."""
        return _place_of(self.attribute, self.first)


def _place_of(attribute: Any, sample: AssetSample) -> str:
    return sample.led_to or anchored(attribute, sample.time, sample.path)
