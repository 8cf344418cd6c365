"""The report for programs: one JSON object that follows `report-1.0.schema.json`."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from enum import Enum
from pathlib import PurePath

from usdvol_lint.model import Completion, Finding, Report, Severity, StageReport
from usdvol_lint.paths import display
from usdvol_lint.report import Options

SCHEMA_VERSION = "1.0"

# Lone surrogates are not valid UTF-8; a terminal would obey the others instead of showing them.
_TO_ESCAPE = re.compile(r"[\x7f-\x9f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ud800-\udfff]")

# Larger whole numbers are inexact in readers that take all JSON numbers for doubles.
_LARGEST_INTEGER = 2**53


def render(report: Report, options: Options) -> str:
    text = json.dumps(_report(report), ensure_ascii=False, allow_nan=False, indent=2)
    return _TO_ESCAPE.sub(lambda match: f"\\u{ord(match.group()):04x}", text) + "\n"


def _report(report: Report) -> dict[str, object]:
    summary = report.summary
    return {
        "schema_version": SCHEMA_VERSION,
        "tool": {
            "name": "usdvol-lint",
            "version": report.version,
            "usd_version": report.usd_version,
        },
        "settings": _setting(report.settings),
        "summary": {
            "stages": summary.stages,
            "errors": summary.errors,
            "warnings": summary.warnings,
            "infos": summary.infos,
            "by_code": summary.by_code,
            "by_status": summary.by_status,
        },
        "stages": [_stage(stage) for stage in report.stages],
    }


def _stage(stage: StageReport) -> dict[str, object]:
    figures = stage.particle_fields
    return {
        "path": stage.path,
        "status": stage.status.value,
        "stats": stage.stats,
        **({} if figures is None else {"particle_fields": [one._asdict() for one in figures]}),
        "completes": stage.completes and _completion(stage.completes),
        "seconds": round(sum(stage.seconds.values(), 0.0), 6),
        "findings": [_finding(finding) for finding in stage.findings],
    }


def _completion(completion: Completion) -> dict[str, object]:
    return {
        "layers": list(map(display, completion.layers)),
        "specs": [
            {
                "layers": list(map(display, spec.layers)),
                "path": spec.path,
                "lacking": list(spec.lacking),
            }
            for spec in completion.specs
        ],
    }


def _finding(finding: Finding) -> dict[str, object]:
    site = finding.site
    return {
        "code": finding.code,
        "name": finding.name,
        "severity": finding.severity.label,
        "message": finding.message,
        "suggestion": finding.suggestion,
        "prim": site.prim,
        "property": site.property,
        "layer": site.layer,
        "variant": site.variant,
        "frames": site.frames,
        "times": [_number(time) for time in site.times if math.isfinite(time)],
        "line": site.line,
        "column": site.column,
        "fingerprint": finding.fingerprint,
        "help": finding.help,
    }


def _number(time: float) -> int | float:
    whole = abs(time) <= _LARGEST_INTEGER and time == int(time)
    return int(time) if whole else time


def _setting(value: object) -> object:
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
