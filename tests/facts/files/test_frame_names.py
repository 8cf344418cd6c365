"""File names that end in a frame number, and those that only look so."""

from __future__ import annotations

import pytest

from usdvol_lint.facts.files.frame_names import FrameName, read_frame_name, read_lost_number


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("smoke.0004.vdb", 4),
        ("smoke_1001.vdb", 1001),
        ("smoke004.vdb", 4),
        ("004.vdb", 4),
        ("wave.0004.vdb", 4),
        ("explosionX_v2.0004.vdb", 4),
        ("smoke.04.vdb", None),
        ("smoke.vdb", None),
        ("smoke_v004.vdb", None),
        ("smoke_V004.vdb", None),
        ("smokeVer004.vdb", None),
        ("take.0004.vdb", None),
        ("smokeModel_0004.vdb", None),
        ("img_0004.vdb", None),
        ("cloudLOD0004.vdb", None),
        ("smoke_256x256.vdb", None),
        ("smoke_20240115.vdb", None),
    ],
)
def test_a_frame_number_is_told_from_other_numbers(name: str, number: int | None) -> None:
    found = read_frame_name(name)
    assert (found.number if found else None) == number


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("smoke..vdb", FrameName("smoke.", "", ".vdb")),
        ("smoke_.vdb", FrameName("smoke_", "", ".vdb")),
        ("smoke.vdb", None),
    ],
)
def test_what_stands_before_a_number_that_got_lost(name: str, found: FrameName | None) -> None:
    assert read_lost_number(name) == found


def test_names_that_differ_in_the_number_alone() -> None:
    frame = FrameName("a.", "0004", ".vdb")
    names = ["a.0003.vdb", "a.10000.vdb", "a.003.vdb", "a.00003.vdb", "b.0003.vdb", "a.0003.nvdb"]
    assert frame.among(names) == {3: "a.0003.vdb", 10000: "a.10000.vdb"}
    assert FrameName("a.", "", ".vdb").among(names) == {
        3: "a.00003.vdb",
        10000: "a.10000.vdb",
    }
