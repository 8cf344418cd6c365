"""What a run came to, in one line, and what to type next."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence

from usdvol_lint.model import Severity, Status
from usdvol_lint.report import Options
from usdvol_lint.report.numbers import count, counts, duration
from usdvol_lint.results import BaselineUse, Report, RunInfo, State, Summary
from usdvol_lint.words import printable

MANY_CAUSES = 20
_MANY_PAIRS = 5
_BASELINE = "usdvol-lint-baseline.jsonl"
_LONGEST_COMMAND = 300
_OF_OUTPUT = frozenset(
    {"--output", "--output-format", "--show", "--color", "--max-places", "--summary"}
)


def verdict(report: Report, options: Options) -> str:
    """The result of the run in one line."""
    summary = report.summary
    if report.failure and not summary.stages:
        return f"nothing was checked: {printable(report.failure)}"
    if not summary.stages:
        return f"nothing to check: {report.nothing}" if report.nothing else "no stages checked"
    return "; ".join(_parts(report, summary, options))


def _parts(report: Report, summary: Summary, options: Options) -> Iterator[str]:
    if report.failure:
        yield printable(report.failure)
    unchecked = _unchecked(report, options)
    hidden = summary.infos - unchecked if options.threshold > Severity.INFO else 0
    yield _finding_counts(report, summary, options.threshold)
    if unchecked:
        yield f"{unchecked:,} not checked, which --fail-on-unchecked counts"
    if hidden:
        yield f"{count(hidden, 'info')}, shown with --show info"
    if uncounted := _uncounted(summary):
        yield uncounted
    if report.baseline:
        gone = unpruned(report, options)
        yield from (gone,) if gone else _baseline(report.baseline)
    if assumed := summary.stats.get("files_assumed"):
        yield f"{count(assumed, 'file')} assumed present"
    if report.left_out:
        yield report.left_out
    unread = summary.stages - summary.by_status.get(Status.CHECKED, 0)
    yield _checked(summary, unread, duration(report.run.seconds))
    if unread:
        yield f"{count(unread, 'stage')} could not be checked"


def _unchecked(report: Report, options: Options) -> int:
    """The number of infos that fail the run, because they say that something was not checked."""
    if not options.fail_on_unchecked:
        return 0
    return sum(each.is_unchecked and each.severity is Severity.INFO for each in report.causes)


def _finding_counts(report: Report, summary: Summary, threshold: Severity) -> str:
    numbers = [(summary.errors, "error"), (summary.warnings, "warning"), (summary.infos, "info")]
    found = counts(*(numbers[:2] if threshold > Severity.INFO else numbers))
    stages = _stage_counts(summary)
    if not found:
        sought = "errors or warnings" if threshold > Severity.INFO and summary.infos else "findings"
        return f"no {'new ' if State.KNOWN in summary.by_state else ''}{sought} in {stages}"
    if summary.stages == 1:
        return f"{found} in {stages}"
    if summary.parts:
        return f"{found} in {_stages_with(report, threshold):,} of {summary.stages:,}: {stages}"
    return f"{found} in {_stages_with(report, threshold):,} of {stages}"


def _stage_counts(summary: Summary) -> str:
    """`12 stages, 340 parts`: what is a part is not counted twice."""
    return counts((summary.stages - summary.parts, "stage"), (summary.parts, "part"))


def _stages_with(report: Report, threshold: Severity) -> int:
    return sum(
        any(number for level, number in stage.levels.items() if level >= threshold)
        for stage in report.stages
    )


def _uncounted(summary: Summary) -> str:
    """What is known or suppressed: `12 known, 2 suppressed`."""
    states = (State.KNOWN, State.SUPPRESSED)
    return ", ".join(
        f"{summary.by_state[state]:,} {state}" for state in states if state in summary.by_state
    )


def _baseline(use: BaselineUse) -> Iterator[str]:
    if use.written:
        without = f", without {len(use.gone):,} that {_are_gone(use.gone)}" if use.gone else ""
        yield f"{count(use.entries, 'entry')} written to {printable(use.path)}{without}"
    elif use.gone:
        entries, them = count(len(use.gone), "entry"), "it" if len(use.gone) == 1 else "them"
        yield f"{entries} of the baseline {_are_gone(use.gone)}: --prune-baseline removes {them}"


def unpruned(report: Report, options: Options) -> str:
    """What is gone from the baseline where that fails the run; empty where it does not."""
    use = report.baseline
    if not (options.fail_on_unpruned and use and use.is_unpruned):
        return ""
    return f"{next(_baseline(use))}, which --fail-on-unpruned counts"


def _are_gone(entries: Sequence[str]) -> str:
    return "is gone" if len(entries) == 1 else "are gone"


def _checked(summary: Summary, unread: int, seconds: str) -> str:
    """What was checked, and how long that took; where stages were not read, nothing is denied."""
    if found := _checked_counts(summary.stats):
        return f"{found} in {seconds}"
    if unread == summary.stages:
        which = "the stage was not" if unread == 1 else "no stage was"
        return f"nothing counted in {seconds}, since {which} read to its end"
    where = f" in {summary.stages - unread:,} of {_stage_counts(summary)}" if unread else ""
    return f"no volumes or particle fields found{where} in {seconds}"


def _checked_counts(stats: Mapping[str, int]) -> str:
    found = counts(
        (stats.get("volumes", 0), "volume"),
        (stats.get("particle_fields", 0), "particle field"),
        (stats.get("files_checked", 0), "file"),
    )
    if found:
        return f"{found} checked"
    others = stats.get("variant_selections", 0)
    if others:
        return (
            "no volumes or particle fields as variants are selected, "
            f"{count(others, 'other selection')} checked"
        )
    return ""


# --- what to type next ----------------------------------------------------------------------------


def advice(report: Report, options: Options) -> Iterator[str]:
    """The lines below the verdict."""
    verbose = options.verbose
    if verbose:
        yield _configuration(report.run)
    if report.baseline:
        yield from _moved(report.baseline.moved, verbose)
        if verbose:
            yield from _gone(report.baseline)
    elif _may_adopt(report):
        yield f"adopt them with: {_again(report, '--write-baseline', _BASELINE)}"
    if not options.summary and sum(map(options.shows, report.causes)) > MANY_CAUSES:
        command = _again(report, "--summary", "stage")
        yield f"the numbers alone, by rule, cause, stage or asset: {command}"


def _again(report: Report, *added: str) -> str:
    """The command of the run with other options than those about the report."""
    said = _typed(("usdvol-lint", *added, *_kept(report.run.command)))
    if len(said) > _LONGEST_COMMAND:
        return f"{_typed(('usdvol-lint', *added))} and the same arguments"
    return said


def _configuration(run: RunInfo) -> str:
    """Which configuration file was used."""
    extended = f", which extends {', '.join(run.config_extends)}" if run.config_extends else ""
    return f"configuration: {printable((run.config_file or 'none') + extended)}"


def _kept(command: Sequence[str]) -> Iterator[str]:
    """The arguments of a command without those that say how a report is written."""
    arguments = iter(command[1:])
    for each in arguments:
        name, equals, _ = each.partition("=")
        if name not in _OF_OUTPUT:
            yield each
        elif not equals:
            next(arguments, None)


def _moved(pairs: Sequence[tuple[str, str]], verbose: bool) -> Iterator[str]:
    told = pairs if verbose else pairs[:_MANY_PAIRS]
    for old, new in told:
        option = f"--moved {_typed([f'{old}={new}'])}"
        yield (
            f"as many entries are gone in {printable(old)} as are new in {printable(new)}: "
            f"if it moved there, add {option}"
        )
    if len(told) < len(pairs):
        yield f"… and {count(len(pairs) - len(told), 'pair')} more, told with --verbose"


def _gone(use: BaselineUse) -> Iterator[str]:
    if use.gone is None:
        yield f"what is gone from the baseline is not known: {printable(use.partial)}"
    for entry in use.gone or ():
        yield f"gone from the baseline: {printable(entry)}"


def _may_adopt(report: Report) -> bool:
    """Whether somebody who wants to begin has more before them than can be mended today."""
    summary = report.summary
    asked_for_none = "--no-baseline" in report.run.command
    return summary.errors + summary.warnings > MANY_CAUSES and not asked_for_none


def _typed(arguments: Sequence[str]) -> str:
    """Arguments as a shell takes them."""
    if os.name == "nt":
        from subprocess import list2cmdline  # costs start-up time, and few runs say this

        return printable(list2cmdline(arguments))
    from shlex import join

    return printable(join(arguments))
