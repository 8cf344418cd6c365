"""What was found of a scene, held against what must be found."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from .model import Expected


class Found(NamedTuple):
    """What counts of a finding."""

    code: str
    severity: str
    prim: str | None
    message: str


_OF_THE_USD = {"LNT004"}
"""Findings about the installed USD and not the stage."""


def misses(expected: Expected, found: Iterable[Found]) -> list[str]:
    """Each way in which it is not as expected, in one line."""
    findings = [each for each in found if each.code not in _OF_THE_USD]
    wanted = [each for each in findings if _is_wanted(each, expected)]
    codes = {each.code for each in findings}
    allowed = (*expected.also, *expected.perhaps)
    missed = [f"no {code}, to which it leads" for code in expected.also if code not in codes]
    if expected.code:
        places = {_first_copy(each.prim) for each in wanted}
        lacking = [prim for prim in (expected.prim, *expected.others) if prim not in places]
        missed = [*(f"no {expected.code} at {prim}" for prim in lacking), *missed]
    return missed + [
        f"{each.severity} {each.code} at {each.prim}: {each.message}"
        for each in findings
        if each.severity != "info" and each not in wanted and each.code not in allowed
    ]


def _is_wanted(found: Found, expected: Expected) -> bool:
    """Whether it is what must be found, at the level of an information or above it."""
    return (
        found.code == expected.code
        and _first_copy(found.prim) in (expected.prim, *expected.others)
        and (found.severity == "info") == expected.is_info
    )


def _first_copy(prim: str | None) -> str | None:
    """Of an instance's second copy the path of the first: what is on instances is on both."""
    return prim and re.sub(r"_b(?=/|$)", "_a", prim)
