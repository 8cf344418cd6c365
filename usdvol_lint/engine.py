"""A stage and rules become findings: stamped with code, severity and site, whatever a rule does."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from pxr import Tf, Usd

from usdvol_lint import schema
from usdvol_lint.catalog import NOT_CHECKED, RULE_FAILED, STAGE_UNREADABLE, help_for
from usdvol_lint.config import ActiveRules
from usdvol_lint.facts import Facts
from usdvol_lint.facts.kinds import Kinds
from usdvol_lint.model import Finding, Severity, StageReport, Status, with_fingerprints
from usdvol_lint.paths import display
from usdvol_lint.rule import STAGE, NotChecked, Problem, Rule
from usdvol_lint.site import Sites
from usdvol_lint.stage import in_usds_words, open_stage
from usdvol_lint.trouble import Unreadable, report_trouble
from usdvol_lint.walk import Walk, assign, walk

_LONGEST = 300


def usd_version() -> str:
    """The installed USD's version, as its wheel spells it: `26.11`."""
    major, minor, patch = Usd.GetVersion()
    return ".".join(str(part) for part in (major, minor, patch)[0 if major else 1 :])


def _ignore_progress(samples: int) -> None:
    pass


class Engine:
    """Lints stages, one after the other, with the same rules.

    `advance` is told how many samples of a long sequence were read since it was last told.
    USD's own warnings go to standard error, which in a worker process is the parent's to read.
    """

    def __init__(
        self,
        rules: Mapping[str, Rule],
        active: ActiveRules,
        load: str = "all",
        advance: Callable[[int], None] = _ignore_progress,
    ) -> None:
        self._rules = [rules[code] for code in active.severities]
        self._options = active.options
        self._severities = active.severities
        self._load = load
        self._advance = advance

    def lint(self, path: str) -> StageReport:
        """Everything there is to say of one stage; never raises for what the stage holds."""
        clock = _Stopwatch()
        try:
            stage = open_stage(path, self._load)
        except Unreadable as trouble:
            clock.lap("open")
            return report_trouble(path, trouble, seconds=clock.seconds)
        clock.lap("open")
        kinds = Kinds()
        walked = walk(stage, self._rules, kinds)
        clock.lap("walk")
        facts = Facts(stage, kinds, walked.kept, self._advance)
        findings = with_fingerprints(self._findings(walked, facts))
        clock.lap("check")
        stats = _stats(walked, facts)
        return StageReport(display(path), Status.CHECKED, stats, findings, clock.seconds)

    def _findings(self, walked: Walk, facts: Facts) -> Iterator[Finding]:
        sites = Sites()
        failures = _Failures()
        for rule, prim in self._work(walked, facts):
            options = self._options.get(rule.code, {})
            try:
                for problem in rule.check(prim, facts, **options):
                    yield from self._stamp(rule, problem, sites)
            except Exception as error:
                failures.add(rule, prim, error)
        yield from failures.findings(sites)

    def _work(self, walked: Walk, facts: Facts) -> Iterator[tuple[Rule, Any]]:
        """Each rule with each prim it asked for."""
        for rule in self._rules:
            if STAGE in rule.on:
                yield rule, facts.stage.GetPseudoRoot()
        yield from assign(walked, self._rules, facts.kinds)

    def _stamp(self, rule: Rule, problem: Problem | NotChecked, sites: Sites) -> Iterator[Finding]:
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
        yield Finding(
            code=code.code,
            name=code.name,
            severity=severity,
            message=problem.message + shown,
            site=site,
            suggestion=problem.suggestion,
            help=help_for(code),
        )


@dataclass(slots=True)
class _Stopwatch:
    """Wall-clock seconds by phase."""

    seconds: dict[str, float] = field(default_factory=dict)
    _since: float = field(default_factory=time.perf_counter)

    def lap(self, phase: str) -> None:
        now = time.perf_counter()
        self.seconds[phase] = now - self._since
        self._since = now


@dataclass(slots=True)
class _Failure:
    rule: Rule
    prim: Any
    error: Exception
    count: int = 0


class _Failures:
    """Rules that raised, each kind of failure once, however many prims it hit.

    Where USD raised, the stage holds what USD can't read, whichever rule asks for it.
    """

    def __init__(self) -> None:
        self._failures: dict[tuple[object, ...], _Failure] = {}

    def add(self, rule: Rule, prim: Any, error: Exception) -> None:
        key: tuple[object, ...] = (rule.code, type(error), _line(error))
        if isinstance(error, Tf.ErrorException):
            key = (prim.GetPath(), *in_usds_words(error))
        self._failures.setdefault(key, _Failure(rule, prim, error)).count += 1

    def findings(self, sites: Sites) -> Iterator[Finding]:
        for failure in self._failures.values():
            by_usd = isinstance(failure.error, Tf.ErrorException)
            code = STAGE_UNREADABLE if by_usd else RULE_FAILED
            yield Finding(
                code=code.code,
                name=code.name,
                severity=Severity.ERROR,
                message=_usd_failed(failure.error) if by_usd else _rule_failed(failure),
                site=sites.locate(NotChecked("", at=failure.prim)).site,
                suggestion="the layer is probably corrupt: copy or export it again"
                if by_usd
                else "a bug of the rule, not of the stage; --verbose shows the traceback",
                help=help_for(code),
                detail=_traceback(failure.error),
            )


def _usd_failed(error: Exception) -> str:
    said = " ".join("; ".join(in_usds_words(error)).split())
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
