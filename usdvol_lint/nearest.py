"""The known word that an unknown one is most likely a misspelling of."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from itertools import islice
from posixpath import commonprefix

CLOSE = 0.84
"""The least similarity, from 0 to 1, at which a word is offered for another."""
_LONG_ENOUGH = 4
_LONGEST = 1_000
"""A longer word is compared with none: it takes as long as the squares of both lengths."""
_MANY = 5_000
"""Of more words than that, those are compared that begin or end as the unknown one does."""
_COMPARED = 500
"""So many are compared in full, those first that share most letters with the unknown one."""
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
    if len(ours) > _LONGEST:
        return None
    folded = {
        theirs: other
        for other in known
        if _allows(ours, theirs := fold(other), min(len(ours), len(theirs)), cutoff)
    }
    alike = _with_shared_end(ours, folded) if len(folded) > _MANY else folded
    bounds = ((_shared_letters(ours, theirs), theirs) for theirs in alike)
    close = [each for each in bounds if _allows(ours, each[1], each[0], cutoff)]
    best = _most_similar(ours, close, cutoff) if close else None
    return None if best is None else folded[best]


def _allows(word: str, other: str, shared: int, cutoff: float) -> bool:
    """Whether two words that share so many letters, in whatever order, may be this similar."""
    total = len(word) + len(other)
    return not total or 2 * shared / total >= cutoff


def _shared_letters(word: str, other: str) -> int:
    return sum(min(word.count(letter), other.count(letter)) for letter in {*word})


def _with_shared_end(word: str, others: Iterable[str]) -> list[str]:
    """Words that share half of the word: one slip is in the other half."""
    half = (len(word) - 1) // 2
    start, end = word[:half], word[len(word) - half :]
    alike = (other for other in others if other.startswith(start) or other.endswith(end))
    return list(islice(alike, _MANY))


def _most_similar(word: str, close: Iterable[tuple[int, str]], cutoff: float) -> str | None:
    """The most similar word, the last of several; `close` are words, each with a bound."""
    from difflib import SequenceMatcher  # costs start-up time, and few words are misspelt

    matcher = SequenceMatcher(None, "", word)
    best = cutoff, ""
    found = False
    ordered = sorted(close, key=lambda each: _bound(word, *each), reverse=True)
    for shared, other in ordered[:_COMPARED]:
        if _bound(word, shared, other) < best:
            break
        matcher.set_seq1(other)
        similar = matcher.ratio(), other
        if similar >= best:
            best, found = similar, True
    return best[1] if found else None


def _bound(word: str, shared: int, other: str) -> tuple[float, str]:
    """The most that two words that share so many letters may be similar, and the other word."""
    total = len(word) + len(other)
    return (2 * shared / total if total else 1.0), other


def are_swapped(word: str, other: str) -> bool:
    """Whether two letters that stand side by side are swapped, and nothing else differs."""
    if len(word) != len(other) or word == other:
        return False
    at = len(commonprefix((word, other)))
    return other == f"{word[:at]}{word[at + 1 : at + 2]}{word[at]}{word[at + 2 :]}"


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
