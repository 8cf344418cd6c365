"""What a run came to as a table: by rule, cause, stage or asset, the worst first."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Final, NamedTuple, TypeAlias, TypeVar

from usdvol_lint.model import Severity
from usdvol_lint.report import Options
from usdvol_lint.report.numbers import count, few
from usdvol_lint.report.style import SEVERITY_STYLES, paint
from usdvol_lint.report.telling import Told, stages_by_cause
from usdvol_lint.report.width import cells
from usdvol_lint.results import Cause, Report
from usdvol_lint.words import printable

MOST_ROWS = 50
"""How many rows a table has; with `--verbose` it has all."""


class _Row(NamedTuple):
    """The columns of a row, and what it is sorted by: its worst level, then its places."""

    level: Severity
    places: int
    columns: tuple[str, ...]


_Key = TypeVar("_Key")
_Causes: TypeAlias = Sequence[Cause]
_Rows: TypeAlias = Callable[[Report, _Causes, Options], Iterator[_Row]]


def table(report: Report, options: Options, by: str) -> Iterator[str]:
    """The lines of a table of what is told, by one of TABLES; none where nothing is."""
    head, rows_of = _TABLES[by]
    causes = [cause for cause in report.causes if options.shows(cause)]
    yield from _table(head, rows_of(report, causes, options), options)


class Line(NamedTuple):
    """What was told at once: the stage under which it was, and the numbers of the causes."""

    stage: int
    causes: tuple[int, ...]


def line_of(told: Told) -> Line:
    """The same; of what was raised there is a line already."""
    return Line(told.stage, () if told.was else told.numbers)


def elsewhere(report: Report, lines: Iterable[Line], options: Options) -> Iterator[str]:
    """The lines of a table of what other stages show too; none where nothing is."""
    head = "other stages", "code", "level", "to blame", "shown in"
    yield from _table(head, _by_line(report, lines, options), options)


def _table(head: tuple[str, ...], found: Iterable[_Row], options: Options) -> Iterator[str]:
    """The worst rows, and how many more there are."""
    rows = sorted(found, key=lambda row: (-row.level, -row.places, row))
    told = rows if options.verbose else rows[:MOST_ROWS]
    if told:
        yield from _lines(head, told, options.color)
    if len(told) < len(rows):
        yield f"… and {count(len(rows) - len(told), 'row')} more, with --verbose"


def _lines(head: tuple[str, ...], rows: Sequence[_Row], color: bool) -> Iterator[str]:
    """Columns of one width, numbers to the right."""
    texts = [head, *(row.columns for row in rows)]
    widths = [max(map(cells, column)) for column in zip(*texts, strict=True)]
    are_numbers = [text.replace(",", "").isdigit() for text in rows[0].columns]
    styles = ["bold", *(SEVERITY_STYLES[row.level] for row in rows)]
    for style, columns in zip(styles, texts, strict=True):
        first, *others = map(_padded, columns, widths, are_numbers)
        yield "  ".join([paint(first, style, color), *others]).rstrip()


def _padded(text: str, width: int, is_number: bool) -> str:
    room = " " * (width - cells(text))
    return room + text if is_number else text + room


# --- the rows -------------------------------------------------------------------------------------


def _by_rule(report: Report, causes: _Causes, options: Options) -> Iterator[_Row]:
    for (code, name), group in _grouped(causes, lambda cause: (cause.code, cause.name)):
        level = _worst(group)
        yield _row(group, printable(code), printable(name), level.label, *_numbers(group))


def _by_cause(report: Report, causes: _Causes, options: Options) -> Iterator[_Row]:
    for cause in causes:
        places, level = f"{cause.count:,}", cause.severity.label
        yield _row([cause], places, printable(cause.code), level, _blamed(cause))


def _by_asset(report: Report, causes: _Causes, options: Options) -> Iterator[_Row]:
    for layer, group in _grouped(causes, lambda cause: cause.source.layer or "(this machine)"):
        yield _row(group, *_numbers(group), _worst(group).label, printable(layer))


def _by_stage(report: Report, causes: _Causes, options: Options) -> Iterator[_Row]:
    for stage in report.stages:
        told = {level: n for level, n in stage.levels.items() if level >= options.threshold}
        if told:
            numbers = (f"{told.get(level, 0):,}" for level in reversed(Severity))
            row = *numbers, printable(stage.path)
            yield _Row(max(told), sum(told.values()), row)


def _by_line(report: Report, lines: Iterable[Line], options: Options) -> Iterator[_Row]:
    shown_in = stages_by_cause(report)
    for stage, numbers in lines:
        others = sorted({each for n in numbers for each in shown_in.get(n, ())} - {stage})
        if others:
            causes = [report.causes[number] for number in numbers]
            level = _worst(causes)
            paths = few([printable(report.stages[each].path) for each in others], options.verbose)
            columns = (
                f"{len(others):,}",
                printable(causes[0].code),
                level.label,
                _blamed_all(causes),
            )
            yield _Row(level, len(others), (*columns, paths))


_TABLES: Final[Mapping[str, tuple[tuple[str, ...], _Rows]]] = {
    "rule": (("code", "rule", "level", "causes", "places"), _by_rule),
    "cause": (("places", "code", "level", "to blame"), _by_cause),
    "stage": (("errors", "warnings", "infos", "stage"), _by_stage),
    "asset": (("causes", "places", "level", "layer to blame"), _by_asset),
}
"""By what a table is, as in `config.SUMMARIES`: its head, and its rows."""


def _grouped(causes: _Causes, key: Callable[[Cause], _Key]) -> Iterable[tuple[_Key, list[Cause]]]:
    groups: dict[_Key, list[Cause]] = defaultdict(list)
    for cause in causes:
        groups[key(cause)].append(cause)
    return groups.items()


def _row(group: _Causes, *columns: str) -> _Row:
    return _Row(_worst(group), sum(cause.count for cause in group), columns)


def _worst(group: _Causes) -> Severity:
    return max(cause.severity for cause in group)


def _numbers(group: _Causes) -> tuple[str, str]:
    return f"{len(group):,}", f"{sum(cause.count for cause in group):,}"


def _blamed(cause: Cause) -> str:
    """The layer to blame, and the property or spec in it."""
    source = cause.source
    path = ".".join(filter(None, (source.path, source.property)))
    return printable(f"{source.layer or '(this machine)'} <{path or source.subject}>")


def _blamed_all(causes: _Causes) -> str:
    """The first of several that were told at once, and how many more these are."""
    more = len(causes) - 1
    return f"{_blamed(causes[0])} and {more:,} more" if more else _blamed(causes[0])
