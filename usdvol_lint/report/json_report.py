"""The report for programs: one JSON object that follows `report-2.0.schema.json`."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from enum import Enum
from functools import cache, lru_cache
from json.encoder import encode_basestring as _text
from pathlib import PurePath
from typing import Any, NamedTuple

from usdvol_lint.model import Completion, Cover, Finding, Severity, Site, Source
from usdvol_lint.paths import below
from usdvol_lint.report import Writer
from usdvol_lint.results import BaselineUse, Cause, Place, Report, RunInfo, StageResult, Summary
from usdvol_lint.words import escaped

SCHEMA_VERSION = "2.0"

# Larger whole numbers are inexact in readers that take all JSON numbers for doubles.
_LARGEST_INTEGER = 2**53

_MOST_TEXTS = 4096
"""So many texts that recur, such as names of properties, are kept as they are written."""
# Indented JSON is written by Python code, which takes ten times as long as what C writes at once:
# so each stage and each cause is a line.
_ENCODE = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode

_LABELS = {severity: severity.label for severity in Severity}


class Shared(NamedTuple):
    """What many causes have in common, each written once in a report."""

    rule: Callable[[str, str], str]
    cover: Callable[[Cover], str]
    times: Callable[[tuple[float, ...], bool], str]
    text: Callable[[str | None], str]
    file: Callable[[str], str]

    @classmethod
    def of(cls, report: Report) -> Shared:
        from usdvol_lint.baseline.cover import cover_as_json

        return cls(
            cache(lambda code, name: f'"code": {_text(code)}, "name": {_text(name)}'),
            cache(lambda cover: _ENCODE(cover_as_json(cover))),
            cache(_times),
            lru_cache(_MOST_TEXTS)(_optional),
            cache(lambda layer: _text(below(layer, report.root))),
        )


class Json(Writer):
    """One object; what is known before the first cause stands first."""

    _shared: Shared
    _before = "[\n"

    def begin(self, report: Report) -> Iterator[str]:
        self._shared = Shared.of(report)
        yield "{\n"
        for key, value in head(report).items():
            yield f"  {line(key)}: {line(value)},\n"
        yield '  "causes": '

    def cause(self, number: int, cause: Cause) -> Iterator[str]:
        members = cause_members(cause, cause.places, self._shared)
        yield f"{self._before}    {escaped(f'{{{members}}}')}"
        self._before = ",\n"

    def end(self, report: Report) -> Iterator[str]:
        yield "[]" if self._before == "[\n" else "\n  ]"
        for key, value in rest(report).items():
            yield f",\n  {line(key)}: {_value(value)}"
        yield "\n}\n"


def _value(value: object) -> str:
    """A value on one line, or a list with a line for each item."""
    if not isinstance(value, list):
        return line(value)
    items = ",\n".join(f"    {line(item)}" for item in value)
    return f"[\n{items}\n  ]" if items else "[]"


def line(value: object) -> str:
    """A value in one line."""
    return escaped(_ENCODE(value))


def head(report: Report) -> dict[str, object]:
    """What is known before the first cause."""
    from usdvol_lint.baseline.fingerprint import FINGERPRINT_VERSION

    return {
        "schema_version": SCHEMA_VERSION,
        "fingerprint_version": FINGERPRINT_VERSION,
        "tool": {
            "name": "usdvol-lint",
            "version": report.version,
            "usd_version": report.usd_version,
        },
        "settings": _setting(report.settings),
        "root": report.root,
        "arguments": report.arguments,
    }


def rest(report: Report) -> dict[str, Any]:
    """What is known after the last cause."""
    return {
        "partial": bool(report.interrupted),
        "failure": report.failure or None,
        "summary": _summary(report.summary),
        "baseline": report.baseline and _baseline(report.baseline),
        "stages": list(map(_stage, report.stages)),
        "run": _run(report.run, report.stages),
    }


def _summary(summary: Summary) -> dict[str, object]:
    return {
        "stages": summary.stages,
        "stages_with_findings": summary.stages_with_findings,
        "errors": summary.errors,
        "warnings": summary.warnings,
        "infos": summary.infos,
        "by_code": summary.by_code,
        "by_state": summary.by_state,
        "by_status": summary.by_status,
    }


def _baseline(use: BaselineUse) -> dict[str, object]:
    return {
        "path": use.path,
        "entries": use.entries,
        "gone": use.gone,
        "partial": use.partial or None,
        "moved": [{"old": old, "new": new} for old, new in use.moved],
        "written": use.written,
    }


def _run(run: RunInfo, stages: Iterable[StageResult]) -> dict[str, object]:
    """What may differ between equal runs, and stands nowhere else."""
    return {
        "date": run.date,
        "command": run.command,
        "config_file": run.config_file,
        "config_extends": run.config_extends,
        "seconds": round(run.seconds, 6),
        "jobs": run.jobs,
        "shard": None,
        "cached": None,
        "stage_seconds": [round(sum(stage.seconds.values(), 0.0), 6) for stage in stages],
    }


def _stage(stage: StageResult) -> dict[str, object]:
    figures = stage.particle_fields
    return {
        "path": stage.path,
        "status": stage.status,
        "partial": False,
        "part": stage.part,
        "stats": stage.stats,
        **({} if figures is None else {"particle_fields": [one._asdict() for one in figures]}),
        "completes": stage.completes and _completion(stage.completes),
        "causes": stage.causes,
        "levels": {
            _LABELS[level]: number for level, number in sorted(stage.levels.items(), reverse=True)
        },
    }


def _completion(completion: Completion) -> dict[str, object]:
    return {
        "layers": completion.layers,
        "specs": [
            {
                "layers": spec.layers,
                "path": spec.path,
                "lacking": spec.lacking,
            }
            for spec in completion.specs
        ],
    }


# --- causes: so many that each is written by hand, which takes a third of the time ----------------


def cause_members(cause: Cause, places: Iterable[Place], shared: Shared) -> str:
    """What stands in the object of a cause, with some of its places."""
    first = cause.places[0].finding
    was = "null" if cause.was is None else shared.cover(cause.was)
    told = ", ".join([f"{{{place_members(each, first, shared)}}}" for each in places])
    return (
        f'"fingerprint": "{cause.fingerprint}", {shared.rule(first.code, first.name)}, '
        f'"severity": "{_LABELS[cause.severity]}", '
        f'"state": "{cause.state}", "was": {was}, "reason": {_optional(cause.reason)}, '
        f'"message": {_text(first.message)}, "suggestion": {_optional(first.suggestion)}, '
        f'"help": {shared.text(first.help)}, "cover": {shared.cover(cause.cover)}, '
        f'"fold": {shared.text(first.fold)}, "source": {_source(cause.source, first, shared)}, '
        f'"excerpt": {_excerpt(first.site)}, "count": {cause.count}, "places": [{told}]'
    )


def _source(source: Source, first: Finding, shared: Shared) -> str:
    """What is to blame; `file` is the layer at the first place, where versions are folded."""
    layer, file, site = source.layer, first.source.layer, first.site
    line, column = (None, None) if layer is None else (site.line, site.column)
    below_root = "null" if file is None else shared.file(file)
    return (
        f'{{"layer": {shared.text(layer)}, "file": {below_root}, "path": {_optional(source.path)}, '
        f'"property": {shared.text(source.property)}, "subject": {_text(source.subject)}, '
        f'"line": {_number(line)}, "column": {_number(column)}}}'
    )


def _excerpt(site: Site) -> str:
    if site.excerpt is None:
        return "null"
    text, column = site.excerpt
    return f'{{"text": {_text(text)}, "column": {column}}}'


def place_members(place: Place, first: Finding, shared: Shared) -> str:
    """What stands in the object of a place: the words of the cause unless it says others."""
    stage, finding = place
    site = finding.site
    said = (
        f'"stage": {stage}, "prim": {_optional(site.prim)}, '
        f'"property": {shared.text(site.property)}, "variant": {_optional(site.variant)}, '
        f'{shared.times(site.times, site.at_default)}, "severity": "{_LABELS[finding.severity]}"'
    )
    if finding.message != first.message:
        said += f', "message": {_text(finding.message)}'
    if finding.suggestion != first.suggestion:
        said += f', "suggestion": {_optional(finding.suggestion)}'
    if finding.ignored != first.ignored:
        said += f', "reason": {_optional(finding.ignored)}'
    return said


def _optional(text: str | None) -> str:
    return "null" if text is None else _text(text)


def _number(number: int | None) -> str:
    return "null" if number is None else str(number)


def _times(times: tuple[float, ...], at_default: bool) -> str:
    """When it is seen, as people read it and as programs do."""
    frames = Site("", times=times, at_default=at_default).frames
    said = {"frames": frames, "times": list(_numbers(times)), "at_default": at_default}
    return _ENCODE(said)[1:-1]


def _numbers(times: Iterable[float]) -> Iterator[int | float]:
    """Time codes as JSON has them: those that are finite, whole numbers without a point."""
    for time in times:
        if math.isfinite(time):
            yield int(time) if abs(time) <= _LARGEST_INTEGER and time == int(time) else time


def _setting(value: object) -> Any:
    """A setting in the types of JSON, with sets sorted, so that equal runs write equal reports."""
    match value:
        case Severity():
            return value.label
        case Enum():
            return _setting(value.value)
        case PurePath():
            return value.as_posix()
        case float() if not math.isfinite(value):
            return str(value)
        case Mapping():
            return {str(key): _setting(item) for key, item in value.items()}
        case AbstractSet():
            return sorted((_setting(item) for item in value), key=str)
        case list() | tuple():
            return [_setting(item) for item in value]
        case _:
            return value
