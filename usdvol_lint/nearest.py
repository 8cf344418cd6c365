"""The known word that an unknown one is most likely a misspelling of."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable
from itertools import islice
from posixpath import commonprefix
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from difflib import SequenceMatcher

CLOSE = 0.84
"""The least similarity, from 0 to 1, at which a word is offered for another."""
_LONG_ENOUGH = 4
_LONGEST = 1_000
"""A longer word is compared with none: it takes as long as the squares of both lengths."""
_MANY = 5_000
"""Of more words than that, those are compared that begin or end as the unknown one does."""
_COMPARED = 500
"""So many are compared in full, those first that share most letters with the unknown one."""
_JUNK_FROM = 200
"""From so many letters on difflib does not begin a match with those that are frequent."""
_NUMBER = re.compile(r"[0-9]+")


class Vocabulary:
    """Known words, among which the closest to unknown ones is sought, both folded."""

    def __init__(self, known: Iterable[str], fold: Callable[[str], str] = str.lower) -> None:
        self._fold = fold
        self._folded = {fold(word): word for word in known}
        self._by_length: dict[int, list[str]] = defaultdict(list)
        for word in self._folded:
            self._by_length[len(word)].append(word)
        self._letters = _Letters()
        self._lettered: dict[int, list[tuple[int, str]]] = {}

    def closest(self, word: str, cutoff: float = CLOSE) -> str | None:
        """The known word closest to `word`; None if none is close enough.

        `cutoff` is the least similarity, from 0 to 1, as difflib computes it.
        """
        ours = self._fold(word)
        if len(ours) > _LONGEST:
            return None
        letters = self._letters.of(ours)
        close: list[tuple[float, str]] = []
        for length, others in self._of_like_length(ours, cutoff).items():
            total = len(ours) + length
            least = _least_shared(total, cutoff)
            close += [
                (_similarity(shared, total), other)
                for other_letters, other in others
                if (shared := (letters & other_letters).bit_count()) >= least
            ]
        best = _most_similar(ours, close, cutoff) if close else None
        return None if best is None else self._folded[best]

    def _of_like_length(self, word: str, cutoff: float) -> dict[int, list[tuple[int, str]]]:
        """The words that may be this similar, as far as their length says: by it, with letters."""
        own = len(word)
        lengths = [
            length
            for length in self._by_length
            if _similarity(min(own, length), own + length) >= cutoff
        ]
        if sum(len(self._by_length[length]) for length in lengths) <= _MANY:
            return {length: self._of_length(length) for length in lengths}
        known = {*lengths}
        groups: dict[int, list[tuple[int, str]]] = defaultdict(list)
        for other in _with_shared_end(word, filter(lambda each: len(each) in known, self._folded)):
            groups[len(other)].append((self._letters.of(other), other))
        return groups

    def _of_length(self, length: int) -> list[tuple[int, str]]:
        """The words of a length, each with its letters."""
        if length not in self._lettered:
            words = self._by_length[length]
            self._lettered[length] = [(self._letters.of(word), word) for word in words]
        return self._lettered[length]


class _Letters(dict[tuple[str, int], int]):
    """A bit for the first, the second, … of each letter; by letter and number, those up to it.

    So two words share as many letters, in whatever order, as they share bits.
    """

    def of(self, word: str) -> int:
        """The bits of all letters of a word."""
        letters = {*word}
        return sum(map(self.__getitem__, zip(letters, map(word.count, letters), strict=True)))

    def __missing__(self, key: tuple[str, int]) -> int:
        letter, count = key
        bits = 0
        for number in range(1, count + 1):
            bits = self.setdefault((letter, number), bits | 1 << len(self))
        return bits


def closest_match(
    word: str,
    known: Iterable[str],
    cutoff: float = CLOSE,
    fold: Callable[[str], str] = str.lower,
) -> str | None:
    """The known word closest to one word, as of a `Vocabulary`."""
    return Vocabulary(known, fold).closest(word, cutoff)


def _similarity(shared: int, total: int) -> float:
    """How similar words are that share so many letters of their total, in the same order."""
    return 2 * shared / total if total else 1.0


def _least_shared(total: int, cutoff: float) -> int:
    """The least number of letters that words of that total share, if they are this similar."""
    shared = max(int(cutoff * total / 2) - 1, 0)
    while _similarity(shared, total) < cutoff and shared < total:
        shared += 1
    return shared


def _with_shared_end(word: str, others: Iterable[str]) -> list[str]:
    """Words that share half of the word: one slip is in the other half."""
    half = (len(word) - 1) // 2
    start, end = word[:half], word[len(word) - half :]
    alike = (other for other in others if other.startswith(start) or other.endswith(end))
    return list(islice(alike, _MANY))


def _most_similar(word: str, close: list[tuple[float, str]], cutoff: float) -> str | None:
    """The most similar word, the last of several; `close` are words, each after a bound."""
    matcher = None
    best = cutoff, ""
    found = False
    for bound, other in sorted(close, reverse=True)[:_COMPARED]:
        if (bound, other) < best:
            break
        similar = bound
        if not _is_part(word, other):
            matcher = matcher or _matcher(word)
            matcher.set_seq1(other)
            similar = matcher.ratio()
        if (similar, other) >= best:
            best, found = (similar, other), True
    return best[1] if found else None


def _is_part(word: str, other: str) -> bool:
    """Whether one of the words stands in the other: then all letters that they share match."""
    return len(word) < _JUNK_FROM and (other in word or word in other)


def _matcher(word: str) -> SequenceMatcher[str]:
    from difflib import SequenceMatcher  # costs start-up time, and few words are misspelt

    return SequenceMatcher(None, "", word)


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
