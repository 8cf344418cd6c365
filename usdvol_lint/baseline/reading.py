"""Reads what a run is compared with: a baseline, or a JSON report of an earlier run."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from usdvol_lint.baseline.entry import (
    Entry,
    FrameLimit,
    by_fingerprint,
    entry_from_json,
    is_held,
    least_held,
    named_right,
)
from usdvol_lint.baseline.file import FORMAT_KEY, MOST_BYTES, Baseline, check_version, read_lines
from usdvol_lint.baseline.fingerprint import FINGERPRINT_VERSION
from usdvol_lint.baseline.scope import arguments_from_json, scope_from_json
from usdvol_lint.baseline.values import found, list_of, optional_string, string, table_of, value_of
from usdvol_lint.config import LEVELS
from usdvol_lint.model import Severity, UsageError
from usdvol_lint.results import State

_SCHEMA = "2."


def read_baseline(file: str) -> Baseline:
    """What the file holds; raises UsageError, in one line, where it is no baseline."""
    text = _text(file)
    report = _report(file, text)
    return read_lines(file, text) if report is None else _from_report(file, report)


def _text(file: str) -> str:
    try:
        if os.path.exists(file) and not os.path.isfile(file):  # a pipe may never end
            raise UsageError(f"{file}: no baseline: it is no file")
        with Path(file).open("rb") as stream:
            data = stream.read(MOST_BYTES + 1)
    except FileNotFoundError:
        hint = f"--write-baseline {file} writes one"
        raise UsageError(f"{file}: there is no such baseline; {hint}") from None
    except OSError as error:
        raise UsageError(f"{file}: no baseline: {error.strerror}") from None
    if len(data) > MOST_BYTES:
        raise UsageError(f"{file}: no baseline: none has more than {MOST_BYTES:,} bytes")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise UsageError(f"{file}:{line}: no UTF-8 text") from None


def _report(file: str, text: str) -> dict[str, Any] | None:
    """The report that the text is; None if it is none.

    A report is one object, in one or in many lines; a baseline has an object in each.
    """
    if FORMAT_KEY in text.partition("\n")[0] or '"schema_version"' not in text:
        return None
    try:
        value = value_of(text)
    except ValueError as error:
        raise UsageError(f"{file}: no JSON: {error}; is it cut off?") from None
    return value if isinstance(value, dict) else None


def _from_report(file: str, report: dict[str, Any]) -> Baseline:
    version = report.get("schema_version")
    if not isinstance(version, str) or not version.startswith(_SCHEMA):
        what = f"a report of schema {_SCHEMA}x is a baseline too, {found(report, 'schema_version')}"
        raise UsageError(f"{file}: {what}: write it anew")
    check_version(
        file, report, "fingerprint_version", FINGERPRINT_VERSION, "fingerprints of version"
    )
    settings = table_of(file, report, "settings")
    arguments = arguments_from_json(file, report) if "arguments" in report else None
    return Baseline(
        file=file,
        root=None,
        scope=scope_from_json(file, settings, arguments),
        entries=by_fingerprint(_held(file, report, least_held(settings))),
        has_root=optional_string(file, report, "root") is not None,
        is_report=True,
    )


def _held(file: str, report: dict[str, Any], least: Severity) -> Iterator[Entry]:
    """The causes of a report that a baseline of its run would hold."""
    limit = FrameLimit(file)
    for number, cause in enumerate(list_of(file, report, "causes")):
        where = f"{file}: causes[{number}]"
        if not isinstance(cause, dict):
            raise UsageError(f"{where} must be an object")
        entry = named_right(where, entry_from_json(where, cause, table_of(where, cause, "source")))
        state, severity = string(where, cause, "state"), string(where, cause, "severity")
        if state not in set(State) or severity not in LEVELS:
            raise UsageError(f"{where}: 'state' or 'severity' is none that there is")
        if is_held(entry, State(state), Severity[severity.upper()], least):
            yield limit.counted(entry)
