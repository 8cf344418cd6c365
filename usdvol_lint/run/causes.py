"""Folds what stages show into causes: one for each thing to mend, with its first places."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from operator import itemgetter
from typing import NamedTuple, TypeAlias, TypedDict, TypeVar, cast

from usdvol_lint.baseline.cover import join
from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.model import Completion, Finding, Severity, Source, StageReport
from usdvol_lint.paths import below, canonical
from usdvol_lint.results import Cause, Place, StageResult, State
from usdvol_lint.run.teller import Teller

MAX_PLACES = 20


_Key: TypeAlias = tuple[str, str | None, str | None, str | None, str]
"""What makes a cause: the code, and its source with the layer as fingerprints have it."""
_Same = TypeVar("_Same")


class _Places:
    """Some places of a cause: the first ones, the number of all, and what they come to."""

    __slots__ = ("count", "cover", "first", "here", "severity")

    def __init__(self, stage: int, finding: Finding) -> None:
        self.first = [Place(stage, finding)]
        self.count = self.here = 1
        self.severity = finding.severity
        self.cover = finding.cover

    def add(self, stage: int, finding: Finding, most: int) -> None:
        self.count += 1
        self.here += stage == self.first[0].stage
        if self.severity < finding.severity:
            self.severity = finding.severity
        if self.cover != finding.cover:
            self.cover = join(self.cover, finding.cover)
        if len(self.first) < most:
            self.first.append(Place(stage, finding))


class _Gathered:
    """What is known of one cause so far: the places left, those suppressed, and its number.

    It has a number once it is told: what is suppressed so far may yet be no cause to tell of.
    """

    __slots__ = ("is_told", "key", "left", "number", "suppressed")

    def __init__(self, key: _Key) -> None:
        self.key = key
        self.number: int | None = None
        self.is_told = False
        self.left: _Places | None = None
        self.suppressed: _Places | None = None

    def add(self, stage: int, finding: Finding, most: int) -> None:
        if finding.ignored is not None:
            if self.suppressed:
                self.suppressed.add(stage, finding, most)
            else:
                self.suppressed = _Places(stage, finding)
        elif self.left:
            self.left.add(stage, finding, most)
        else:
            self.left = _Places(stage, finding)


class _Again(NamedTuple):
    """Another place of a cause that was told before, and how bad it was until then."""

    gathered: _Gathered
    place: Place
    is_kept: bool
    before: Severity


class _Numbers(TypedDict):
    """The causes that a stage shows, as its result has them."""

    causes: tuple[int, ...]
    worst: tuple[Severity | None, ...]


_Shown: TypeAlias = dict[_Gathered, Severity | None]
"""How bad each cause is on a stage; None where a suppression takes it out."""


class Causes:
    """The causes of a run, whatever stages show them, numbered in the order in which they are told.

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
        self._numbered: list[_Gathered] = []
        self._shown: dict[int, _Shown] = {}
        self._new: list[_Gathered] = []
        self._again: list[_Again] = []
        self._equal: dict[object, object] = {}

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
                gathered = found[key] = _Gathered(key)
            if is_judged:
                finding = self._judged(stage_path, finding, Source(*key[1:]))
            worst = shown.setdefault(gathered, None)
            if finding.ignored is None:
                if worst is None or worst < finding.severity:
                    shown[gathered] = finding.severity
                if gathered.number is None:
                    self._number(gathered)
                elif gathered.is_told and gathered.left:
                    self._note(gathered, gathered.left, Place(stage, finding))
            gathered.add(stage, finding, most)

    def _note(self, gathered: _Gathered, left: _Places, place: Place) -> None:
        """Keeps what is to be told of another place, before it is added."""
        is_kept = len(left.first) < self._most
        if is_kept or left.severity < place.finding.severity:
            self._again.append(_Again(gathered, place, is_kept, left.severity))

    def _number(self, gathered: _Gathered) -> None:
        gathered.number = len(self._numbered)
        self._numbered.append(gathered)
        self._new.append(gathered)

    def tell(self, teller: Teller) -> None:
        """Tells what was added since the last time."""
        if not teller.listening:
            self._new.clear()
            return
        for gathered in self._new:
            number, cause = _number_of(gathered), _cause(gathered)
            gathered.is_told = True
            teller.cause(number, cause)
            for place in cause.places[1:]:
                teller.place(number, place)
        self._new.clear()
        before: dict[_Gathered, Severity] = {}
        for gathered, place, is_kept, was in self._again:
            assert gathered.left
            if is_kept:
                teller.place(_number_of(gathered), place)
            worst = before.setdefault(gathered, was)
            if worst < gathered.left.severity == place.finding.severity:
                raised = _cause(gathered)._replace(places=(place,), here=1)
                teller.raised(_number_of(gathered), raised, worst)
                before[gathered] = gathered.left.severity
        self._again.clear()

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
        """The causes in the order in which they were told, those that are suppressed last."""
        for gathered in self._found.values():
            if gathered.number is None:
                self._number(gathered)
        return tuple(map(_cause, self._numbered))

    def stage(
        self, number: int, report: StageReport, is_part: bool = False, waits: bool = False
    ) -> StageResult:
        """What came of a stage; asked for once all of its findings were added, unless it `waits`.

        It is whole after `completed` only.
        """
        shown = self._shown[number] if waits else self._shown.pop(number, {})
        if any(each.number is None for each in shown):
            self._shown[number] = shown
        return StageResult(
            path=report.path,
            status=report.status,
            stats=self._once(("stats", *report.stats.items()), report.stats),
            seconds=report.seconds,
            particle_fields=report.particle_fields,
            completes=report.completes and self._named(report.completes),
            part=is_part,
            **self._causes_of(shown),
        )

    def completed(self, stages: Sequence[StageResult]) -> tuple[StageResult, ...]:
        """The stages, with the causes that had no number yet, or waited; after `result`."""
        whole = list(stages)
        for number, shown in self._shown.items():
            whole[number] = whole[number]._replace(**self._causes_of(shown))
        return tuple(whole)

    def _causes_of(self, shown: _Shown) -> _Numbers:
        pairs = [(each.number, worst) for each, worst in shown.items() if each.number is not None]
        causes, worst = zip(*sorted(pairs, key=itemgetter(0)), strict=True) if pairs else ((), ())
        return {
            "causes": self._once(("causes", *causes), causes),
            "worst": self._once(("worst", *worst), worst),
        }

    def _once(self, key: object, value: _Same) -> _Same:
        """What equals a value that was kept before: many stages have it in common."""
        return cast("_Same", self._equal.setdefault(key, value))

    def _named(self, completion: Completion) -> Completion:
        """The same with layers as fingerprints have them, of each version its own."""
        specs = (
            spec._replace(layers=tuple(map(self._file_of, spec.layers)))
            for spec in completion.specs
        )
        return Completion(
            tuple(sorted(set(map(self._file_of, completion.layers)))), tuple(sorted(specs))
        )


def _number_of(gathered: _Gathered) -> int:
    assert gathered.number is not None
    return gathered.number


def _cause(gathered: _Gathered) -> Cause:
    code, source = gathered.key[0], Source(*gathered.key[1:])
    places = gathered.left or gathered.suppressed
    assert places
    reason = places.first[0].finding.ignored
    return Cause(  # by positions, because to name so many takes as long as to make it
        fingerprint(code, source),
        places.severity,
        source,
        places.cover,
        tuple(places.first),
        places.count,
        State.NEW if reason is None else State.SUPPRESSED,
        None,
        reason,
        places.here,
    )


def versions_in(pattern: str | None) -> re.Pattern[str] | None:
    """What a `version-pattern` matches in a path: between separators, so `v1` not in `rev12`."""
    return re.compile(rf"(?<![^\W_])(?:{pattern})(?![^\W_])") if pattern else None
