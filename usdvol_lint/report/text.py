"""The report for people: by stage and prim, with a verdict at its end."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from itertools import groupby

from usdvol_lint.model import Finding, ParticleFieldStats, Severity, Site, Status
from usdvol_lint.report import Options
from usdvol_lint.report.figures import figures
from usdvol_lint.report.numbers import counts
from usdvol_lint.report.staged import Staged
from usdvol_lint.report.style import SEVERITY_STYLES, paint
from usdvol_lint.report.table import Line, elsewhere, line_of, table
from usdvol_lint.report.telling import Told, message, on_this_stage, remarks, variant_and_frames
from usdvol_lint.report.verdict import MANY_CAUSES, advice, unpruned, verdict
from usdvol_lint.report.width import cells, wrap
from usdvol_lint.results import Report, StageResult
from usdvol_lint.words import printable

_LONGEST_SUGGESTION = 400
_FEW_STAGES = 20
"""So many stages are worth waiting for: what is absent on one is known once all were seen."""


class Full(Staged):
    """By stage and prim, each stage as soon as it is known; where else it shows comes last.

    Of a few stages nothing is told before all of them are known, so that each has one section.
    """

    _between = ""

    def __init__(self, options: Options) -> None:
        super().__init__(options)
        self._lines: list[Line] = []
        self._begun: set[int] = set()
        self._waiting: list[tuple[int, StageResult]] = []
        self._are_many = False

    def stage(self, number: int, stage: StageResult) -> Iterator[str]:
        self._waiting.append((number, stage))
        self._are_many = self._are_many or len(self._waiting) > _FEW_STAGES
        if self._are_many:
            yield from self.held()

    def held(self) -> Iterator[str]:
        waiting, self._waiting = self._waiting, []
        for each in waiting:
            yield from self._tell(*each)

    def _tell(self, number: int, stage: StageResult) -> Iterator[str]:
        heard = self.told_on(number)
        telling = [] if self.options.summary else heard
        here = {cause for one in heard for cause in one.numbers}
        if telling or _is_shown(stage, self.options):
            extras = _extras(stage, self.levels, here, self.options)
            self._begun.add(number)
            yield self._block(_stage(stage, telling, extras, self.options))
        self._lines += map(line_of, telling)

    def end(self, report: Report) -> Iterator[str]:
        self._waiting = [(number, report.stages[number]) for number, _ in self._waiting]
        yield from self.held()
        late = {} if self.options.summary else self.told_late()
        for number, telling in late.items():
            stage = report.stages[number]._replace(particle_fields=None)
            again = number in self._begun
            yield self._block(_stage(stage, telling, (), self.options, again))
            self._lines += map(line_of, telling)
        for block in _closing(report, self._lines, self.options):
            yield self._block(block)

    def _block(self, text: str) -> str:
        between, self._between = self._between, "\n"
        return between + text


def _closing(report: Report, lines: Sequence[Line], options: Options) -> Iterator[str]:
    """What is known once the run is over."""
    if text := "".join(f"{line}\n" for line in elsewhere(report, lines, options)):
        yield text
    yield from _table(report, options)
    if not options.quiet:
        style = _verdict_style(report, options)
        last = paint(verdict(report, options), style, options.color)
        yield "".join(f"{line}\n" for line in (last, *advice(report, options)))
    elif gone := unpruned(report, options):
        yield f"{gone}\n"


def _table(report: Report, options: Options) -> Iterator[str]:
    """The table that was asked for, or one by rule after many causes."""
    number = sum(map(options.shows, report.causes))
    if options.summary or (number > MANY_CAUSES and not options.quiet):
        lines = table(report, options, options.summary or "rule")
        if text := "".join(f"{line}\n" for line in lines):
            yield text


def _verdict_style(report: Report, options: Options) -> str:
    if any(stage.status != Status.CHECKED for stage in report.stages):
        return SEVERITY_STYLES[Severity.ERROR]
    told = filter(options.shows, report.causes)
    severities = [cause.severity for cause in told if cause.state.counts]
    return SEVERITY_STYLES[max(severities)] if severities else "bold green"


def _is_shown(stage: StageResult, options: Options) -> bool:
    """Whether a stage has a section in the report though no cause is told under it."""
    if stage.status != Status.CHECKED:
        return True
    return (options.verbose or bool(stage.particle_fields)) and not options.quiet


def _stage(
    stage: StageResult,
    telling: Sequence[Told],
    extras: Iterable[str],
    options: Options,
    is_continued: bool = False,
) -> str:
    found = {prim: list(lines) for prim, lines in groupby(telling, key=_prim_of)}
    held = {} if options.quiet else {one.prim: one for one in stage.particle_fields or ()}
    groups: list[Iterable[str]] = [
        _prim(prim, held.get(prim), found.get(prim, ()), options)
        for prim in sorted({*found, *held})
    ]
    blocks = ("".join(f"{line}\n" for line in group) for group in (*groups, extras))
    heading = _heading(stage, options) + " (continued)" * is_continued
    return heading + "\n" + "\n".join(filter(None, blocks))


def _heading(stage: StageResult, options: Options) -> str:
    path = paint(printable(stage.path), "bold underline", options.color)
    if stage.status == Status.CHECKED:
        return path
    status = stage.status.replace("_", " ")
    return f"{path} {paint(f'({status})', SEVERITY_STYLES[Severity.ERROR], options.color)}"


def _prim_of(one: Told) -> str:
    return one.finding.site.prim or ""


def _prim(
    prim: str,
    holds: ParticleFieldStats | None,
    telling: Iterable[Told],
    options: Options,
) -> Iterator[str]:
    """What one prim holds and what is told at it; what is told of the stage has no heading."""
    if prim:
        yield "  " + paint(printable(prim), "bold", options.color)
    if holds:
        for label, figure in figures(holds):
            yield _labelled(label, figure, "dim", "    ", options)
    for one in telling:
        yield from _told(one, "    " if prim else "  ", options)


def _told(one: Told, indent: str, options: Options) -> Iterator[str]:
    finding, cause = one.finding, one.first
    state = "" if cause.state.counts else f" ({cause.state})"
    label = f"{printable(finding.code)} {cause.severity.label}{state}:"
    style = SEVERITY_STYLES[cause.severity]
    yield _labelled(label, message(one, options.verbose), style, indent, options)
    indent += "  "
    if cause.source.layer is not None:
        yield f"{indent}{paint('-->', 'blue', options.color)} {location(finding.site)}"
        yield from _excerpt(finding.site, indent, style, options)
    if place := ", ".join(where(finding.site)):
        yield _labelled("at", place, "blue", indent, options)
    if others := on_this_stage(one, options.verbose):
        yield _labelled("also", others, "blue", indent, options)
    for name, said in remarks(one):
        yield _labelled(name, said, style, indent, options)
    if finding.suggestion:
        suggestion = finding.suggestion if options.verbose else shortened(finding.suggestion)
        yield _labelled("help:", printable(suggestion), "green", indent, options)
    if options.verbose:
        yield from _details(finding, indent, options)


def _excerpt(site: Site, indent: str, style: str, options: Options) -> Iterator[str]:
    """The line of a text layer, and a mark under the value that is meant."""
    if site.excerpt is None or site.line is None:
        return
    text, column = site.excerpt
    before, number = printable(text[: column - 1]), str(site.line)
    bar = paint("|", "blue", options.color)
    yield f"{indent}{paint(number, 'blue', options.color)} {bar} {printable(text)}"
    gap = " " * cells(before)
    yield f"{indent}{' ' * len(number)} {bar} {gap}{paint('^', style, options.color)}"


def _details(finding: Finding, indent: str, options: Options) -> Iterator[str]:
    """What `--verbose` adds to a finding."""
    yield _labelled("rule:", _rule(finding), "dim", indent, options)
    for line in (finding.detail or "").expandtabs().splitlines():
        yield f"{indent}| {printable(line)}".rstrip()


def shortened(suggestion: str) -> str:
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


def where(site: Site) -> Iterator[str]:
    """Property, variant and frames: what is neither in the heading nor in the location."""
    if site.property:
        yield printable(site.property)
    yield from variant_and_frames(site)


def _rule(finding: Finding) -> str:
    return ", ".join(printable(part) for part in (finding.name, finding.help) if part)


def _extras(
    stage: StageResult, levels: Mapping[int, Severity], here: AbstractSet[int], options: Options
) -> Iterator[str]:
    """What `--verbose` adds to a stage; `levels` are those of what is told so far."""
    if not options.verbose:
        return
    stats = ", ".join(f"{printable(name)} {count:,}" for name, count in stage.stats.items())
    seconds = ", ".join(f"{printable(name)} {time:.3f}" for name, time in stage.seconds.items())
    if above := _told_above(stage, levels, here):
        yield _labelled("told above:", above, "dim", "  ", options)
    if stats:
        yield _labelled("stats:", stats, "dim", "  ", options)
    if seconds:
        yield _labelled("seconds:", seconds, "dim", "  ", options)


def _told_above(stage: StageResult, levels: Mapping[int, Severity], here: AbstractSet[int]) -> str:
    """The number of causes that this stage shows, and that are told under another one."""
    shown = zip(stage.causes, stage.worst, strict=True)
    told = [cause for cause, worst in shown if worst and cause in levels and cause not in here]
    above = [levels[cause] for cause in told]
    return counts(*((above.count(level), level.label) for level in reversed(Severity)))


def _labelled(label: str, text: str, style: str, indent: str, options: Options) -> str:
    """A styled label and its text, whose further lines are indented to the first."""
    # Without colour nothing is wrapped: the output goes to a file, a pipe or a log, where a line
    # break in a phrase would hide it from a search.
    lines = [text]
    hang = len(indent) + len(label) + 1
    if options.color:
        lines = list(wrap(text, options.width - hang))
    return f"{indent}{paint(label, style, options.color)} " + f"\n{' ' * hang}".join(lines)
