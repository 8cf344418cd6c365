"""Lints stages in worker processes, and makes one report on all of them."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias

from usdvol_lint import __version__
from usdvol_lint.config import Config
from usdvol_lint.files import Changes
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import ActiveRules, activate
from usdvol_lint.packs.catalog import Catalog, load_for
from usdvol_lint.paths import below, canonical
from usdvol_lint.results import Report, RunInfo, StageResult
from usdvol_lint.run.ahead import Ahead
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.chosen import Chosen, choose
from usdvol_lint.run.folding import folded
from usdvol_lint.run.interruption import Interruption, name_of
from usdvol_lint.run.pool import InterruptedRunError, Pool
from usdvol_lint.run.processors import owned
from usdvol_lint.run.protocol import Setup
from usdvol_lint.run.suppressing import in_stages, reasons
from usdvol_lint.run.teller import Teller
from usdvol_lint.words import format_time

if TYPE_CHECKING:
    from subprocess import Popen

    from usdvol_lint.run.layer_levels import VerdictOn


_Judged: TypeAlias = tuple[StageReport, bool]
"""The report on a stage, and whether this is a part."""

_FEW = 16
"""Of more stages than that most are probably small."""
_SHAPING = (
    *("options", "packs", "fail_on", "fail_on_unchecked", "show", "rules_as_of", "load", "content"),
    *("variants", "variant_limit", "times", "timeout", "memory_limit", "suppressions"),
)


class Progress(Protocol):
    """Shows how far a run is."""

    def begin(self, stages: int) -> None: ...
    def advance(self, samples: int) -> None: ...
    def stage_done(self) -> None: ...
    def awaits(self, path: str, number: int) -> None: ...


class _Silent:
    def begin(self, stages: int) -> None: ...
    def advance(self, samples: int) -> None: ...
    def stage_done(self) -> None: ...
    def awaits(self, path: str, number: int) -> None: ...


class Naming(NamedTuple):
    """How layers are named in fingerprints: see `Causes`; and for a code host: see `Setup`."""

    root: str | None = None
    versions: re.Pattern[str] | None = None
    repository: str | None = None


def lint(
    paths: Iterable[str],
    config: Config | Callable[[], Config] | None = None,
    progress: Progress | None = None,
    child: Popen[bytes] | None = None,
    naming: Callable[[Config], Naming] | None = None,
    changes: Callable[[Config], Changes | None] = lambda config: None,
    interruption: Interruption | None = None,
    teller: Teller | None = None,
) -> Report:
    """Checks the stages at `paths`: files, folders or patterns.

    `config` may be a function: the first worker process then imports USD while it runs.
    `child` is that process, if it was started already.
    Where there are `changes`, only stages that use one of the files are checked.
    After an `interruption` the report is on the stages that were done until then.
    The `teller` hears of each stage as soon as all before it are done.
    Raises UsageError for mistakes in the configuration and the arguments; whatever is wrong with a
    stage is in the report.
    """
    began = time.perf_counter()
    pool = Pool(child)
    try:
        settled = config() if callable(config) else _given(config or Config())
        named = naming(settled) if naming else Naming()
        run = _Run(pool, settled, named, progress, interruption or Interruption(), teller)
        return run.report(tuple(paths), changes(settled), began)
    finally:
        pool.close()


class _Run(NamedTuple):
    """What checks the stages of one run, and how."""

    pool: Pool
    config: Config
    naming: Naming
    progress: Progress | None
    interruption: Interruption
    teller: Teller | None

    def report(self, paths: tuple[str, ...], changed: Changes | None, began: float) -> Report:
        """The report on the stages at these paths."""
        config, naming = self.config, self.naming
        catalog = load_for(config)
        active = activate(config, catalog)
        jobs = config.jobs or owned()
        causes = _causes(config, catalog, naming.root, naming.versions)
        chosen = choose(paths, config, changed)
        judged = self._begun(self._judged(chosen, active, jobs), active, chosen)
        stages, found = folded(causes, judged, bool(config.stages), self.teller)
        left_out, nothing = chosen.left_out(stages)
        report = self._head(active, chosen, stages)._replace(
            stages=stages,
            run=RunInfo(seconds=time.perf_counter() - began, jobs=jobs, usd_said=self.pool.said),
            left_out=left_out,
            nothing=nothing,
        )
        return self._ended(report.with_causes(found), chosen)

    def _head(
        self, active: ActiveRules, chosen: Chosen, stages: Sequence[StageResult] = ()
    ) -> Report:
        """What is known before the first stage; after a run over what changed, of these stages."""
        root = self.naming.root
        return Report(
            version=__version__,
            usd_version=self.pool.usd_version or None,
            settings=settings_of(self.config, active),
            root=root,
            stages=(),
            causes=(),
            run=RunInfo(),
            arguments=chosen.looked_at(stages, root),
        )

    def _begun(
        self, judged: Iterable[_Judged], active: ActiveRules, chosen: Chosen
    ) -> Iterator[_Judged]:
        """The same; the teller hears that the run began once a process looks at stages."""
        for number, each in enumerate(judged):
            if self.teller is not None and not number:
                self.teller.begin(self._head(active, chosen))
            yield each

    def _judged(self, chosen: Chosen, active: ActiveRules, jobs: int) -> Iterator[_Judged]:
        """The reports on the stages that use what changed, each with whether it is on a part."""
        stages = chosen.listing.stages
        reports = stage_reports(
            self.pool,
            (stage.path for stage in stages),
            self.config,
            active,
            jobs,
            self.progress,
            self.naming.repository,
            chosen.changed_files,
            self.interruption,
        )
        for stage, report in zip(stages, reports, strict=True):
            if report and not report.is_unchanged:
                yield report, stage.is_part

    def _ended(self, report: Report, chosen: Chosen) -> Report:
        """The same, which says so if the run ended before its time."""
        number = self.interruption.number
        if not self.interruption.is_early:
            return report
        done, every = len(report.stages), len(chosen.listing.stages)
        return report._replace(
            interrupted=number,
            failure=f"interrupted by {name_of(number)} after {done:,} of {every:,} "
            f"stage{'' if every == 1 else 's'}",
            left_out="",
            nothing="",
            arguments=tuple(below(canonical(stage.path), report.root) for stage in report.stages),
        )


def stage_reports(
    pool: Pool,
    paths: Iterable[str],
    config: Config,
    active: ActiveRules,
    jobs: int,
    progress: Progress | None = None,
    repository: str | None = None,
    changed: frozenset[str] | None = None,
    interruption: Interruption | None = None,
) -> Iterator[StageReport | None]:
    """The reports on stages, in their order, each as soon as it is there.

    None stands for a stage that an interruption left out.  So many at most as
    `ahead.MOST_AHEAD` says are looked at before that.
    """
    shown = progress or _Silent()
    every = tuple(paths)
    if not every:
        return
    ahead = Ahead(pool, every, shown.stage_done)
    shown.begin(len(every))
    setup = _setup(config, active, len(every), repository, changed)
    pool.run(setup, jobs, config.timeout, shown.advance, config.memory_limit)
    signals = interruption or Interruption()
    signals.stops(pool.interrupt)
    for number, path in enumerate(every):
        shown.awaits(path, number)
        try:
            yield ahead.next()
        except InterruptedRunError:
            signals.is_early = True
            yield None
    signals.hold()


def _setup(
    config: Config,
    active: ActiveRules,
    stages: int,
    repository: str | None,
    changed: frozenset[str] | None,
) -> Setup:
    return Setup(
        active,
        config.packs,
        config.depth,
        in_stages(config),
        is_alone=stages == 1 and not config.stages,
        are_many=stages > _FEW,
        repository=repository,
        changed=changed,
    )


def _given(config: Config) -> Config:
    from usdvol_lint.config.given import checked  # the command line has checked its own

    return checked(config)


def _causes(
    config: Config, catalog: Catalog, root: str | None, versions: re.Pattern[str] | None
) -> Causes:
    """No causes yet, and how findings become some."""
    taken_out = reasons(config, catalog, root)
    return Causes(root, versions, config.max_places, taken_out, _verdicts(config, catalog))


def _verdicts(config: Config, catalog: Catalog) -> VerdictOn | None:
    if not config.per_path:
        return None
    from usdvol_lint.run.layer_levels import verdicts  # few configurations say any

    return verdicts(config, catalog)


def settings_of(config: Config, active: ActiveRules) -> dict[str, object]:
    """The settings that shape the findings, as reports and `--show-settings` print them."""
    chosen = config._asdict()
    frames = config.frames and "-".join(map(format_time, config.frames))
    return {
        "rules": {code: severity.label for code, severity in active.severities.items()},
        **{key: chosen[key] for key in _SHAPING},
        "suppress": [each.as_written() for each in config.suppress],
        "per_path": [each.as_written() for each in config.per_path],
        "exclude": [glob.pattern for glob in config.exclude],
        "stages": [glob.pattern for glob in config.stages],
        "frames": frames,
        **{key: chosen[key] for key in ("search_path", "assume_present", "path_map")},
    }
