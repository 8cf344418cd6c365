"""What was found of a scene, held against what must be found."""

from __future__ import annotations

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
    wanted = [each for each in findings if (each.code, each.prim) == expected[:2]]
    said = [each for each in findings if each.severity != "info"]
    missed = []
    if expected.code and not wanted:
        missed.append(f"no {expected.code} at {expected.prim}")
    if expected.is_info:
        said += [each for each in wanted if each.severity != "info"]
    for code in expected.also:
        if code not in {each.code for each in said}:
            missed.append(f"no {code}, to which it leads")
    for each in said:
        if each in wanted and not expected.is_info:
            continue
        if each.code not in (*expected.also, *expected.perhaps):
            missed.append(f"{each.severity} {each.code} at {each.prim}: {each.message}")
    return missed
