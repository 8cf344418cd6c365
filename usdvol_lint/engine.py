"""A stage and rules become findings: stamped with code, severity and site, whatever a rule does."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

from pxr import Sdf, Tf, Usd

from usdvol_lint import schema
from usdvol_lint.catalog import (
    NOT_CHECKED,
    RULE_FAILED,
    STAGE_UNREADABLE,
    USD_TOO_OLD,
    help_for,
)
from usdvol_lint.config import ActiveRules
from usdvol_lint.facts import Facts
from usdvol_lint.facts.kinds import Kinds
from usdvol_lint.facts.usd_errors import without_grammar
from usdvol_lint.model import Finding, Severity, StageReport, Status, with_fingerprints
from usdvol_lint.paths import display
from usdvol_lint.rule import STAGE, NotChecked, Problem, Rule
from usdvol_lint.site import Sites
from usdvol_lint.stage import in_usds_words, open_stage
from usdvol_lint.trouble import Unreadable, report_trouble
from usdvol_lint.variants import Identity, OtherSelections, identity
from usdvol_lint.volumefile.cache import VolumeFiles
from usdvol_lint.walk import Walk, assign, walk

_LONGEST = 300
_TOLD_AT_ONCE = 100


def usd_version() -> str:
    """The installed USD's version, as its wheel spells it: `26.11`."""
    major, minor, patch = Usd.GetVersion()
    return ".".join(str(part) for part in (major, minor, patch)[0 if major else 1 :])


def _ignore(told: object) -> None:
    pass


