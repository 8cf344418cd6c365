"""Which different files the fields of one Volume name at the same time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain
from typing import Any, NamedTuple

from usdvol_lint.facts.files.assets import AssetSample, AssetSamples
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.facts.volumes.bindings import FieldBindings
from usdvol_lint.words import quoted

_KNOWN = frozenset({AssetState.FILE, AssetState.UNVERIFIABLE})
_FILES_NAMED = 3


class MixedFiles(NamedTuple):
    """The times at which the fields of a Volume name several files.

    `fields` maps each file at the first such time to the names of the fields that name it;
    `opinions` are the properties that bind them, and that name the files.
    """

    fields: dict[str, tuple[str, ...]]
    times: tuple[float, ...]
    at_default: bool
    opinions: tuple[Any, ...] = ()

    @property
    def shown(self) -> str:
        """As in `'./cloud.vdb' (density, temperature) and './smoke.vdb' (velocity)`."""
        named = [f"{quoted(file)} ({', '.join(fields)})" for file, fields in self.fields.items()]
        if len(named) > _FILES_NAMED:
            named[_FILES_NAMED - 1 :] = [f"{len(named) - _FILES_NAMED + 1} more"]
        return f"{', '.join(named[:-1])} and {named[-1]}"


def find_mixed_files(
    bindings: FieldBindings, paths: Callable[[Any], AssetSamples], is_told: Callable[[Any], bool]
) -> MixedFiles | None:
    """Compares the files of the fields of a Volume at every time; None if they never differ.

    Paths to no file are ignored, and fields of which `is_told`: they are findings of other rules.
    """
    fields = [(binding, in_prototype(target.prim)) for binding, target in bindings.with_files()]
    if not _compare([(binding.name, paths(field)) for binding, field in fields]):
        return None  # nearly always, and quick
    kept = [(binding, paths(field)) for binding, field in fields if not is_told(field)]
    mixed = _compare([(binding.name, files) for binding, files in kept])
    opinions = chain.from_iterable((binding.property, files.attribute) for binding, files in kept)
    return mixed._replace(opinions=tuple(opinions)) if mixed else None


def _compare(fields: Sequence[tuple[str, AssetSamples]]) -> MixedFiles | None:
    """Compares the files of fields, given by name."""
    timelines = [[(sample.time, _file(sample)) for sample in paths.samples] for _, paths in fields]
    if all(timeline == timelines[0] for timeline in timelines):
        return None
    steps = [StepSamples((sample.time, sample) for sample in paths.samples) for _, paths in fields]
    times: list[Time] = [None, *sorted({time for samples in steps for time in samples.times})]
    mixed = [time for time in times if len({_file(own.at(time)) for own in steps} - {""}) > 1]
    if not mixed:
        return None
    named: dict[str, tuple[str, ...]] = {}
    shown: dict[str, str] = {}
    for (name, _), samples in zip(fields, steps, strict=True):
        sample = samples.at(mixed[0])
        if sample and (file := _file(sample)):
            path = shown.setdefault(file, sample.path)
            named[path] = (*named.get(path, ()), name)
    return MixedFiles(
        fields=named,
        times=tuple(time for time in mixed if time is not None),
        at_default=mixed[0] is None and len(times) > 1,
    )


def _file(sample: AssetSample | None) -> str:
    """The identity of the file at a sample; empty where the path leads to no file."""
    return sample.resolved or sample.path if sample and sample.state in _KNOWN else ""
