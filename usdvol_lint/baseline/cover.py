"""How much of what is to blame a cause covers: as JSON, joined, and what is beyond it."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from typing import Any

from usdvol_lint.baseline.frames import (
    frames_as_text,
    frames_from_text,
    goes_beyond,
    in_words,
    union,
)
from usdvol_lint.model import Cover, Severity
from usdvol_lint.words import quoted

ALL = "all"
SHARES = ("1 particle", "0.1 %", "1 %", "10 %", "half", "all")
"""The steps of a share of an array: at most so much."""
_LIMITS = (0.001, 0.01, 0.1, 0.5)
_LONGEST_SHOWN = 60
_ONE_ELEMENT = (1.0, 1)
_SHARE_AND_ELEMENTS = (_ONE_ELEMENT, *((limit, None) for limit in (*_LIMITS, 1.0)))
_LEVELS = {severity.label: severity for severity in Severity}


def share_step(cover: Cover) -> int | None:
    """The index in SHARES of the share of an array; None without an array."""
    if cover.share is None:
        return None
    if cover.elements is not None and cover.share * cover.elements < 1.5:
        return 0
    return 1 + bisect_left(_LIMITS, cover.share)


def cover_as_json(cover: Cover) -> dict[str, object]:
    """`{"frames": "3, 7-9", "default": false, "share": "1 %", "level": "error"}`."""
    step = share_step(cover)
    return {
        "frames": ALL if cover.frames is None else frames_as_text(cover.frames),
        "default": cover.at_default,
        "share": None if step is None else SHARES[step],
        "level": cover.level.label,
    }


def cover_from_json(value: Any) -> Cover:
    """The cover, its share as the most that its step allows; raises ValueError in words."""
    if not isinstance(value, dict):
        raise ValueError("must be an object")
    share, elements = _share(value.get("share"))
    at_default = value.get("default", False)
    if not isinstance(at_default, bool):
        raise ValueError(f"'default' must be true or false, not {_shown(at_default)}")
    return Cover(_level(value.get("level")), _frames(value), at_default, share, elements)


def _frames(value: dict[str, Any]) -> tuple[float, ...] | None:
    text = value.get("frames")
    try:
        return None if text == ALL else frames_from_text(text)
    except (ValueError, AttributeError, TypeError):
        wanted = "ranges such as '3, 7-9', or 'all'"
        raise ValueError(f"'frames' must be {wanted}, not {_shown(text)}") from None


def _share(value: Any) -> tuple[float | None, int | None]:
    if value is None:
        return None, None
    if value not in SHARES:
        wanted = ", ".join(map(repr, SHARES))
        raise ValueError(f"'share' must be one of {wanted}, not {_shown(value)}")
    return _SHARE_AND_ELEMENTS[SHARES.index(value)]


def _level(value: Any) -> Severity:
    if not isinstance(value, str) or value not in _LEVELS:
        raise ValueError(f"'level' must be one of {', '.join(_LEVELS)}, not {_shown(value)}")
    return _LEVELS[value]


def _shown(value: Any) -> str:
    shown = quoted(value) if isinstance(value, str) else repr(value)
    return shown if len(shown) <= _LONGEST_SHOWN else f"{shown[:_LONGEST_SHOWN]}…"


def join(one: Cover, other: Cover) -> Cover:
    """What both cover together."""
    wider = max(one, other, key=_share_order)
    return Cover(
        max(one.level, other.level),
        None if one.frames is None or other.frames is None else union(one.frames, other.frames),
        one.at_default or other.at_default,
        wider.share,
        wider.elements,
    )


def _share_order(cover: Cover) -> tuple[float, ...]:
    step = share_step(cover)
    return (-1,) if step is None else (step, cover.share or 0, cover.elements or 0)


def exceeds(was: Cover, now: Cover) -> str | None:
    """In words what is more than it was, `was frame 3, is frames 3, 7-9`; None if nothing is."""
    return "; ".join(_more(was, now)) or None


def _more(was: Cover, now: Cover) -> Iterator[str]:
    if _has_more_times(was, now):
        yield f"was {_times(was)}, is {_times(now)}"
    before, after = share_step(was), share_step(now)
    if before is not None and after is not None and after > before:
        yield f"was {SHARES[before]}, is {SHARES[after]} of the elements"
    if now.level > was.level:
        yield f"was {_article(was.level)}, is {_article(now.level)}"


def _has_more_times(was: Cover, now: Cover) -> bool:
    if now.at_default and not was.at_default:
        return True
    return was.frames is not None and (now.frames is None or goes_beyond(was.frames, now.frames))


def _times(cover: Cover) -> str:
    words = ["the default"] if cover.at_default else []
    if cover.frames is None:
        words.append("all frames")
    elif cover.frames or not words:
        words.append(in_words(cover.frames) if cover.frames else "no frame")
    return " and ".join(words)


def _article(level: Severity) -> str:
    return f"{'a' if level is Severity.WARNING else 'an'} {level.label}"
