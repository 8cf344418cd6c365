"""Checks one stage: walks it, runs the rules, and does so again for other variant selections."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from usdvol_lint import schema
from usdvol_lint.engine.asked_types import IdleRule
from usdvol_lint.engine.assign import Assignment, Options
from usdvol_lint.engine.failures import Failures
from usdvol_lint.engine.identity import Identity
from usdvol_lint.engine.lacking import absent_under
from usdvol_lint.engine.stamp import Found, Stamp, Stamped
from usdvol_lint.engine.trouble import PACK_FAILURES
from usdvol_lint.engine.usd_version import usd_version
from usdvol_lint.engine.variants import OtherSelections
from usdvol_lint.engine.walk import walk
from usdvol_lint.facts import Context, Facts, Walked
from usdvol_lint.facts.usd.diagnostics import UNREADABLE, Unreadable
from usdvol_lint.facts.usd.instances import cut_short
from usdvol_lint.model import Finding
from usdvol_lint.packs.catalog import NOT_CHECKED, USD_TOO_OLD
from usdvol_lint.rule import STAGE, NotChecked, Problem, Rule

_UNSTAMPED = 0.05
"""So much of what was found may be lost if the process dies, before it was made findings of."""
_MOST_UNSTAMPED = 300


class StageCheck:
    """Checks one stage; findings come from generators, so that they can be sent as they come.

    `broken` is text that USD could not read, and gave no value for; it may grow all the time.
    """

    def __init__(
        self,
        context: Context,
        rules: Sequence[Rule],
        options: Options,
        assignment: Assignment,
        stamp: Stamp,
        broken: list[UnicodeDecodeError] | None = None,
    ) -> None:
        self._context = context
        self._rules = rules
        self._options = options
        self._assignment = assignment
        self._stamp = stamp
        self._broken = broken if broken is not None else []

    def walk(self) -> Walked:
        """The prims that the rules ask for, under the variant selection composed now."""
        return walk(self._context.stage, self._assignment.asked_for, self._context.kinds)

    def facts(self, walked: Walked) -> Facts:
        """The facts under the variant selection composed now."""
        return Facts(self._context, walked)

    def usd_version(self, facts: Facts) -> Iterator[Stamped]:
        """Reports a stage with particle fields under a USD that does not know them."""
        if not facts.kinds.knows_particle_fields and facts.prims.of(schema.PARTICLE_FIELD):
            since = ".".join(map(str, schema.PARTICLE_FIELD_SINCE[1:]))
            too_old = Problem(
                f"USD {usd_version()} knows no particle fields, which came with {since}: they are "
                "checked by the names of their types, APIs and attributes",
                at=facts.stage.GetPseudoRoot(),
                machine="usd-core",
                suggestion=f"install usd-core {since} or later",
            )
            yield from self._stamp.stamp(USD_TOO_OLD, too_old)

    def idle(self, facts: Facts, rules: Iterable[IdleRule]) -> Iterator[Stamped]:
        """Reports the rules that ask for types which nobody knows."""
        for each in rules:
            yield from self._stamp.stamp(each.rule, each.told_at(facts.stage.GetPseudoRoot()))

    def selection(self, walked: Walked, facts: Facts) -> Iterator[Stamped | None]:
        """What the rules find under the selection composed now, and where they failed.

        None where another stage may go on.
        """
        self._stamp.recomposed()
        failures = Failures()
        new: list[Found] = []
        number = 0
        try:
            for found in self._problems(walked, facts, failures):
                if found is None:
                    yield None
                    continue
                new.append(found)
                number += 1
                if len(new) > min(_UNSTAMPED * number, _MOST_UNSTAMPED):
                    yield from self._stamp.stamp_all(new, failures.add)
                    new = []
        except UNREADABLE:
            yield from self._stamp.stamp_all(new, failures.add)
            raise
        yield from self._stamp.stamp_all(new, failures.add)
        for prim, fault in facts.tables.unreadable:
            failures.add(NOT_CHECKED, prim, fault)
        for text in self._broken:
            failures.add(NOT_CHECKED, facts.stage.GetPseudoRoot(), text)
        self._broken.clear()
        for prim, words in cut_short(facts.stage):
            yield from self._stamp.stamp(NOT_CHECKED, _cut_short(prim, words))
        yield from self._failed(failures)
        yield from self._stamp.suppressions(facts.stage, failures.prims)
        yield from self.faults()

    def _problems(self, walked: Walked, facts: Facts, failures: Failures) -> Iterator[Found | None]:
        """What the rules yield; None where another stage may go on."""
        for assigned in self._assigned(walked, facts, failures):
            if assigned is None:
                yield None
                continue
            rule, prim = assigned
            options = self._options.get(rule.code, {})
            try:
                for problem in rule.check(prim, facts, **options):
                    yield rule, prim, problem
            except PACK_FAILURES as error:  # reported, and the other rules go on
                failures.add(rule, prim, error)

    def faults(self) -> Iterator[Stamped]:
        """What failed beside the rules since it was asked for last."""
        yield from self._failed(Failures())

    def _failed(self, failures: Failures) -> Iterator[Stamped]:
        """What failed, also in looking for places of what was found."""
        sites = self._stamp.sites
        for prim, what, error in sites.faults:
            failures.add_place(prim, what, error)
        yield from failures.findings(sites)
        sites.faults.clear()

    def others(self, selections: OtherSelections, known: set[Identity]) -> Iterator[Stamped]:
        """What only other variant selections show, each with the first selection that shows it."""
        for selection, error in selections:
            for stamped in filter(None, self._other(error)):
                if stamped.identity not in known:
                    known.add(stamped.identity)
                    yield stamped._replace(finding=self._under(selection, stamped.finding))
        for left_out in selections.not_checked():
            yield from self._stamp.stamp(NOT_CHECKED, left_out)

    def _under(self, selection: str | None, finding: Finding) -> Finding:
        """A finding as it is told that only another selection shows."""
        finding = finding._replace(site=finding.site._replace(variant=selection))
        if not selection or not finding.absent:
            return finding
        root = self._context.stage.GetRootLayer().realPath
        return finding._replace(absent=absent_under(selection, finding.absent, root))

    def _other(self, fault: Unreadable | None) -> Iterator[Stamped | None]:
        """What the selection composed now shows, or `fault`, which kept USD from composing it."""
        if not fault:
            try:
                walked = self.walk()
            except UNREADABLE as error:
                fault = error
            else:
                yield from self.selection(walked, self.facts(walked))
        if fault:
            failures = Failures()
            failures.add(NOT_CHECKED, self._context.stage.GetPseudoRoot(), fault)
            yield from self._failed(failures)

    def _assigned(
        self, walked: Walked, facts: Facts, failures: Failures
    ) -> Iterator[tuple[Rule, Any] | None]:
        """Each rule with each prim that it is handed; rules on the stage get the pseudo-root."""
        root = facts.stage.GetPseudoRoot()

        def failed(rules: Sequence[Rule], error: BaseException) -> None:
            failures.add_precondition(rules, root, error)

        yield from self._assignment.pairs(walked, facts, failed)
        for rule in self._rules:
            if STAGE in rule.on:
                yield None
                yield rule, root


def _cut_short(prim: Any, words: str) -> NotChecked:
    """That a prim is shown more often than could be looked at."""
    return NotChecked(words, at=prim, suggestion="check the asset that is instanced by itself")
