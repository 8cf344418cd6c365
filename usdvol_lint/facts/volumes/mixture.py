"""Which different files the fields of one Volume name at one time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from usdvol_lint.facts.files.assets import AssetSample, AssetSamples
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.model import quoted

_KNOWN = frozenset({AssetState.FILE, AssetState.UNVERIFIABLE})
_FILES_NAMED = 3


@dataclass(frozen=True, slots=True)
class MixedFiles:
    """The files that are named at the first time at which there are several, by their fields.

    `times` and `at_default` are all such times.
    """

    fields: dict[str, tuple[str, ...]]
    times: tuple[float, ...]
    at_default: bool

    @property
    def shown(self) -> str:
        """As in `'./cloud.vdb' (density, temperature) and './smoke.vdb' (velocity)`."""
        named = [f"{quoted(file)} ({', '.join(fields)})" for file, fields in self.fields.items()]
        if len(named) > _FILES_NAMED:
            named[_FILES_NAMED - 1 :] = [f"{len(named) - _FILES_NAMED + 1} more"]
        return f"{', '.join(named[:-1])} and {named[-1]}"


def find_mixed_files(fields: Sequence[tuple[str, AssetSamples]]) -> MixedFiles | None:
    """Compares what fields, each with its name, have for their file at every time.

    A path that leads nowhere is another matter, and not counted.
    """
    timelines = [[(sample.time, _file(sample)) for sample in each.samples] for _, each in fields]
    if all(timeline == timelines[0] for timeline in timelines):
        return None
    held = [StepSamples((sample.time, sample) for sample in each.samples) for _, each in fields]
    times: list[Time] = [None, *sorted({time for each in held for time in each.times})]
    mixed = [time for time in times if len({_file(each.at(time)) for each in held} - {""}) > 1]
    if not mixed:
        return None
    named: dict[str, tuple[str, ...]] = {}
    shown: dict[str, str] = {}
    for (name, _), each in zip(fields, held, strict=True):
        sample = each.at(mixed[0])
        if sample and (file := _file(sample)):
            path = shown.setdefault(file, sample.path)
            named[path] = (*named.get(path, ()), name)
    return MixedFiles(
        fields=named,
        times=tuple(time for time in mixed if time is not None),
        at_default=mixed[0] is None and len(times) > 1,
    )


def _file(sample: AssetSample | None) -> str:
    """What tells one file from another; empty where it is unknown."""
    return sample.resolved or sample.path if sample and sample.state in _KNOWN else ""
