"""Numbers and lists as sentences have them."""

from __future__ import annotations

from collections.abc import Sequence

_FEW = 3


def counts(*numbers: tuple[int, str]) -> str:
    """Those that are not zero, `2 errors, 1 warning`."""
    return ", ".join(count(number, noun) for number, noun in numbers if number)


def count(number: int, noun: str) -> str:
    """`1 stage`, `1,200 stages`; the last word of the noun is put in the plural."""
    if number == 1:
        return f"1 {noun}"
    return f"{number:,} {noun[:-1]}ies" if noun.endswith("y") else f"{number:,} {noun}s"


def few(texts: Sequence[str], every: bool = False) -> str:
    """The first of the texts, and `…` if there are more; with `every`, all of them."""
    if every or len(texts) <= _FEW:
        return ", ".join(texts)
    return ", ".join([*texts[:_FEW], "…"])


def duration(seconds: float) -> str:
    return f"{seconds:,.1f} s" if seconds >= 0.1 else f"{seconds:.2f} s"
