"""The report for grep and editors: one line for each cause.

`path: CODE severity <prim.property> [frames] (variant) message (+N places) (in stage) (state)`
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from os.path import normpath
from pathlib import Path

from usdvol_lint.model import Site
from usdvol_lint.report import Options, Writer
from usdvol_lint.report.numbers import count
from usdvol_lint.report.style import SEVERITY_STYLES, paint
from usdvol_lint.report.telling import Told, message, remarks, told
from usdvol_lint.report.text import location
from usdvol_lint.results import Report
from usdvol_lint.words import printable


class Concise(Writer):
    """A line for each cause; what is told of one depends on all of its places."""

    def end(self, report: Report) -> Iterator[str]:
        if report.failure:
            yield f"usdvol-lint: {printable(report.failure)}\n"
        absolute = cache(_absolute)
        by_stage = told(report, self.options)
        for number, stage in enumerate(report.stages):
            for one in by_stage.get(number, ()):
                yield " ".join(_parts(one, stage.path, self.options, absolute)) + "\n"


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
    if more := sum(cause.count - 1 for cause in one.causes):
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
