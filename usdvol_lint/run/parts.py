"""What is absent in one stage of a run, and there in another that composes it, is no finding."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import TypeAlias

from usdvol_lint.model import Finding, Lack, StageReport
from usdvol_lint.paths import real

_Layers: TypeAlias = frozenset[str]


def completed_by(stages: Sequence[StageReport]) -> Callable[[StageReport, Finding], bool]:
    """Whether a finding on one of the stages is about what other stages of them complete.

    A stage completes another one if it composes its root layer, and brings to a spec of that stage
    what this lacks.  Whatever it leaves absent is a finding of its own.
    """
    parts = _Parts()
    lacking = [stage for stage in stages if any(each.absent for each in stage.findings)]
    completed = parts.completed(lacking, stages) if lacking else {}
    return lambda stage, finding: parts.has(finding, stage, completed)


class _Parts:
    """Compares real paths, each found once."""

    def __init__(self) -> None:
        self._real = cache(real)

    def completed(
        self, lacking: Sequence[StageReport], stages: Sequence[StageReport]
    ) -> Mapping[Lack, Sequence[_Layers]]:
        """What is lacking and completed, each with the layers of every stage that does so."""
        found = (finding for stage in lacking for finding in stage.findings)
        wanted = {lack for finding in found for part in self._absent(finding) for lack in part}
        completed: dict[Lack, list[_Layers]] = defaultdict(list)
        for stage in stages:
            brought = wanted.intersection(self._completes(stage))
            if stage.completes and brought:
                layers = frozenset(map(self._real, stage.completes.layers))
                for lack in brought:
                    completed[lack].append(layers)
        return completed

    def has(
        self,
        finding: Finding,
        stage: StageReport,
        completed: Mapping[Lack, Sequence[_Layers]],
    ) -> bool:
        """Whether all that a finding calls absent is completed by stages that have its stage."""
        root = self._real(stage.path)
        return bool(finding.absent) and all(
            any(root in layers for lack in part for layers in completed.get(lack, ()))
            for part in self._absent(finding)
        )

    def _absent(self, finding: Finding) -> Iterator[frozenset[Lack]]:
        for part in finding.absent:
            yield frozenset((self._real(layer), path, what) for layer, path, what in part)

    def _completes(self, stage: StageReport) -> Iterator[Lack]:
        for spec in stage.completes.specs if stage.completes else ():
            for layer in map(self._real, spec.layers):
                yield from ((layer, spec.path, what) for what in spec.lacking)
