"""Folds what stages show into causes: one for each thing to mend, with its first places."""

from __future__ import annotations

import re
from bisect import insort
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from operator import attrgetter
from typing import NamedTuple

from usdvol_lint.baseline.cover import join
from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.model import Completion, Cover, Finding, Severity, Source, StageReport
from usdvol_lint.paths import below, canonical
from usdvol_lint.results import Cause, Place, StageResult, State

MAX_PLACES = 20


class _Met(NamedTuple):
    """A place, and its number among those of its stage."""

    stage: int
    number: int
    finding: Finding


_ORDER = attrgetter("stage", "number")


class _Places:
    """Some places of a cause: the first ones, the number of all, and what they come to."""

    __slots__ = ("count", "cover", "first", "severity")

    def __init__(self) -> None:
        self.first: list[_Met] = []
        self.count = 0
        self.severity = Severity.INFO
        self.cover: Cover | None = None

    def add(self, met: _Met, most: int) -> None:
        self.count += 1
        self.severity = max(self.severity, met.finding.severity)
        cover = met.finding.cover
        if self.cover is None:
            self.cover = cover
        elif self.cover != cover:
            self.cover = join(self.cover, cover)
        if not self.first:
            self.first.append(met)
        elif len(self.first) < most or _ORDER(met) < _ORDER(self.first[-1]):
            insort(self.first, met, key=_ORDER)
            del self.first[most:]


class _Gathered:
    """What is known of one cause so far: the places that are left, and those suppressed."""

    __slots__ = ("left", "suppressed")

    def __init__(self) -> None:
        self.left: _Places | None = None
        self.suppressed: _Places | None = None

    @property
    def counting(self) -> _Places:
        counting = self.left or self.suppressed
        assert counting
        return counting


class Causes:
    """The causes of a run, whatever stages show them, in whichever order these are added.

    `root` is the folder that layers go by, `versions` a pattern for what is folded in their paths,
    and `reason_for` says why a finding on a stage is suppressed, or None.
    `verdict_on` gives another severity to all findings of a code with some source, or says why they
    are suppressed.
    """

    def __init__(
        self,
        root: str | None = None,
        versions: re.Pattern[str] | None = None,
        most: int = MAX_PLACES,
        reason_for: Callable[[str, Finding, Source], str | None] | None = None,
        verdict_on: Callable[[str, Source], Severity | str | None] | None = None,
    ) -> None:
        self._most = most
        self._reason_for = reason_for
        self._verdict_on = verdict_on
        self._found: dict[tuple[str, Source], _Gathered] = {}
        self._shown: dict[int, dict[tuple[str, Source], Severity | None]] = {}

        @cache
        def name_of(layer: str) -> str:
            name = below(layer, root)
            return versions.sub("*", name) if versions else name

        @cache
        def file_of(layer: str) -> str:
            return below(canonical(layer), root)

        self._name_of = name_of
        self._file_of = file_of

    def add(self, stage: int, path: str, findings: Iterable[tuple[int, Finding]]) -> None:
        """Adds findings of a stage, each with its number there."""
        shown = self._shown.setdefault(stage, {})
        for number, finding in findings:
            source = finding.source
            if source.layer is not None:
                source = Source(self._name_of(source.layer), *source[1:])
            key = finding.code, source
            gathered = self._found.get(key)
            if gathered is None:
                gathered = self._found[key] = _Gathered()
            finding = self._judged(path, finding, source)
            met = _Met(stage, number, finding)
            worst = shown.setdefault(key, None)
            if finding.ignored is None:
                gathered.left = gathered.left or _Places()
                gathered.left.add(met, self._most)
                shown[key] = max(worst or finding.severity, finding.severity)
            else:
                gathered.suppressed = gathered.suppressed or _Places()
                gathered.suppressed.add(met, self._most)

    def _judged(self, path: str, finding: Finding, source: Source) -> Finding:
        """A finding on a stage as the configuration takes it."""
        verdict = self._verdict_on(finding.code, source) if self._verdict_on else None
        if isinstance(verdict, Severity):
            finding = finding._replace(severity=verdict)
        if finding.ignored is not None:
            return finding
        reason = self._reason_for(path, finding, source) if self._reason_for else None
        if reason is None and isinstance(verdict, str):
            reason = verdict
        return finding if reason is None else finding._replace(ignored=reason)

    def result(self) -> tuple[tuple[Cause, ...], Mapping[tuple[str, Source], int]]:
        """The causes in the order of their first places, and the number of each."""
        keys = sorted(self._found, key=lambda key: _ORDER(self._found[key].counting.first[0]))
        causes = tuple(_cause(key, self._found[key]) for key in keys)
        return causes, {key: number for number, key in enumerate(keys)}

    def stage(
        self,
        number: int,
        report: StageReport,
        numbers: Mapping[tuple[str, Source], int],
        is_part: bool = False,
    ) -> StageResult:
        """What came of a stage, once all findings were added."""
        shown = self._shown.get(number, {})
        ordered = sorted((numbers[key], worst) for key, worst in shown.items())
        return StageResult(
            path=report.path,
            status=report.status,
            stats=report.stats,
            seconds=report.seconds,
            particle_fields=report.particle_fields,
            completes=report.completes and self._named(report.completes),
            causes=tuple(number for number, _ in ordered),
            worst=tuple(worst for _, worst in ordered),
            part=is_part,
        )

    def _named(self, completion: Completion) -> Completion:
        """The same with layers as fingerprints have them, of each version its own."""
        specs = (
            spec._replace(layers=tuple(map(self._file_of, spec.layers)))
            for spec in completion.specs
        )
        return Completion(
            tuple(sorted(set(map(self._file_of, completion.layers)))), tuple(sorted(specs))
        )


def _cause(key: tuple[str, Source], gathered: _Gathered) -> Cause:
    code, source = key
    places = gathered.counting
    assert places.cover
    reason = places.first[0].finding.ignored
    return Cause(
        fingerprint=fingerprint(code, source),
        severity=places.severity,
        source=source,
        cover=places.cover,
        places=tuple(Place(met.stage, met.finding) for met in places.first),
        count=places.count,
        state=State.NEW if reason is None else State.SUPPRESSED,
        reason=reason,
    )


def versions_in(pattern: str | None) -> re.Pattern[str] | None:
    """What a `version-pattern` matches in a path: between separators, so `v1` not in `rev12`."""
    return re.compile(rf"(?<![^\W_])(?:{pattern})(?![^\W_])") if pattern else None
