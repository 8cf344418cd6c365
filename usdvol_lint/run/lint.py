"""Lints stages in worker processes, and makes one report on all of them."""

from __future__ import annotations

import os
import re
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple, Protocol

from usdvol_lint import __version__
from usdvol_lint.config import Config
from usdvol_lint.model import Finding, StageReport
from usdvol_lint.packs.activation import ActiveRules, activate
from usdvol_lint.packs.catalog import load_for
from usdvol_lint.paths import below, canonical
from usdvol_lint.results import Cause, Report, RunInfo, StageResult
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.discovery import discover
from usdvol_lint.run.parts import completed_by
from usdvol_lint.run.pool import Pool
from usdvol_lint.run.protocol import Setup
from usdvol_lint.run.suppressing import in_stages, reasons

if TYPE_CHECKING:
    from subprocess import Popen

    from usdvol_lint.packs.catalog import Catalog
    from usdvol_lint.run.layer_levels import VerdictOn


_SHAPING = (
    *("options", "packs", "fail_on", "fail_on_unchecked", "show", "rules_as_of"),
    *("load", "content", "variants", "variant_limit", "times", "timeout", "suppressions"),
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
        root, versions, repository = naming(settled) if naming else Naming()
        catalog = load_for(settled)
        active = activate(settled, catalog)
        jobs = settled.jobs or os.cpu_count() or 1
        causes = _causes(settled, catalog, root, versions)
        named = tuple(paths)
        reports = stage_reports(pool, discover(named), settled, active, jobs, progress, repository)
        stages, found = _folded(causes, reports)
        report = Report(
            version=__version__,
            usd_version=pool.usd_version,
            settings=settings_of(settled, active),
            root=root,
            stages=stages,
            causes=(),
            run=RunInfo(seconds=time.perf_counter() - began, jobs=jobs),
            arguments=tuple(below(canonical(path), root) for path in named),
        )
        return report.with_causes(found)
    finally:
        pool.close()


def stage_reports(
    pool: Pool,
    paths: Iterable[str],
    config: Config,
    active: ActiveRules,
    jobs: int,
    progress: Progress | None = None,
    repository: str | None = None,
) -> Iterator[StageReport]:
    """The reports on stages, in their order, each as soon as it is there."""
    shown = progress or _Silent()
    futures = deque(pool.submit(path) for path in paths)
    for future in futures:
        future.add_done_callback(lambda _: shown.stage_done())
    shown.begin(len(futures))
    is_alone = len(futures) == 1
    setup = Setup(active, config.packs, config.depth, in_stages(config), is_alone, repository)
    pool.run(setup, jobs, config.timeout, shown.advance)
    while futures:
        yield futures.popleft().result()


def _folded(
    causes: Causes, reports: Iterable[StageReport]
) -> tuple[tuple[StageResult, ...], tuple[Cause, ...]]:
    """The stages and the causes; of the findings only those are kept that may be completed."""
    kept: list[StageReport] = []
    waiting: list[tuple[int, int, Finding]] = []
    for stage, report in enumerate(reports):
        numbered = list(enumerate(report.findings))
        causes.add(stage, report.path, (pair for pair in numbered if not pair[1].absent))
        absent = [(stage, *pair) for pair in numbered if pair[1].absent]
        waiting += absent
        kept.append(report._replace(findings=tuple(finding for *_, finding in absent)))
    is_completed = completed_by(kept)
    for stage, number, finding in waiting:
        if not is_completed(kept[stage], finding):
            causes.add(stage, kept[stage].path, [(number, finding)])
    found, numbers = causes.result()
    return tuple(causes.stage(*each, numbers) for each in enumerate(kept)), found


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
    return {
        "rules": {code: severity.label for code, severity in active.severities.items()},
        **{key: chosen[key] for key in _SHAPING},
        "suppress": [each.as_written() for each in config.suppress],
        "per_path": [each.as_written() for each in config.per_path],
    }
