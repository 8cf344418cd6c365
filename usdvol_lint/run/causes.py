"""Folds what stages show into causes: one for each thing to mend, with its first places."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import cache
from typing import TypeAlias

from usdvol_lint.baseline.cover import join
from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.model import Completion, Finding, Severity, Source, StageReport
from usdvol_lint.paths import below, canonical
from usdvol_lint.results import Cause, Place, StageResult, State

MAX_PLACES = 20


_Key: TypeAlias = tuple[str, str | None, str | None, str | None, str]
"""What makes a cause: the code, and its source with the layer as fingerprints have it."""


class _Places:
    """Some places of a cause: the first ones, the number of all, and what they come to."""

    __slots__ = ("count", "cover", "first", "severity")

    def __init__(self, first: Place) -> None:
        self.first = [first]
        self.count = 1
        self.severity = first.finding.severity
        self.cover = first.finding.cover

    def add(self, place: Place, most: int) -> None:
        self.count += 1
        self.severity = max(self.severity, place.finding.severity)
        if self.cover != place.finding.cover:
            self.cover = join(self.cover, place.finding.cover)
        if len(self.first) < most:
            self.first.append(place)


class _Gathered:
    """What is known of one cause so far: its number, the places left, and those suppressed."""

    __slots__ = ("left", "number", "suppressed")

    def __init__(self, number: int) -> None:
        self.number = number
        self.left: _Places | None = None
        self.suppressed: _Places | None = None

    def add(self, place: Place, most: int) -> None:
        if place.finding.ignored is not None:
            if self.suppressed:
                self.suppressed.add(place, most)
            else:
                self.suppressed = _Places(place)
        elif self.left:
            self.left.add(place, most)
        else:
            self.left = _Places(place)


class Causes:
    """The causes of a run, whatever stages show them, numbered in the order in which they are met.

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
        self._found: dict[_Key, _Gathered] = {}
        self._shown: dict[int, dict[int, Severity | None]] = {}

        @cache
        def name_of(layer: str) -> str:
            name = below(layer, root)
            return versions.sub("*", name) if versions else name

        @cache
        def file_of(layer: str) -> str:
            return below(canonical(layer), root)

        self._name_of = name_of
        self._file_of = file_of

    def add(self, stage: int, stage_path: str, findings: Iterable[Finding]) -> None:
        """Adds findings of a stage, after all that are to be told before them."""
        shown = self._shown.setdefault(stage, {})
        found, most, name_of = self._found, self._most, self._name_of
        is_judged = self._verdict_on is not None or self._reason_for is not None
        for finding in findings:
            layer, path, name, subject = finding.source
            key = finding.code, layer and name_of(layer), path, name, subject
            gathered = found.get(key)
            if gathered is None:
                gathered = found[key] = _Gathered(len(found))
            if is_judged:
                finding = self._judged(stage_path, finding, Source(*key[1:]))
            gathered.add(Place(stage, finding), most)
            worst = shown.setdefault(gathered.number, None)
            if finding.ignored is None:
                shown[gathered.number] = max(worst or finding.severity, finding.severity)

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

    def result(self) -> tuple[Cause, ...]:
        """The causes in the order in which they were met."""
        return tuple(_cause(key, gathered) for key, gathered in self._found.items())

    def stage(self, number: int, report: StageReport, is_part: bool = False) -> StageResult:
        """What came of a stage, asked for once all of its findings were added."""
        shown = sorted(self._shown.pop(number, {}).items())
        return StageResult(
            path=report.path,
            status=report.status,
            stats=report.stats,
            seconds=report.seconds,
            particle_fields=report.particle_fields,
            completes=report.completes and self._named(report.completes),
            causes=tuple(number for number, _ in shown),
            worst=tuple(worst for _, worst in shown),
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


def _cause(key: _Key, gathered: _Gathered) -> Cause:
    code, source = key[0], Source(*key[1:])
    places = gathered.left or gathered.suppressed
    assert places
    reason = places.first[0].finding.ignored
    return Cause(
        fingerprint=fingerprint(code, source),
        severity=places.severity,
        source=source,
        cover=places.cover,
        places=tuple(places.first),
        count=places.count,
        state=State.NEW if reason is None else State.SUPPRESSED,
        reason=reason,
    )


def versions_in(pattern: str | None) -> re.Pattern[str] | None:
    """What a `version-pattern` matches in a path: between separators, so `v1` not in `rev12`."""
    return re.compile(rf"(?<![^\W_])(?:{pattern})(?![^\W_])") if pattern else None
