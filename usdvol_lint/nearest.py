"""The known word that an unknown one is most likely a misspelling of."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from posixpath import commonprefix

CLOSE = 0.84
"""The least similarity, from 0 to 1, at which a word is offered for another."""
_LONG_ENOUGH = 4
_NUMBER = re.compile(r"[0-9]+")


def closest_match(
    word: str,
    known: Iterable[str],
    cutoff: float = CLOSE,
    fold: Callable[[str], str] = str.lower,
) -> str | None:
    """The known word closest to `word` when both are folded; None if none is close enough.

    `cutoff` is the least similarity, from 0 to 1, as difflib computes it.
    """
    ours = fold(word)
    folded = {
        theirs: other for other in known if _may_be_close(ours, theirs := fold(other), cutoff)
    }
    if not folded:
        return None
    from difflib import get_close_matches  # costs start-up time, and few words are misspelt

    matches = get_close_matches(ours, folded, n=1, cutoff=cutoff)
    return folded[matches[0]] if matches else None


def _may_be_close(word: str, other: str, cutoff: float) -> bool:
    """Whether the letters that two words share, in whatever order, allow this similarity."""
    shared = sum(min(word.count(letter), other.count(letter)) for letter in {*word})
    total = len(word) + len(other)
    return not total or 2 * shared / total >= cutoff


def by_nearness(word: str, others: Iterable[str]) -> list[str]:
    """Words from the most similar on; of those that differ in numbers alone, the highest first."""
    from difflib import SequenceMatcher

    def distance(other: str) -> tuple[float, list[int], str]:
        matcher = SequenceMatcher(None, _NUMBER.sub("", word), _NUMBER.sub("", other))
        return -matcher.ratio(), [-int(number) for number in _NUMBER.findall(other)], other

    return sorted(others, key=distance)


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown word, `; did you mean 'x'?`; empty if none is close."""
    closest = closest_match(word, known, cutoff=0.6)
    return f"; did you mean {closest!r}?" if closest else ""


def is_one_slip_from(word: str, other: str) -> bool:
    """Whether two names differ in case alone, or by one slip of the hand.

    A slip is a letter too many or too few, another letter, or two that are swapped, in a name of
    four letters or more.
    What tells names of a series apart is none: digits, and another letter at an end (`arm_L`).
    """
    if word.lower() == other.lower():
        return word != other
    if min(len(word), len(other)) < _LONG_ENOUGH:
        return False
    start = len(commonprefix((word, other)))
    end = len(commonprefix((word[start:][::-1], other[start:][::-1])))
    ours, theirs = word[start : len(word) - end], other[start : len(other) - end]
    if any(letter.isdigit() for letter in ours + theirs):
        return False
    if len(ours) == len(theirs) == 1:
        return bool(start and end)
    is_swapped = len(ours) == 2 and ours == theirs[::-1]
    is_added = len(ours) + len(theirs) == 1 and (end > 0 or (ours + theirs).islower())
    return is_swapped or is_added
