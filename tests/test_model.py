"""Frames are compressed as people write them; findings are sorted and unique."""

from __future__ import annotations

import math
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdvol_lint.model import Cover, Finding, Severity, Site, Source, in_order
from usdvol_lint.words import format_time, frame_ranges, from_to


@pytest.mark.parametrize(
    ("times", "text"),
    [
        ((), ""),
        ((7,), "7"),
        ((7, 8), "7-8"),
        ((7, 9), "7, 9"),
        ((7, 8, 9), "7-9"),
        ((102, 103, 104, 117), "102-104, 117"),
        ((0, 2, 4, 6, 8, 10), "0-10x2"),
        ((0, 2, 4, 5, 6), "0-4x2, 5-6"),
        ((1, 3, 4, 5, 9), "1, 3-5, 9"),
        ((-2, -1, 0, 1), "-2 to 1"),
        ((-4, -2, 0, 5), "-4 to 0x2, 5"),
        ((0, 0.5, 1, 1.5), "0-1.5x0.5"),
        ((1.25, 1.5), "1.25, 1.5"),
        ((4.999999995559108, 6, 7), "5-7"),
        ((1 / 24, 2 / 24, 3 / 24), "0.041667-0.125x0.041667"),
        ((0, 10, 20, 21, 22), "0-20x10, 21-22"),
    ],
)
def test_frame_ranges(times: tuple[float, ...], text: str) -> None:
    assert frame_ranges([float(time) for time in times]) == text


@pytest.mark.parametrize(
    ("time", "text"),
    [
        (101.0, "101"),
        (101.5, "101.5"),
        (-0.0, "0"),
        (2.0**53, "9007199254740992"),
        (2.0**60, "1.152921504606847e+18"),
        (1e-9, "0"),
        (float("inf"), "inf"),
        (float("nan"), "nan"),
    ],
)
def test_format_time(time: float, text: str) -> None:
    assert format_time(time) == text


@given(st.sets(st.integers(-500, 500)))
def test_frame_ranges_name_exactly_the_frames(frames: set[int]) -> None:
    named: list[int] = []
    for part in filter(None, frame_ranges(sorted(map(float, frames))).split(", ")):
        ends, _, step = part.partition("x")
        first, *others = ends.split(" to " if " to " in ends or ends.startswith("-") else "-")
        last = others[0] if others else first
        named += range(int(first), int(last) + 1, int(step or 1))
    assert named == sorted(frames)


@pytest.mark.parametrize(
    ("first", "last", "text"),
    [
        (1, 10, "1-10"),
        (0.5, 2, "0.5-2"),
        (-3, 1, "-3 to 1"),
        (-99, -95, "-99 to -95"),
        (-math.inf, math.inf, "-inf to inf"),
        (-1e300, 1e300, "-1e+300 to 1e+300"),
        (0, 2.0**53, "0-9007199254740992"),
    ],
)
def test_from_to(first: float, last: float, text: str) -> None:
    assert from_to(first, last) == text


def test_frames_of_a_site() -> None:
    assert Site("a.usda").frames is None
    assert Site("a.usda", at_default=True).frames is None
    assert Site("a.usda", times=(1.0, 2.0, 3.0)).frames == "1-3"
    assert Site("a.usda", times=(1.0, 2.0, 3.0), at_default=True).frames == "default, 1-3"


FOUND = Finding(
    "AST002",
    "file-missing",
    Severity.ERROR,
    "no file at 'a.vdb'",
    Site("shots/a.usda", "/smoke", "filePath", line=3, column=1),
    Source("/shots/a.usda", "/smoke", "filePath"),
    Cover(Severity.ERROR),
)


def test_findings_are_sorted_and_unique_whatever_their_order() -> None:
    findings = [
        FOUND._replace(site=FOUND.site._replace(prim=prim, line=line), code=code, message=message)
        for prim in (None, "/a", "/b")
        for line in (None, 3, 4)
        for code in ("AST002", "GRD001")
        for message in ("one", "two")
    ]
    expected = in_order(findings)
    assert len(expected) == len(findings)
    places = [(f.site.prim or "", f.site.line or 0, f.code, f.message) for f in expected]
    assert places == sorted(places)
    for seed in range(5):
        shuffled = findings * 2
        random.Random(seed).shuffle(shuffled)
        assert in_order(shuffled) == expected
