"""What a run came to: causes, each told once, and the stages that show them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import NamedTuple

from usdvol_lint.model import (
    Completion,
    Cover,
    Finding,
    ParticleFieldStats,
    Severity,
    Source,
    Status,
)

UNCHECKED = frozenset({"LNT004", "LNT005", "AST010", "STG001", "STG004"})
"""The codes that say that something was not checked, whatever else they say of it."""


class State(StrEnum):
    """What a cause is beside the baseline in use: `known` is in it, `worse` goes beyond it.

    `suppressed` is what a suppression with a reason takes out of the run.
    """

    NEW = "new"
    WORSE = "worse"
    KNOWN = "known"
    SUPPRESSED = "suppressed"

    @property
    def counts(self) -> bool:
        """Whether it is in the verdict and the exit code."""
        return self in (State.NEW, State.WORSE)


class Place(NamedTuple):
    """Where a cause shows: the number of the stage in the run, and how it looks there."""

    stage: int
    finding: Finding


class Cause(NamedTuple):
    """One thing to mend, whatever number of stages, instances and variants show it.

    `source` is what is to blame, with the layer as fingerprints have it: in relation to the root.
    `severity` is the worst of all places, `cover` joins theirs; `places` are the first ones,
    `count` is the number of all, and `here` that of those on the first stage.
    `was` is what the baseline has, where that is less; `reason` is why the first of its places is
    suppressed, if all are: each has its own.
    """

    fingerprint: str
    severity: Severity
    source: Source
    cover: Cover
    places: tuple[Place, ...]
    count: int  # type: ignore[assignment]  # hides tuple.count
    state: State = State.NEW
    was: Cover | None = None
    reason: str | None = None
    here: int = 1

    @property
    def first(self) -> Finding:
        """How it looks at the first of its places."""
        return self.places[0].finding

    @property
    def code(self) -> str:
        return self.first.code

    @property
    def name(self) -> str:
        return self.first.name

    @property
    def is_unchecked(self) -> bool:
        """Whether it counts, and says that something was not checked."""
        return self.state.counts and self.code in UNCHECKED


class StageResult(NamedTuple):
    """What came of one stage.

    `path` is the stage as the user named it or as it was found in a folder; of what is only a
    `part` of others, nothing counts for being absent.
    `completes` names layers as `source` of causes does, but for versions, which stay apart.
    `causes` are the numbers of the causes that it shows, ascending, and `worst` how bad each is
    here, None where a suppression takes it out; `levels` are the numbers of causes by level as
    this stage has them, without what is known or suppressed.
    """

    path: str
    status: Status
    stats: Mapping[str, int] = {}
    seconds: Mapping[str, float] = {}
    particle_fields: tuple[ParticleFieldStats, ...] | None = None
    completes: Completion | None = None
    causes: tuple[int, ...] = ()
    worst: tuple[Severity | None, ...] = ()
    levels: Mapping[Severity, int] = {}
    part: bool = False

    def judged(
        self, causes: Sequence[Cause], equal: dict[object, Mapping[Severity, int]] | None = None
    ) -> StageResult:
        """The same with the levels that follow from the states of the causes.

        What is `equal` to the levels of another stage is shared with it.
        """
        if not (self.causes or self.levels):
            return self
        shown = zip(self.causes, self.worst, strict=True)
        counted = [level for number, level in shown if level and causes[number].state.counts]
        levels = {level: counted.count(level) for level in sorted(set(counted))}
        shared = {} if equal is None else equal
        return self._replace(levels=shared.setdefault(tuple(levels.items()), levels))


class Summary(NamedTuple):
    """Counts over all stages; causes that are known or suppressed are in `by_state` alone.

    `parts` are those of the stages that are declared to be only parts of others.
    """

    stages: int
    errors: int
    warnings: int
    infos: int
    by_code: dict[str, int]
    by_state: dict[str, int]
    by_status: dict[str, int]
    stats: dict[str, int]
    stages_with_findings: int
    parts: int = 0

    @property
    def findings(self) -> int:
        return self.errors + self.warnings + self.infos


class BaselineUse(NamedTuple):
    """The baseline that a run was compared with, or wrote.

    `gone` are the entries that nothing matches any more, in words, or None where the run does not
    cover what the baseline does, so that nobody can say; `partial` then says what is lacking.
    Where the file was `written`, what is gone is no longer in it.
    `moved` are pairs of places in which as many entries are gone as are new elsewhere.
    """

    path: str
    entries: int
    gone: tuple[str, ...] | None = None
    partial: str = ""
    moved: tuple[tuple[str, str], ...] = ()
    written: bool = False

    @property
    def is_unpruned(self) -> bool:
        """Whether the file has entries that are gone."""
        return bool(self.gone) and not self.written


class RunInfo(NamedTuple):
    """What may differ between equal runs.

    `config_extends` are the files that the configuration file extends, the nearest first.
    `usd_said` is what USD said of its own plugins, which is about no stage.
    """

    date: str = ""
    command: tuple[str, ...] = ()
    config_file: str | None = None
    seconds: float = 0.0
    jobs: int = 1
    config_extends: tuple[str, ...] = ()
    usd_said: tuple[str, ...] = ()


class Report(NamedTuple):
    """The result of a run: all that the output formats print.

    `root` is the folder that layers go by in fingerprints; None where they go by absolute path.
    `arguments` are the files and folders that the run was asked to check, named as layers are.
    `left_out` says, where the run looks at what changed, what it therefore did not check, and
    `nothing` why there was no stage at all.
    `failure` says why the run could not do its job, where that is no finding: then a report has
    what was found until then, most often nothing.
    `interrupted` is the number of the signal that ended it before its time, 0 if none did.
    """

    version: str
    usd_version: str | None
    settings: Mapping[str, object]
    root: str | None
    stages: tuple[StageResult, ...]
    causes: tuple[Cause, ...]
    run: RunInfo
    baseline: BaselineUse | None = None
    arguments: tuple[str, ...] = ()
    failure: str = ""
    left_out: str = ""
    nothing: str = ""
    interrupted: int = 0

    def with_causes(self, causes: Sequence[Cause]) -> Report:
        """The same with other states of its causes, whose number and order stay."""
        equal: dict[object, Mapping[Severity, int]] = {}
        stages = tuple(stage.judged(causes, equal) for stage in self.stages)
        return self._replace(causes=tuple(causes), stages=stages)

    @property
    def summary(self) -> Summary:
        counted = [cause for cause in self.causes if cause.state.counts]
        severities = Counter(cause.severity for cause in counted)
        stats: Counter[str] = Counter()
        for stage in self.stages:
            stats.update(stage.stats)
        return Summary(
            stages=len(self.stages),
            errors=severities[Severity.ERROR],
            warnings=severities[Severity.WARNING],
            infos=severities[Severity.INFO],
            by_code=dict(sorted(Counter(cause.code for cause in counted).items())),
            by_state=dict(sorted(Counter(str(cause.state) for cause in self.causes).items())),
            by_status=dict(sorted(Counter(str(stage.status) for stage in self.stages).items())),
            stats=dict(sorted(stats.items())),
            stages_with_findings=sum(1 for stage in self.stages if stage.levels),
            parts=sum(stage.part for stage in self.stages),
        )
