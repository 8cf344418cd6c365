"""The known word that an unknown one is most likely a misspelling of."""

from __future__ import annotations

from collections.abc import Callable, Iterable

CLOSE = 0.84
"""The least similarity, from 0 to 1, at which a word is offered for another."""


def closest_match(
    word: str,
    known: Iterable[str],
    cutoff: float = CLOSE,
    fold: Callable[[str], str] = str.lower,
) -> str | None:
    """The known word closest to `word` when both are folded; None if none is close enough.

    `cutoff` is the least similarity, from 0 to 1, as difflib computes it.
    """
    from difflib import get_close_matches  # costs start-up time, and few words are misspelt

    folded = {fold(other): other for other in known}
    matches = get_close_matches(fold(word), folded, n=1, cutoff=cutoff)
    return folded[matches[0]] if matches else None


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown word, `; did you mean 'x'?`; empty if none is close."""
    closest = closest_match(word, known, cutoff=0.6)
    return f"; did you mean {closest!r}?" if closest else ""
