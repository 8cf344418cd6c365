"""Makes findings of what rules yield: with code, severity, layer, line and frames."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

from usdvol_lint.engine.identity import Identity, identity
from usdvol_lint.engine.parts import parts_of
from usdvol_lint.engine.site import Sites, cover_of
from usdvol_lint.model import Finding, Lack, Severity
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.packs.catalog import NOT_CHECKED, help_for
from usdvol_lint.rule import NotChecked, Problem, Rule
from usdvol_lint.words import quoted


class Stamped(NamedTuple):
    """A finding, and its identity, which is the same under every variant selection.

    `holds` is called when all selections were checked; if it returns False, there is no finding.
    """

    finding: Finding
    identity: Identity
    holds: Callable[[], bool] | None = None


class Stamp:
    """Makes findings of the problems of one stage.

    `several_selections` says whether findings need an identity, because more than one variant
    selection is checked; `is_alone` whether no other stage may complete this one.
    """

    def __init__(
        self, active: ActiveRules, several_selections: bool, is_alone: bool = False
    ) -> None:
        self.sites = Sites()
        self._active = active
        self._several_selections = several_selections
        self._is_alone = is_alone

    def stamp(self, rule: Rule, problem: Problem | NotChecked) -> Iterator[Stamped]:
        """The finding; none if LNT005, which reports what was not checked, is switched off."""
        reported_as = NOT_CHECKED if isinstance(problem, NotChecked) else rule
        severity = self._active.severities.get(reported_as.code)
        if severity is None:
            return
        if problem.at_default and problem.times:
            for part in parts_of(problem):
                yield self._stamped(rule, reported_as, part, severity)
        else:
            yield self._stamped(rule, reported_as, problem, severity)

    def _stamped(
        self, rule: Rule, reported_as: Rule, problem: Problem | NotChecked, severity: Severity
    ) -> Stamped:
        site, source, blame, instances = self.sites.locate(problem)
        shown = f" (shown by {instances:,} instances)" if instances > 1 else ""
        clip = ""
        if blame.clip and blame.clip.rpartition("/")[2] not in problem.message:
            clip = f" (in the clip {quoted(blame.clip)})"
        if reported_as is not rule and source.layer is not None:
            source = source._replace(subject=f"{rule.code} {source.subject}".rstrip())
        own = min(reported_as.severity, problem.severity or reported_as.severity)
        finding = Finding(
            code=reported_as.code,
            name=reported_as.name,
            severity=self._lowered(severity, problem, reported_as.code),
            message=problem.message + clip + shown,
            site=site,
            source=source,
            cover=cover_of(problem, blame, own),
            suggestion=problem.suggestion,
            help=help_for(reported_as),
            fold=problem.fold,
            absent=() if self._is_alone else _absent(problem),
            since=problem.since,
        )
        same = identity(rule, problem, blame.spec) if self._several_selections else ()
        return Stamped(finding, same, problem.holds)

    def _lowered(self, severity: Severity, problem: Problem | NotChecked, code: str) -> Severity:
        """The severity of a milder or younger case, unless the user chose one for the rule."""
        if self._active.is_younger(code, problem.since):
            return Severity.INFO
        milder = problem.severity
        if milder is None or code in self._active.chosen:
            return severity
        return min(severity, milder)


def _absent(problem: Problem | NotChecked) -> tuple[frozenset[Lack], ...]:
    """What is absent, in terms of the specs in files of the prims that lack it."""
    return tuple(
        frozenset(
            (spec.layer.realPath, str(spec.path), name)
            for prim, name in part
            for spec in prim.GetPrimStack()
            if spec.layer.realPath
        )
        for part in problem.absent
    )
