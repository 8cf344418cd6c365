"""Makes findings of what rules yield: with code, severity, layer, line and frames."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from usdvol_lint.cached import cached_property
from usdvol_lint.engine.identity import Identity, identity
from usdvol_lint.engine.lacking import absent_of
from usdvol_lint.engine.parts import parts_of
from usdvol_lint.engine.site import Located, Sites, cover_of
from usdvol_lint.engine.trouble import PACK_FAILURES
from usdvol_lint.facts.usd.calls import is_in_prototype
from usdvol_lint.layertext.source import SharedTexts
from usdvol_lint.model import Cover, Finding, Severity
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.packs.catalog import NOT_CHECKED, UNUSED_SUPPRESSION, help_for
from usdvol_lint.rule import NotChecked, Problem, Rule
from usdvol_lint.suppressions import InStages
from usdvol_lint.words import counted, quoted, shortened

if TYPE_CHECKING:
    from usdvol_lint.engine.pieces import Pieces
    from usdvol_lint.engine.suppressions import Suppressions


_LONGEST = 2_000
"""So many characters a message has, about; paths alone may have megabytes."""
_LONGEST_SUGGESTION = 100_000
"""What there is to paste stays whole, such as a line for each of a thousand frames."""

_REACH = "how much findings cover"
_ABSENT = "what other stages may complete"
_SUPPRESSED = "what suppresses findings"


class Stamped(NamedTuple):
    """A finding, and its identity, which is the same under every variant selection.

    `holds` is called when all selections were checked; if it returns False, there is no finding.
    """

    finding: Finding
    identity: Identity
    holds: Callable[[], bool] | None = None


Found: TypeAlias = tuple[Rule, Any, "Problem | NotChecked"]
"""What a rule yields, and the prim that it was asked about."""
Failed: TypeAlias = Callable[[Rule, Any, BaseException], None]


class _Part(NamedTuple):
    """A problem of one opinion: of which rule, and under which it is reported, and how severe."""

    rule: Rule
    reported_as: Rule
    problem: Problem | NotChecked
    severity: Severity


class Stamp:
    """Makes findings of the problems of one stage.

    `several_selections` says whether findings need an identity, because more than one variant
    selection is checked; `is_alone` whether no other stage may complete this one.
    `rules` are all there are, by code, and `asked` how suppressions in the stage are taken.
    `repository`, `stage`, `texts` and `pieces` are as for `Sites`.
    """

    def __init__(
        self,
        active: ActiveRules,
        several_selections: bool,
        rules: Mapping[str, Rule],
        asked: InStages,
        is_alone: bool = False,
        repository: str | None = None,
        stage: str = "",
        texts: SharedTexts | None = None,
        pieces: Pieces | None = None,
    ) -> None:
        self.sites = Sites(repository, stage, texts, pieces)
        self._active = active
        self._several_selections = several_selections
        self._rules = rules
        self._asked = asked
        self._is_alone = is_alone

    @cached_property
    def _suppressions(self) -> Suppressions:
        """What the stage says is to be ignored; nobody asks on one without findings."""
        from usdvol_lint.engine.suppressions import Suppressions

        return Suppressions(self._rules, self._asked)

    def stamp(self, rule: Rule, problem: Problem | NotChecked) -> list[Stamped]:
        """The finding; none if LNT005, which reports what was not checked, is switched off."""
        return self._stamped(self._parts(rule, problem))

    def stamp_all(self, found: Sequence[Found], failed: Failed) -> list[Stamped]:
        """The findings of many problems: each step is taken for all before the next one.

        So what a step needs is at hand.  `failed` is called with what is raised for one of them.
        """
        faults = len(self.sites.faults)
        try:
            parts = [self._parts(rule, problem) for rule, _, problem in found]
            return self._stamped(list(chain.from_iterable(parts)))
        except PACK_FAILURES:  # it is raised again for the one that is to blame
            del self.sites.faults[faults:]
        stamped: list[Stamped] = []
        for rule, prim, problem in found:
            try:
                stamped += self.stamp(rule, problem)
            except PACK_FAILURES as error:
                failed(rule, prim, error)
        return stamped

    def _parts(self, rule: Rule, problem: Problem | NotChecked) -> list[_Part]:
        """A problem, in parts that are of one opinion each; none where nobody wants to hear it."""
        reported_as = NOT_CHECKED if isinstance(problem, NotChecked) else rule
        severity = self._active.severities.get(reported_as.code)
        if severity is None:
            return []
        if problem.at_default and problem.times:
            return [_Part(rule, reported_as, each, severity) for each in parts_of(problem)]
        return [_Part(rule, reported_as, problem, severity)]

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self.sites.recomposed()
        if "_suppressions" in self.__dict__:
            self._suppressions.recomposed()

    def suppressions(self, stage: Any, failed: Iterable[Any] = ()) -> Iterator[Stamped]:
        """What is wrong with the suppressions that were met, or unused if that is asked for.

        `failed` are prims on which rules failed.
        """
        if not self._asked.heeded:
            return
        root = stage.GetPseudoRoot()
        for prim in failed:
            self.sites.tried(prim, _SUPPRESSED, self._suppressions.ask, prim)
        if self._asked.unused:
            for unused in self.sites.tried(root, _SUPPRESSED, self._unused, stage) or ():
                yield from self.stamp(UNUSED_SUPPRESSION, unused)
        if "_suppressions" in self.__dict__:
            for fault in self._suppressions.faults():
                yield from self.stamp(UNUSED_SUPPRESSION, fault)

    def _unused(self, stage: Any) -> list[Problem]:
        return list(self._suppressions.unused(stage, self._active.severities))

    def _stamped(self, parts: Sequence[_Part]) -> list[Stamped]:
        places = self.sites.locate_all([(part.problem, part.rule) for part in parts])
        findings = list(map(self._finding, parts, places))
        return [
            stamped
            for part, located, finding in zip(parts, places, findings, strict=True)
            for stamped in self._as_told(part, located, finding)
        ]

    def _finding(self, part: _Part, located: Located) -> Finding:
        tried, prim, blame = self.sites.tried, located.prim, located.blame
        of, rule, problem, severity = part
        source = located.source
        if rule is not of and source.layer is not None:
            source = source._replace(subject=f"{of.code} {source.subject}".rstrip())
        beside = ""
        if blame.clip and blame.clip.rpartition("/")[2] not in problem.message:
            beside = f" (in the clip {quoted(blame.clip)})"
        elif blame.clean:
            beside = f" ({quoted(blame.clean)} by itself has no such problem)"
        own = rule.severity if problem.severity is None else min(rule.severity, problem.severity)
        cover = tried(prim, _REACH, cover_of, problem, blame, own) or Cover(own)
        absent = () if self._is_alone else tried(prim, _ABSENT, absent_of, problem)
        return Finding(  # by positions, because to name so many takes as long as to make it
            rule.code,
            rule.name,
            self._lowered(severity, problem, rule.code),
            shortened(problem.message + beside, _LONGEST),
            located.site,
            source,
            cover,
            problem.suggestion and shortened(problem.suggestion, _LONGEST_SUGGESTION),
            help_for(rule),
            None,
            problem.fold,
            absent or (),
            None,
            problem.since,
        )

    def _as_told(self, part: _Part, located: Located, finding: Finding) -> list[Stamped]:
        """The finding as it is told, with its identity if that will be asked for."""
        as_shown = self.sites.tried(located.prim, _SUPPRESSED, self._as_shown, finding, located)
        if as_shown is None:
            as_shown = [_shown_by(finding, located.instances)]
        holds = part.problem.holds
        if not self._several_selections:
            return [Stamped(shown, (), holds) for shown in as_shown]
        # Under a selection that the tool made, nobody looks for another one to blame.
        spec = located.blame.instead_of or located.blame.spec
        same = identity(part.rule, part.problem, spec)
        return [
            Stamped(shown, (*same, shown.ignored) if same and shown.ignored else same, holds)
            for shown in as_shown
        ]

    def _as_shown(self, finding: Finding, located: Located) -> list[Finding]:
        """The finding, or one for each reason why some of its instances are ignored."""
        if not self._asked.heeded:
            return [_shown_by(finding, located.instances)]
        prim = located.prim
        layer = None if finding.source.layer is None else located.layer
        if not is_in_prototype(prim):
            reason = self._suppressions.reason(prim, located.path, layer, finding.code)
            return [finding if reason is None else finding._replace(ignored=reason)]
        return [
            _shown_by(
                finding._replace(site=finding.site._replace(prim=share.path), ignored=share.reason),
                share.instances,
            )
            for share in self._suppressions.shares(prim, layer, finding.code)
        ]

    def _lowered(self, severity: Severity, problem: Problem | NotChecked, code: str) -> Severity:
        """The severity of a milder or younger case, unless the user chose one for the rule."""
        if self._active.is_younger(code, problem.since):
            return Severity.INFO
        milder = problem.severity
        if milder is None or code in self._active.chosen:
            return severity
        return min(severity, milder)


def _shown_by(finding: Finding, instances: int) -> Finding:
    if instances <= 1:
        return finding
    return finding._replace(message=f"{finding.message} (shown by {counted(instances)} instances)")
