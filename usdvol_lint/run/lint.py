"""Lints stages in worker processes, and makes one report on all of them."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Protocol

from usdvol_lint import __version__
from usdvol_lint.config import Config
from usdvol_lint.model import Report, StageReport
from usdvol_lint.packs.activation import ActiveRules, activate
from usdvol_lint.packs.catalog import load
from usdvol_lint.run.discovery import discover
from usdvol_lint.run.parts import without_completed
from usdvol_lint.run.pool import Pool
from usdvol_lint.run.protocol import Setup

if TYPE_CHECKING:
    from subprocess import Popen


_SHAPING = (
    *("options", "packs", "fail_on", "show"),
    *("load", "content", "variants", "variant_limit", "times", "timeout"),
)


class Progress(Protocol):
    """Shows how far a run is."""

    def begin(self, stages: int) -> None: ...
    def advance(self, samples: int) -> None: ...
    def stage_done(self) -> None: ...


class _Silent:
    def begin(self, stages: int) -> None: ...
    def advance(self, samples: int) -> None: ...
    def stage_done(self) -> None: ...


def lint(
    paths: Iterable[str],
    config: Config | Callable[[], Config] | None = None,
    progress: Progress | None = None,
    child: Popen[bytes] | None = None,
) -> Report:
    """Checks the stages at `paths`, files or folders.

    `config` may be a function: the first worker process then imports USD while it runs.
    `child` is that process, if it was started already.
    Raises UsageError for mistakes in the configuration; whatever is wrong with a stage is in the
    report.
    """
    began = time.perf_counter()
    pool = Pool(child)
    try:
        settled = config() if callable(config) else config or Config()
        active = activate(settled, load(settled.packs))
        stages = _run(pool, discover(paths), settled, active, progress or _Silent())
        return Report(
            version=__version__,
            usd_version=pool.usd_version,
            settings=settings_of(settled, active),
            stages=stages,
            seconds=time.perf_counter() - began,
        )
    finally:
        pool.close()


def _run(
    pool: Pool, paths: Iterable[str], config: Config, active: ActiveRules, progress: Progress
) -> tuple[StageReport, ...]:
    """The reports on stages, in their order."""
    futures = [pool.submit(path) for path in paths]
    for future in futures:
        future.add_done_callback(lambda _: progress.stage_done())
    progress.begin(len(futures))
    setup = Setup(active, config.packs, config.depth)
    pool.run(setup, config.jobs or os.cpu_count() or 1, config.timeout, progress.advance)
    stages = list(_without_repeated_faults(future.result() for future in futures))
    return tuple(without_completed(stages))


def _without_repeated_faults(stages: Iterable[StageReport]) -> Iterator[StageReport]:
    """A fault of a rule itself stays only in the report of the first stage that shows it."""
    reported: set[str] = set()
    for stage in stages:
        faulty = {finding.faulty_rule for finding in stage.findings if finding.faulty_rule}
        yield stage._replace(
            findings=tuple(each for each in stage.findings if each.faulty_rule not in reported)
        )
        reported |= faulty


def settings_of(config: Config, active: ActiveRules) -> dict[str, object]:
    """The settings that shape the findings, as reports and `--show-settings` print them."""
    chosen = config._asdict()
    return {
        "rules": {code: severity.label for code, severity in active.severities.items()},
        **{key: chosen[key] for key in _SHAPING},
    }
