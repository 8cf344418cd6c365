"""Did you mean: the known word that another one is most likely a misspelling of."""

from __future__ import annotations

from collections.abc import Callable, Iterable

CLOSE = 0.84
"""How alike two words must be, from 0 to 1, for one to be offered in place of the other."""


def closest_match(
    word: str,
    known: Iterable[str],
    cutoff: float = CLOSE,
    fold: Callable[[str], str] = str.lower,
) -> str | None:
    """The known word closest to `word` once both are folded, or None if none is close."""
    from difflib import get_close_matches  # costs start-up time, and few words are misspelt

    folded = {fold(other): other for other in known}
    matches = get_close_matches(fold(word), folded, n=1, cutoff=cutoff)
    return folded[matches[0]] if matches else None


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """`; did you mean 'x'?` for what somebody typed, or nothing if nothing known is near."""
    meant = closest_match(word, known, cutoff=0.6)
    return f"; did you mean {meant!r}?" if meant else ""
