"""The report for grep and editors: one line for each finding.

`path: CODE severity <prim.property> [frames] (variant) message`
"""

from __future__ import annotations

from collections.abc import Iterator
from os.path import normpath
from pathlib import Path

from usdvol_lint.model import Finding, Report, Site, StageReport
from usdvol_lint.report import Options
from usdvol_lint.report.style import SEVERITY_STYLES, paint
from usdvol_lint.report.text import location
from usdvol_lint.words import printable


def render(report: Report, options: Options) -> str:
    return "".join(
        " ".join(_parts(finding, stage, options)) + "\n"
        for stage in report.stages
        for finding in filter(options.shows, stage.findings)
    )


def _parts(finding: Finding, stage: StageReport, options: Options) -> Iterator[str]:
    site = finding.site
    rule = f"{printable(finding.code)} {finding.severity.label}"
    yield f"{location(site)}:"
    yield paint(rule, SEVERITY_STYLES[finding.severity], options.color)
    if site.prim or site.property:
        yield f"<{printable(_object_path(site))}>"
    if site.frames:
        yield f"[{site.frames}]"
    if site.variant:
        yield f"(variant {printable(site.variant)})"
    yield printable(finding.message)
    if not _same_file(site.layer, stage.path):
        yield f"(in {printable(stage.path)})"


def _object_path(site: Site) -> str:
    prim = site.prim or ""
    return f"{prim}.{site.property}" if site.property else prim


def _same_file(layer: str, stage: str) -> bool:
    """Whether both are one path: a layer's is relative, a stage's as the user wrote it."""
    return layer == stage or _absolute(layer) == _absolute(stage)


def _absolute(path: str) -> str:
    # Not `resolve`, which looks at the disk, and fails for paths that can't exist.
    return normpath(Path(path).absolute())
