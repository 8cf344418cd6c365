"""What a job in GitHub Actions has besides the text: annotations, and a summary of its step."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

from usdvol_lint.report import Options
from usdvol_lint.results import Report

MOST_OF_A_SUMMARY = 900 * 1024
"""How many bytes a step's summary may have; of one above 1,024 KiB GitHub shows nothing."""


def is_github() -> bool:
    return os.environ.get("GITHUB_ACTIONS") == "true"


class Guard:
    """Encloses text that GitHub takes no commands from, whatever stages have in their names."""

    def __init__(self) -> None:
        self._token = ""

    def opened(self, parts: Iterable[str]) -> Iterator[str]:
        """The text, after what begins it if this is the first of it."""
        for part in filter(None, parts):
            if not self._token:
                self._token = secrets.token_hex(16)  # which no stage can foresee
                yield f"::stop-commands::{self._token}\n"
            yield part

    def closed(self) -> Iterator[str]:
        """What ends it, if there was any."""
        if self._token:
            yield f"::{self._token}::\n"


def guarded(parts: Iterable[str]) -> Iterator[str]:
    """The whole text, so that GitHub takes no commands from it."""
    guard = Guard()
    yield from guard.opened(parts)
    yield from guard.closed()


def summary_file() -> str | None:
    """The file of the step's summary; None for a hook, whose calls would each add to it."""
    file = os.environ.get("GITHUB_STEP_SUMMARY")
    return file if file and not os.environ.get("PRE_COMMIT") else None


def add_summary(file: Path, report: Report, options: Options) -> None:
    """Adds the report to the summary of a step, as much as fits beside what others wrote."""
    from usdvol_lint.report.markdown import markdown

    with file.open("ab+") as summary:
        written = summary.seek(0, os.SEEK_END)
        text = markdown(report, options, max(0, MOST_OF_A_SUMMARY - written - 1))
        if text and written and not _ends_a_line(summary):
            text = f"\n{text}"
        summary.write(text.encode("utf-8", "backslashreplace"))


def _ends_a_line(file: BinaryIO) -> bool:
    file.seek(-1, os.SEEK_END)
    return file.read(1) == b"\n"
