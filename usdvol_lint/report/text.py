"""The report for people: by stage and prim, with a verdict in the last line."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby

from usdvol_lint.model import (
    Finding,
    ParticleFieldStats,
    Report,
    Severity,
    Site,
    StageReport,
    Status,
    Summary,
)
from usdvol_lint.report import Options
from usdvol_lint.report.figures import figures
from usdvol_lint.report.style import SEVERITY_STYLES, paint
from usdvol_lint.words import printable

_LONGEST_SUGGESTION = 400

# Text is wrapped between these words; what is in quotes is one, so that a path with spaces can be
# copied.
_WORD = re.compile(r"""(?<!\S)\(?(['"@]).*?\1\S*|\S+""")


def render(report: Report, options: Options) -> str:
    told = _told(report, options)
    blocks = [_stage(stage, options) for stage in told.stages if _is_shown(stage, options)]
    if not options.quiet:
        blocks.append(paint(verdict(report, options), _verdict_style(told), options.color) + "\n")
    return "\n".join(blocks)


def _told(report: Report, options: Options) -> Report:
    """The report without the findings that are only counted."""
    stages = (
        stage._replace(findings=tuple(filter(options.shows, stage.findings)))
        for stage in report.stages
    )
    return report._replace(stages=tuple(stages))


def verdict(report: Report, options: Options) -> str:
    """The result of the run in one line."""
    summary = _told(report, options).summary
    if not summary.stages:
        return "no stages checked"
    hidden = report.summary.infos - summary.infos
    parts = [_finding_counts(summary, "errors or warnings" if hidden else "findings")]
    if hidden:
        parts.append(f"{_count(hidden, 'info')}, shown with --show info")
    parts.append(f"{_checked_counts(summary.stats)} in {_duration(report.seconds)}")
    unchecked = summary.stages - summary.by_status.get(Status.CHECKED, 0)
    if unchecked:
        parts.append(f"{_count(unchecked, 'stage')} could not be checked")
    return "; ".join(parts)


def _finding_counts(summary: Summary, sought: str) -> str:
    if not summary.findings:
        return f"no {sought} in {_count(summary.stages, 'stage')}"
    counts = _counts(
        (summary.errors, "error"), (summary.warnings, "warning"), (summary.infos, "info")
    )
    of = f"{summary.stages_with_findings:,} of " if summary.stages > 1 else ""
    return f"{counts} in {of}{_count(summary.stages, 'stage')}"


def _checked_counts(stats: Mapping[str, int]) -> str:
    counts = _counts(
        (stats.get("volumes", 0), "volume"),
        (stats.get("particle_fields", 0), "particle field"),
        (stats.get("files_checked", 0), "file"),
    )
    if counts:
        return f"{counts} checked"
    others = stats.get("variant_selections", 0)
    if others:
        return (
            "no volumes or particle fields as variants are selected, "
            f"{_count(others, 'other selection')} checked"
        )
    return "no volumes or particle fields found"


def _verdict_style(report: Report) -> str:
    if any(stage.status != Status.CHECKED for stage in report.stages):
        return SEVERITY_STYLES[Severity.ERROR]
    severities = [finding.severity for stage in report.stages for finding in stage.findings]
    return SEVERITY_STYLES[max(severities)] if severities else "bold green"


def _is_shown(stage: StageReport, options: Options) -> bool:
    """Whether a stage has a section in the report."""
    if stage.findings or stage.status != Status.CHECKED:
        return True
    return (options.verbose or bool(stage.particle_fields)) and not options.quiet


def _stage(stage: StageReport, options: Options) -> str:
    found = {
        prim: list(findings)
        for prim, findings in groupby(sorted(stage.findings, key=_prim_of), key=_prim_of)
    }
    held = {} if options.quiet else {one.prim: one for one in stage.particle_fields or ()}
    groups = [
        _prim(prim, held.get(prim), found.get(prim, ()), options)
        for prim in sorted({*found, *held})
    ]
    if options.verbose:
        groups.append(_extras(stage, options))
    blocks = ("".join(f"{line}\n" for line in group) for group in groups)
    return _heading(stage, options) + "\n" + "\n".join(filter(None, blocks))


def _heading(stage: StageReport, options: Options) -> str:
    path = paint(printable(stage.path), "bold underline", options.color)
    if stage.status == Status.CHECKED:
        return path
    status = stage.status.replace("_", " ")
    return f"{path} {paint(f'({status})', SEVERITY_STYLES[Severity.ERROR], options.color)}"


def _prim_of(finding: Finding) -> str:
    return finding.site.prim or ""


def _prim(
    prim: str, holds: ParticleFieldStats | None, findings: Iterable[Finding], options: Options
) -> Iterator[str]:
    """What one prim holds and the findings on it; those on the stage itself have no heading."""
    if prim:
        yield "  " + paint(printable(prim), "bold", options.color)
    if holds:
        for label, figure in figures(holds):
            yield _labelled(label, figure, "dim", "    ", options)
    for finding in findings:
        yield from _finding(finding, "    " if prim else "  ", options)


def _finding(finding: Finding, indent: str, options: Options) -> Iterator[str]:
    label = f"{printable(finding.code)} {finding.severity.label}:"
    style = SEVERITY_STYLES[finding.severity]
    yield _labelled(label, printable(finding.message), style, indent, options)
    indent += "  "
    yield f"{indent}{paint('-->', 'blue', options.color)} {location(finding.site)}"
    if where := ", ".join(_where(finding.site)):
        yield _labelled("at", where, "blue", indent, options)
    if finding.suggestion:
        advice = finding.suggestion if options.verbose else _shortened(finding.suggestion)
        yield _labelled("help:", printable(advice), "green", indent, options)
    if options.verbose:
        yield _labelled("rule:", _rule(finding), "dim", indent, options)
        for line in (finding.detail or "").expandtabs().splitlines():
            yield f"{indent}| {printable(line)}".rstrip()


def _shortened(suggestion: str) -> str:
    """A long suggestion, such as a list of frames to paste, cut off between two of its items."""
    if len(suggestion) <= _LONGEST_SUGGESTION:
        return suggestion
    start = suggestion[:_LONGEST_SUGGESTION].rpartition(", ")[0]
    return f"{start}, … (--verbose shows all of it)" if start else suggestion


def location(site: Site) -> str:
    """`layer:line:column`, without those that are None."""
    parts = [printable(site.layer)]
    if site.line is not None:
        parts.append(str(site.line))
        if site.column is not None:
            parts.append(str(site.column))
    return ":".join(parts)


def _where(site: Site) -> Iterator[str]:
    """Property, variant and frames: what is neither in the heading nor in the location."""
    if site.property:
        yield printable(site.property)
    if site.variant:
        yield f"variant {printable(site.variant)}"
    if site.frames:
        several = len(site.times) > 1 or site.at_default
        yield f"{'frames' if several else 'frame'} {site.frames}"


def _rule(finding: Finding) -> str:
    return ", ".join(printable(part) for part in (finding.name, finding.help) if part)


def _extras(stage: StageReport, options: Options) -> Iterator[str]:
    """What `--verbose` adds to a stage."""
    stats = ", ".join(f"{printable(name)} {count:,}" for name, count in stage.stats.items())
    seconds = ", ".join(f"{printable(name)} {time:.3f}" for name, time in stage.seconds.items())
    if stats:
        yield _labelled("stats:", stats, "dim", "  ", options)
    if seconds:
        yield _labelled("seconds:", seconds, "dim", "  ", options)


def _labelled(label: str, text: str, style: str, indent: str, options: Options) -> str:
    """A styled label and its text, whose further lines are indented to the first."""
    # Without colour nothing is wrapped: the output goes to a file, a pipe or a log, where a line
    # break in a phrase would hide it from a search.
    lines = [text]
    hang = len(indent) + len(label) + 1
    if options.color:
        lines = list(_wrap(text, options.width - hang))
    return f"{indent}{paint(label, style, options.color)} " + f"\n{' ' * hang}".join(lines)


def _wrap(text: str, width: int) -> Iterator[str]:
    """Text in lines of at most `width` cells; a word that is longer has a line of its own."""
    from rich.cells import cell_len

    line = ""
    for word in (match.group() for match in _WORD.finditer(text)):
        longer = f"{line} {word}" if line else word
        if line and cell_len(longer) > width:
            yield line
            line = word
        else:
            line = longer
    yield line


def _counts(*numbers: tuple[int, str]) -> str:
    return ", ".join(_count(number, noun) for number, noun in numbers if number)


def _count(number: int, noun: str) -> str:
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def _duration(seconds: float) -> str:
    return f"{seconds:,.1f} s" if seconds >= 0.1 else f"{seconds:.2f} s"
