"""Keeps an input that is not as it should be, cut down as far as it stays so."""

from __future__ import annotations

import tempfile
from pathlib import Path

from .model import Input
from .running import Outcome, outcomes, write

_TRIES = 24
_LARGEST = 1 << 20


def keep(made: Input, outcome: Outcome, folder: Path) -> None:
    """Writes the input, what was said of it, and a smaller one that is as wrong."""
    write({0: made}, folder)
    smaller = minimised(made, outcome)
    if smaller != made:
        write({1: smaller}, folder)
    text = "\n".join([made.kind, *outcome.wrong, outcome.detail])
    (folder / "outcome.txt").write_text(text, encoding="utf-8", errors="replace")


def minimised(made: Input, outcome: Outcome) -> Input:
    """The input with parts taken out of the file to try, one after the other, while it is wrong."""
    tries, size = _TRIES, len(made.files[made.root]) // 2
    if len(made.files[made.root]) > _LARGEST or "did not end" in "".join(outcome.wrong):
        return made
    while size >= 16:
        for shorter in _shorter(made.files[made.root], size):
            if not tries:
                return made
            tries -= 1
            smaller = made._replace(files={**made.files, made.root: shorter})
            if _is_as_wrong(smaller, outcome):
                made = smaller
                break
        else:
            size //= 2
    return made


def _shorter(data: bytes, size: int) -> list[bytes]:
    """The bytes without each part of a size, but for what is empty then."""
    starts = range(0, len(data), size)
    return [rest for start in starts if (rest := data[:start] + data[start + size :])]


def _is_as_wrong(made: Input, outcome: Outcome) -> bool:
    with tempfile.TemporaryDirectory(prefix="usdvol-fuzz-") as folder:
        found, _ = outcomes({0: made}, Path(folder))
    return [each[:40] for each in found[0].wrong] == [each[:40] for each in outcome.wrong]