class Engine:
    """Lints stages, one after the other, with the same rules.

    `advance` is told how many samples of a long sequence were read since it was last told, `tell`
    what was found meanwhile, so that it is not lost whatever becomes of the stage.
    `selections` is how many variant selections besides the authored ones are composed at most.
    `times` says which time samples of particles are looked at, `statistics` whether to tell what
    particle fields hold.
    USD's own warnings go to standard error, which in a worker process is the parent's to read.
    """

    def __init__(
        self,
        rules: Mapping[str, Rule],
        active: ActiveRules,
        load: str = "all",
        content: str = "all",
        advance: Callable[[int], None] = _ignore,
        tell: Callable[[list[Finding]], None] = _ignore,
        selections: int = 0,
        times: str | int = "all",
        statistics: bool = False,
    ) -> None:
        self._rules = [rules[code] for code in active.severities]
        self._options = active.options
        self._severities = active.severities
        self._load = load
        self._advance = advance
        self._tell = tell
        self._content = content
        self._volume_files = VolumeFiles()
        self._selections = selections
        self._times = times
        self._statistics = statistics

    def lint(self, path: str) -> StageReport:
        """Everything there is to say of one stage; never raises for what the stage holds."""
        clock = _Stopwatch()
        try:
            session = Sdf.Layer.CreateAnonymous() if self._selections else None
            stage = open_stage(path, self._load, session)
        except Unreadable as trouble:
            clock.lap("open")
            return report_trouble(path, trouble, seconds=clock.seconds)
        clock.lap("open")
        kinds = Kinds(stage.GetMetadata("fallbackPrimTypes"))
        walked = walk(stage, self._rules, kinds)
        clock.lap("walk")
        facts = Facts(
            stage,
            kinds,
            walked.kept,
            walked.clipped,
            self._advance,
            self._content,
            self._volume_files,
            self._times,
            self._statistics,
        )
        sites = Sites()
        found = [
            *self._told(self._check_usd(facts, sites)),
            *self._told(self._check(walked, facts, sites)),
        ]
        stats = _stats(walked, facts)
        particle_fields = facts.particle_field_stats() if self._statistics else None
        if self._selections:
            clock.lap("check")
            others = OtherSelections(stage, kinds, self._selections)
            known = {each.identity for each in found}
            found += self._told(self._check_others(others, known, facts, sites))
            stats["variant_selections"] = others.composed
            clock.lap("variants")
        findings = with_fingerprints(
            each.finding for each in found if not each.holds or each.holds()
        )
        clock.lap("check")
        return StageReport(
            display(path), Status.CHECKED, stats, findings, clock.seconds, particle_fields
        )

    def _told(self, found: Iterable[_Found]) -> Iterator[_Found]:
        """To tell of each by itself takes its time: of many, a tenth may be kept back."""
        untold: list[Finding] = []
        for number, each in enumerate(found):
            untold.append(each.finding)
            if number < _TOLD_AT_ONCE or 10 * len(untold) > number:
                self._tell(untold)
                untold = []
            yield each
        if untold:
            self._tell(untold)

    def _check_usd(self, facts: Facts, sites: Sites) -> Iterator[_Found]:
        """Whether the installed USD knows what the stage uses."""
        if not facts.kinds.knows_particle_fields and facts.of(schema.PARTICLE_FIELD):
            since = ".".join(map(str, schema.PARTICLE_FIELD_SINCE[1:]))
            too_old = Problem(
                f"USD {usd_version()} knows no particle fields, which came with {since}: they are "
                "checked by the names of their types, APIs and attributes",
                at=facts.stage.GetPseudoRoot(),
                suggestion=f"install usd-core {since} or later",
            )
            yield from self._stamp(USD_TOO_OLD, too_old, sites)

    def _check_others(
        self, others: OtherSelections, known: set[Identity], facts: Facts, sites: Sites
    ) -> Iterator[_Found]:
        """What only other variant selections show, each with the first that does."""
        for selection, error in others:
            for found in self._check_other(error, facts, sites):
                if found.identity not in known:
                    known.add(found.identity)
                    site = replace(found.finding.site, variant=selection)
                    yield found._replace(finding=replace(found.finding, site=site))
        for left_out in others.not_checked():
            yield from self._stamp(NOT_CHECKED, left_out, sites)

    def _check_other(
        self, fault: Tf.ErrorException | None, facts: Facts, sites: Sites
    ) -> Iterator[_Found]:
        """What one selection shows, or why it can't be told."""
        if not fault:
            try:
                walked = walk(facts.stage, self._rules, facts.kinds)
            except Tf.ErrorException as error:
                fault = error
            else:
                facts = facts.composed_anew(walked.kept, walked.clipped)
                yield from self._check(walked, facts, sites)
        if fault:
            failures = _Failures()
            failures.add(NOT_CHECKED, facts.stage.GetPseudoRoot(), fault)
            yield from failures.found(sites)

    def _check(self, walked: Walk, facts: Facts, sites: Sites) -> Iterator[_Found]:
        failures = _Failures()
        for rule, prim in self._work(walked, facts):
            options = self._options.get(rule.code, {})
            try:
                for problem in rule.check(prim, facts, **options):
                    yield from self._stamp(rule, problem, sites)
            except Exception as error:
                failures.add(rule, prim, error)
        for prim, fault in facts.passed_over:
            failures.add(NOT_CHECKED, prim, fault)
        yield from failures.found(sites)

    def _work(self, walked: Walk, facts: Facts) -> Iterator[tuple[Rule, Any]]:
        """Each rule with each prim it asked for."""
        yield from assign(walked, self._rules, facts, self._options)
        for rule in self._rules:
            if STAGE in rule.on:
                yield rule, facts.stage.GetPseudoRoot()

    def _stamp(self, rule: Rule, problem: Problem | NotChecked, sites: Sites) -> Iterator[_Found]:
        """The problem with code, severity and site; nothing if LNT005 is switched off."""
        code = NOT_CHECKED if isinstance(problem, NotChecked) else rule
        severity = self._severities.get(code.code)
        if severity is None:
            return
        lowered = getattr(problem, "severity", None)
        if lowered is not None and severity == rule.severity:
            severity = min(severity, lowered)
        site, instances = sites.locate(problem)
        shown = f" (shown by {instances} instances)" if instances > 1 else ""
        finding = Finding(
            code=code.code,
            name=code.name,
            severity=severity,
            message=problem.message + shown,
            site=site,
            suggestion=problem.suggestion,
            help=help_for(code),
        )
        known_by = identity(rule, problem) if self._selections else ()
        yield _Found(finding, known_by, getattr(problem, "holds", None))


