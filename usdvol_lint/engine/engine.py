"""Lints one stage: opens it, checks it, and reports on it whatever happens."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from itertools import chain

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.config import Depth
from usdvol_lint.engine.alone import Alone
from usdvol_lint.engine.asked_types import idle_rules
from usdvol_lint.engine.assign import Assignment
from usdvol_lint.engine.check import StageCheck
from usdvol_lint.engine.failures import still_holding, unreadable
from usdvol_lint.engine.lockstep import Course, Steps, take
from usdvol_lint.engine.opening import Watch
from usdvol_lint.engine.pieces import Pieces
from usdvol_lint.engine.stage import open_stage
from usdvol_lint.engine.stamp import Stamp, Stamped
from usdvol_lint.engine.trouble import UnreadableStageError, report_trouble
from usdvol_lint.engine.variants import OtherSelections
from usdvol_lint.facts import Context, Facts, Walked
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.folders import Folders
from usdvol_lint.facts.grids.known import KnownContents
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.layertext.source import SharedTexts
from usdvol_lint.model import Completion, Finding, StageReport, Status, in_order
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.paths import named
from usdvol_lint.rule import Rule
from usdvol_lint.suppressions import InStages

_COMPLETED = "what the stage completes of others"
_SENT_AT_ONCE = 10
"""From this many findings on they are sent in batches."""


def _ignore(message: object) -> None:
    pass


class Engine:
    """Lints stages, one after the other, with the same rules.

    `depth` says how much of each stage is checked, `suppressions` how those in it are taken.
    `advance` is called with the number of samples of a long sequence that were read since the last
    call, `send` with new findings, so that they are not lost if the process dies.
    `is_alone` says that there is but one stage, which no other may complete.
    `repository` is a folder whose host is to show findings: see `Sites`.
    `give_up` is called with the report on a stage that USD would compose without end: in another
    thread, while one waits for that, so it ends the process.
    USD's own warnings go to standard error, which in a worker process is a pipe to its parent.
    """

    def __init__(
        self,
        rules: Mapping[str, Rule],
        active: ActiveRules,
        depth: Depth | None = None,
        advance: Callable[[int], None] = _ignore,
        send: Callable[[list[Finding]], None] = _ignore,
        is_alone: bool = False,
        suppressions: InStages | None = None,
        repository: str | None = None,
        give_up: Callable[[StageReport], None] | None = None,
    ) -> None:
        self._watch = Watch(give_up) if give_up else None
        self._known = rules
        self._suppressions = suppressions or InStages()
        self._rules = [rules[code] for code in sorted({*active.severities, *active.watching})]
        self._active = active
        self._telling = active.telling
        self._idle = tuple(idle_rules(self._rules))
        self._assignment = Assignment(self._rules, active.options)
        self._depth = depth or Depth()
        self._advance = advance
        self._send = send
        self._is_alone = is_alone
        self._repository = repository
        self._texts = SharedTexts()
        self._known_contents = KnownContents()
        self._folders = Folders()
        if self._depth.storage.search_path:
            from usdvol_lint.engine.search_path import set_search_path

            set_search_path(self._depth.storage.search_path)

    def lint(self, path: str, answer: Callable[[StageReport], None] = _ignore) -> StageReport:
        """The report on one stage; never raises for what the stage holds or a rule does.

        `answer` is called with it before the stage is let go, which for a large one takes a while.
        """
        reports: list[StageReport] = []

        def take_over(report: StageReport) -> None:
            reports.append(report)
            answer(report)

        self.lint_together((path,), take_over)
        return reports[0]

    def lint_together(
        self,
        paths: Iterable[str],
        answer: Callable[[StageReport], object],
        parted: Callable[[], object] = lambda: None,
    ) -> None:
        """Lints stages that are probably small side by side; `answer` gets the reports in order.

        `parted` is called where they go on one after the other, since one takes long.
        """
        self._known_contents.begin()
        take(map(self._course, paths), answer, parted)

    def _course(self, path: str) -> Course:
        course = Course(path, self._send)
        course.begin(self._steps(course))
        return course

    def _steps(self, course: Course) -> Steps:
        """Lints one stage in steps."""
        path, clock = course.path, course.clock
        try:
            session = Sdf.Layer.CreateAnonymous() if self._depth.selections else None
            stage = open_stage(path, self._depth.load, session, self._watch)
        except UnreadableStageError as error:
            trouble = error.trouble
            stage = None
        clock.lap("open")
        if stage is None:
            yield report_trouble(path, trouble, seconds=clock.seconds)
            return
        yield None
        context = Context.of(
            stage,
            self._depth,
            self._known_contents,
            self._folders,
            self._advance,
            self._telling,
        )
        found: list[Stamped] = []
        try:
            yield from self._checked(course, context, found)
            return
        except UNREADABLE as error:  # where no rule was asked that would have reported it
            trouble = unreadable(error)
        clock.lap("check")
        others = (finding for finding in _still(found) if finding.message != trouble.message)
        yield report_trouble(path, trouble, seconds=clock.seconds, found=others)

    def _checked(self, course: Course, context: Context, found: list[Stamped]) -> Steps:
        """The report on a stage that opens; what is found until USD raises is in `found`."""
        depth, clock = self._depth, course.clock
        stamp = self._stamp(course.path, context)
        options = self._active.options
        check = StageCheck(context, self._rules, options, self._assignment, stamp, course.broken)
        walked = check.walk()
        clock.lap("walk")
        yield None
        facts = check.facts(walked)
        told = partial(_told, course, found)
        yield from told(chain(check.usd_version(facts), check.idle(facts, self._idle)))
        yield from told(check.selection(walked, facts))
        completes = stamp.sites.tried(context.stage.GetPseudoRoot(), _COMPLETED, _completion, facts)
        yield from told(check.faults())
        stats = _stats(walked, facts, context.disk)
        particle_fields = facts.particles.statistics() if depth.statistics else None
        if depth.selections:
            clock.lap("check")
            others = OtherSelections(context.stage, context.kinds, depth.selections)
            known = {stamped.identity for stamped in found}
            yield from told(check.others(others, known))
            stats["variant_selections"] = others.composed
            clock.lap("variants")
        findings = in_order(_still(found))
        clock.lap("check")
        yield StageReport(
            named(course.path),
            Status.CHECKED,
            stats,
            findings,
            clock.seconds,
            particle_fields,
            completes,
        )

    def _stamp(self, path: str, context: Context) -> Stamp:
        alone = Alone(context, self._assignment.asked_for, self._active.options)
        return Stamp(
            self._active,
            self._depth.selections > 0,
            self._known,
            self._suppressions,
            self._is_alone,
            self._repository,
            path,
            self._texts,
            Pieces(alone),
        )


def _told(course: Course, found: list[Stamped], new: Iterable[Stamped | None]) -> Iterator[None]:
    """Sends findings in batches, because a message for each is slow; None where there is a step.

    At most a twentieth of many is ever unsent, and so lost if the process dies.
    """
    unsent: list[Finding] = []
    number = 0
    for stamped in new:
        if stamped is None:
            yield None
            continue
        found.append(stamped)
        unsent.append(stamped.finding)
        if number < _SENT_AT_ONCE or 20 * len(unsent) > number:
            course.send(unsent)
            unsent = []
        number += 1
    if unsent:
        course.send(unsent)


def _completion(facts: Facts) -> Completion | None:
    """What the stage completes; None if nothing."""
    if not facts.layers.are_several:
        return None  # and the module need not be imported
    from usdvol_lint.engine.completions import completion

    return completion(facts)


def _still(found: Iterable[Stamped]) -> Iterator[Finding]:
    return chain.from_iterable(map(still_holding, found))


def _stats(walked: Walked, facts: Facts, disk: Disk) -> dict[str, int]:
    assumed = len(disk.storage.assumed)
    return {
        "prims": walked.prims,
        "volumes": len(facts.prims.of(schema.VOLUME)),
        "fields": len(facts.prims.of(schema.FIELD)),
        "particle_fields": len(facts.prims.of(schema.PARTICLE_FIELD)),
        "files_checked": disk.checked,
        **({"files_assumed": assumed} if assumed else {}),
    }
