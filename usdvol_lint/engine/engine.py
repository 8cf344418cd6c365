"""A path and rules become a report on one stage, whatever the stage holds and a rule does."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.config import Depth
from usdvol_lint.engine.check import StageCheck
from usdvol_lint.engine.stage import open_stage
from usdvol_lint.engine.stamp import Found, Stamp
from usdvol_lint.engine.trouble import UnreadableStageError, report_trouble
from usdvol_lint.engine.variants import OtherSelections
from usdvol_lint.engine.walk import Walk
from usdvol_lint.facts import Context, Facts
from usdvol_lint.model import Finding, StageReport, Status, with_fingerprints
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.paths import display
from usdvol_lint.rule import Rule
from usdvol_lint.volumefile.cache import VolumeFiles

_TOLD_AT_ONCE = 100


def _ignore(told: object) -> None:
    pass


class Engine:
    """Lints stages, one after the other, with the same rules.

    `depth` says how much of each stage is looked at.
    `advance` is told how many samples of a long sequence were read since it was last told, `tell`
    what was found meanwhile, so that it is not lost whatever becomes of the stage.
    USD's own warnings go to standard error, which in a worker process is the parent's to read.
    """

    def __init__(
        self,
        rules: Mapping[str, Rule],
        active: ActiveRules,
        depth: Depth | None = None,
        advance: Callable[[int], None] = _ignore,
        tell: Callable[[list[Finding]], None] = _ignore,
    ) -> None:
        self._rules = [rules[code] for code in active.severities]
        self._active = active
        self._depth = depth or Depth()
        self._advance = advance
        self._tell = tell
        self._volume_files = VolumeFiles()

    def lint(self, path: str) -> StageReport:
        """Everything there is to say of one stage; never raises for what the stage holds."""
        clock = _Stopwatch()
        try:
            session = Sdf.Layer.CreateAnonymous() if self._depth.selections else None
            stage = open_stage(path, self._depth.load, session)
        except UnreadableStageError as error:
            clock.lap("open")
            return report_trouble(path, error.trouble, seconds=clock.seconds)
        clock.lap("open")
        context = Context.of(stage, self._depth, self._volume_files, self._advance)
        return self._report(path, context, clock)

    def _report(self, path: str, context: Context, clock: _Stopwatch) -> StageReport:
        depth = self._depth
        stamp = Stamp(self._active.severities, several_selections=depth.selections > 0)
        check = StageCheck(context, self._rules, self._active.options, stamp)
        walked = check.walk()
        clock.lap("walk")
        facts = check.facts(walked)
        found = list(self._told(check.usd(facts)))
        found += self._told(check.selection(walked, facts))
        stats = _stats(walked, facts, context.disk.checked)
        particle_fields = facts.particles.statistics() if depth.statistics else None
        if depth.selections:
            clock.lap("check")
            others = OtherSelections(context.stage, context.kinds, depth.selections)
            found += self._told(check.others(others, {each.identity for each in found}))
            stats["variant_selections"] = others.composed
            clock.lap("variants")
        findings = with_fingerprints(
            each.finding for each in found if not each.holds or each.holds()
        )
        clock.lap("check")
        return StageReport(
            display(path), Status.CHECKED, stats, findings, clock.seconds, particle_fields
        )

    def _told(self, found: Iterable[Found]) -> Iterator[Found]:
        """Tells findings in batches: one message each is slow.

        If the process dies, up to a tenth of many may be untold.
        """
        untold: list[Finding] = []
        for number, each in enumerate(found):
            untold.append(each.finding)
            if number < _TOLD_AT_ONCE or 10 * len(untold) > number:
                self._tell(untold)
                untold = []
            yield each
        if untold:
            self._tell(untold)


@dataclass(slots=True)
class _Stopwatch:
    """Wall-clock seconds by phase."""

    seconds: dict[str, float] = field(default_factory=dict)
    _since: float = field(default_factory=time.perf_counter)

    def lap(self, phase: str) -> None:
        now = time.perf_counter()
        self.seconds[phase] = self.seconds.get(phase, 0.0) + now - self._since
        self._since = now


def _stats(walked: Walk, facts: Facts, files_checked: int) -> dict[str, int]:
    return {
        "prims": walked.prims,
        "volumes": len(facts.prims.of(schema.VOLUME)),
        "fields": len(facts.prims.of(schema.FIELD)),
        "particle_fields": len(facts.prims.of(schema.PARTICLE_FIELD)),
        "files_checked": files_checked,
    }
