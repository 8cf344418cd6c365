"""The report for grep and editors: one line for each cause.

`path: CODE severity <prim.property> [frames] (variant) message (+N places) (in stage) (state)`
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from os.path import normpath
from pathlib import Path

from usdvol_lint.model import Site
from usdvol_lint.report import Options
from usdvol_lint.report.numbers import count
from usdvol_lint.report.staged import Staged
from usdvol_lint.report.style import SEVERITY_STYLES, paint
from usdvol_lint.report.telling import Told, message, more_here, remarks
from usdvol_lint.report.text import location
from usdvol_lint.results import Report, StageResult
from usdvol_lint.words import printable


class Concise(Staged):
    """A line for each cause; the number of places is that on the stage."""

    def __init__(self, options: Options) -> None:
        super().__init__(options)
        self._absolute = cache(_absolute)

    def stage(self, number: int, stage: StageResult) -> Iterator[str]:
        yield from self._lines(self.told_on(number), stage)

    def end(self, report: Report) -> Iterator[str]:
        for number, telling in self.told_late().items():
            yield from self._lines(telling, report.stages[number])
        if report.failure:
            yield f"usdvol-lint: {printable(report.failure)}\n"

    def _lines(self, telling: Sequence[Told], stage: StageResult) -> Iterator[str]:
        for one in telling:
            yield " ".join(_parts(one, stage.path, self.options, self._absolute)) + "\n"


def _parts(
    one: Told, stage: str, options: Options, absolute: Callable[[str], str]
) -> Iterator[str]:
    site, severity = one.finding.site, one.first.severity
    rule = f"{printable(one.finding.code)} {severity.label}"
    is_of_a_layer = one.first.source.layer is not None
    yield f"{location(site) if is_of_a_layer else printable(stage)}:"
    yield paint(rule, SEVERITY_STYLES[severity], options.color)
    if site.prim or site.property:
        yield f"<{printable(_object_path(site))}>"
    if site.frames:
        yield f"[{site.frames}]"
    if site.variant:
        yield f"(variant {printable(site.variant)})"
    yield message(one, options.verbose)
    if more := more_here(one):
        yield f"(+{count(more, 'place')})"
    if is_of_a_layer and site.layer != stage and absolute(site.layer) != absolute(stage):
        yield f"(in {printable(stage)})"
    yield from _state(one)


def _state(one: Told) -> Iterator[str]:
    said = [f"({label} {text})" for label, text in remarks(one)]
    if not one.first.state.counts:
        yield f"({one.first.state})"
    yield from said


def _object_path(site: Site) -> str:
    prim = site.prim or ""
    return f"{prim}.{site.property}" if site.property else prim


def _absolute(path: str) -> str:
    """A path by which two are compared: a layer's is relative, a stage's as the user wrote it."""
    # Not `resolve`, which looks at the disk, and fails for paths that can't exist.
    return normpath(Path(path).absolute())
