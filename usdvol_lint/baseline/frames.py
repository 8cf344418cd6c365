"""Sets of time codes: as text and back, joined, and one beside another."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator
from functools import lru_cache
from itertools import islice

from usdvol_lint.words import format_time, frame_ranges

TOLERANCE = 1e-6
"""Time codes that are no farther apart are one: offsets and scales are undone in floating point."""
_MOST = 1_000_000
_NUMBER = r"(-?(?:inf|\d+(?:\.\d+)?(?:e[+-]?\d+)?))"
_RANGE = re.compile(rf"{_NUMBER}(?:(?:-| to ){_NUMBER}(?:x{_NUMBER})?)?")
_SHOWN = 8


@lru_cache(maxsize=4096)
def frames_as_text(frames: tuple[float, ...]) -> str:
    """Ascending time codes as ranges, `3, 7-9, 20-30x2`, which can be read back."""
    numbers = tuple(frame for frame in frames if frame == frame)  # NaN equals nothing, nor itself
    text = frame_ranges(numbers)
    return text if _reads_as(text, numbers) else ", ".join(map(format_time, numbers))


def _reads_as(text: str, frames: tuple[float, ...]) -> bool:
    """Whether ranges say what frames there are: steps that only nearly are one add up."""
    try:
        read = frames_from_text(text)
    except ValueError:
        return False
    pairs = zip(read, frames, strict=False)
    # Rounding takes half of the tolerance; the other half is for the next run.
    near = all(one == other or abs(one - other) < 0.6 * TOLERANCE for one, other in pairs)
    return len(read) == len(frames) and near


@lru_cache(maxsize=4096)
def frames_from_text(text: str) -> tuple[float, ...]:
    """The time codes that `frames_as_text` wrote; raises ValueError for other text.

    Equal texts share their frames: in a baseline many causes cover the same.
    """
    parts = text.split(",") if text.strip() else []
    frames = (frame for part in parts for frame in _range(part.strip()))
    read = sorted(islice(frames, _MOST + 1))
    if len(read) > _MOST:
        raise ValueError(f"more than {_MOST} frames")
    return tuple(read)


def _range(part: str) -> Iterator[float]:
    found = _RANGE.fullmatch(part)
    if not found:
        raise ValueError(f"no frames: {part!r}")
    first, last, step = found.groups()
    if last is None:
        return iter((float(first),))
    return _even(float(first), float(last), float(step or 1))


def _even(first: float, last: float, step: float) -> Iterator[float]:
    """Evenly spread frames from the first to the last: a step that was rounded doesn't add up."""
    if not (step > 0 and first < last and (last - first) / step < _MOST):
        raise ValueError(f"no frames: {first} to {last} by {step}")
    gaps = max(round((last - first) / step), 1)
    return (first + (last - first) * gap / gaps for gap in range(gaps + 1))


def union(one: tuple[float, ...], other: tuple[float, ...]) -> tuple[float, ...]:
    """The frames of both, ascending."""
    if one == other:
        return one
    joined: list[float] = []
    for frame in sorted((*one, *other)):
        if not joined or frame - joined[-1] > TOLERANCE / 2:  # so that rounding can't tell
            joined.append(frame)
    return tuple(joined)


def goes_beyond(was: tuple[float, ...], now: tuple[float, ...]) -> bool:
    """Whether there is a frame that was not."""
    return was != now and any(not _is_in(was, frame) for frame in set(now).difference(was))


def _is_in(frames: tuple[float, ...], frame: float) -> bool:
    at = bisect_left(frames, frame - TOLERANCE)
    return frame != frame or (at < len(frames) and frames[at] <= frame + TOLERANCE)


def in_words(frames: tuple[float, ...]) -> str:
    """`frame 3`, `frames 3, 7-9`; no more than the first few ranges."""
    ranges = frames_as_text(frames).split(", ")
    if len(ranges) > _SHOWN:
        ranges = [*ranges[:_SHOWN], f"… ({len(frames)} in all)"]
    return f"frame{'' if len(frames) == 1 else 's'} {', '.join(ranges)}"