class _Found(NamedTuple):
    """A finding, with what tells it from others under every variant selection."""

    finding: Finding
    identity: Identity
    holds: Callable[[], bool] | None = None


@dataclass(slots=True)
class _Stopwatch:
    """Wall-clock seconds by phase."""

    seconds: dict[str, float] = field(default_factory=dict)
    _since: float = field(default_factory=time.perf_counter)

    def lap(self, phase: str) -> None:
        now = time.perf_counter()
        self.seconds[phase] = self.seconds.get(phase, 0.0) + now - self._since
        self._since = now


@dataclass(slots=True)
class _Failure:
    rule: Rule
    prim: Any
    error: Exception
    traceback: str
    count: int = 0


class _Failures:
    """Rules that raised, each kind of failure once, however many prims it hit.

    Where USD raised, the stage holds what USD can't read, whichever rule asks for it.
    """

    def __init__(self) -> None:
        self._failures: dict[Identity, _Failure] = {}

    def add(self, rule: Rule, prim: Any, error: Exception) -> None:
        key: Identity = (rule.code, type(error).__name__, str(_line(error)))
        if isinstance(error, Tf.ErrorException):
            key = (str(prim.GetPath()), *in_usds_words(error))
        if key not in self._failures:
            self._failures[key] = _Failure(rule, prim, error, _traceback(error))
        self._failures[key].count += 1
        error.__traceback__ = None  # its frames hold the stage, and one of them holds this

    def found(self, sites: Sites) -> Iterator[_Found]:
        for key, failure in self._failures.items():
            by_usd = isinstance(failure.error, Tf.ErrorException)
            code = STAGE_UNREADABLE if by_usd else RULE_FAILED
            finding = Finding(
                code=code.code,
                name=code.name,
                severity=Severity.ERROR,
                message=_usd_failed(failure.error) if by_usd else _rule_failed(failure),
                site=sites.locate(NotChecked("", at=failure.prim)).site,
                suggestion="the layer is probably corrupt: copy or export it again"
                if by_usd
                else "a bug of the rule, not of the stage; --verbose shows the traceback",
                help=help_for(code),
                detail=failure.traceback,
            )
            yield _Found(finding, key)


def _usd_failed(error: Exception) -> str:
    said = "; ".join(map(without_grammar, in_usds_words(error)))
    return f"USD can't read what is here: {said}"[:_LONGEST]


def _rule_failed(failure: _Failure) -> str:
    rule, error = failure.rule, failure.error
    others = f", and on {failure.count - 1} more prims" if failure.count > 1 else ""
    said = " ".join(f"{type(error).__name__}: {error}".split())
    return f"rule {rule.code} ({rule.name}) failed here{others}: {said}"[:_LONGEST]


def _line(error: Exception) -> int:
    """Where it was raised: what it says may name the prim, and so differ on each."""
    place = error.__traceback__
    while place and place.tb_next:
        place = place.tb_next
    return place.tb_lineno if place else 0


def _traceback(error: Exception) -> str:
    import traceback  # costs start-up time, and rules rarely fail

    return "".join(traceback.format_exception(error))


def _stats(walked: Walk, facts: Facts) -> dict[str, int]:
    return {
        "prims": walked.prims,
        "volumes": len(facts.of(schema.VOLUME)),
        "fields": len(facts.of(schema.FIELD)),
        "particle_fields": len(facts.of(schema.PARTICLE_FIELD)),
        "files_checked": facts.files.checked,
    }
