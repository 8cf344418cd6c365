"""What rules yield becomes findings: with code, severity, and the place in its layer."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from usdvol_lint.engine.identity import Identity, identity
from usdvol_lint.engine.site import Sites
from usdvol_lint.model import Finding, Severity
from usdvol_lint.packs.catalog import NOT_CHECKED, help_for
from usdvol_lint.rule import NotChecked, Problem, Rule


class Found(NamedTuple):
    """A finding, with what tells it from others under every variant selection.

    `holds` is asked when all selections were looked at.
    """

    finding: Finding
    identity: Identity
    holds: Callable[[], bool] | None = None


class Stamp:
    """Makes findings of the problems of one stage.

    `severities` are those of the rules in force; `several_selections` says whether findings have
    to be told apart under more than one.
    """

    def __init__(self, severities: Mapping[str, Severity], several_selections: bool) -> None:
        self.sites = Sites()
        self._severities = severities
        self._several_selections = several_selections

    def stamp(self, rule: Rule, said: Problem | NotChecked) -> Iterator[Found]:
        """The finding; none if LNT005, which reports what was not checked, is switched off."""
        reported_as = NOT_CHECKED if isinstance(said, NotChecked) else rule
        severity = self._severities.get(reported_as.code)
        if severity is None:
            return
        site, spec, instances = self.sites.locate(said)
        shown = f" (shown by {instances} instances)" if instances > 1 else ""
        finding = Finding(
            code=reported_as.code,
            name=reported_as.name,
            severity=_lowered(severity, rule, said),
            message=said.message + shown,
            site=site,
            suggestion=said.suggestion,
            help=help_for(reported_as),
        )
        known_by = identity(rule, said, spec) if self._several_selections else ()
        yield Found(finding, known_by, said.holds if isinstance(said, Problem) else None)


def _lowered(severity: Severity, rule: Rule, said: Problem | NotChecked) -> Severity:
    """The severity of a milder case, unless the user chose one for the rule."""
    if isinstance(said, Problem) and said.severity is not None and severity == rule.severity:
        return min(severity, said.severity)
    return severity
