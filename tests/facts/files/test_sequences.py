"""Sequences: frame numbers, gaps, strays and ranges that the rule pages can not show."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest
from fieldtexts import Lint, frames, said, sampled, write

from usdvol_lint.facts.files.numbering import Numbering, find_numbering


def numbered(numbers: Iterable[float], times: Iterable[float], name: str = "./s.{:04}.vdb") -> str:
    return sampled([(time, name.format(n)) for time, n in zip(times, numbers, strict=True)])


@pytest.mark.parametrize(
    ("paths", "numbers", "groups"),
    [
        (["./s.0001.vdb", "./s.0002.vdb"], [1, 2], (0,)),
        (["./s.0010.vdb", "./s.0020.vdb"], [10, 20], (0,)),
        (["./s.9.vdb", "./s.10.vdb", "./s.11.vdb"], [9, 10, 11], (0,)),
        (["v2/s_v003.0001.vdb", "v2/s_v003.0002.vdb"], [1, 2], (2,)),
        (["s.0001.v2.vdb", "s.0002.v2.vdb"], [1, 2], (0,)),
        (["s2.1.5.vdb", "s2.2.5.vdb"], [1, 2], (1,)),
        (["s.-0001.vdb", "s.0000.vdb", "s.0001.vdb"], [-1, 0, 1], (0,)),
        (["s.0001.00.vdb", "s.0001.25.vdb", "s.0002.00.vdb"], [1, 1.25, 2], (0,)),
        (["f1/s.1.vdb", "f2/s.2.vdb", "f3/s.3.vdb"], [1, 2, 3], (0, 1)),
        (["s1", "s2", "s3"], [1, 2, 3], (0,)),
        (["s.vdb", "s.vdb"], None, ()),
        (["a.vdb", "b.vdb"], None, ()),
        (["a1.vdb", "b2.vdb"], None, ()),
        (["", ""], None, ()),
        (["s.1_0.vdb", "s.1_1.vdb"], [0, 1], (1,)),
        (["s.٣.vdb", "s.٤.vdb"], None, ()),
    ],
)
def test_frame_numbers(paths: list[str], numbers: list[float] | None, groups: tuple[int]) -> None:
    assert find_numbering(paths) == (None if numbers is None else Numbering(numbers, groups))


def test_frame_numbers_of_most() -> None:
    """A few names that are otherwise do no harm, many leave no sequence."""
    paths = ["rest.vdb", *(f"s.{frame:04}.vdb" for frame in range(1, 8))]
    found = find_numbering(paths)
    assert found is not None
    assert str(found.numbers) == "[nan, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]"
    assert find_numbering(["rest.vdb"] * 4 + paths) is None


def test_missing_samples_with_some_of_their_files(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "s.0005.vdb", "s.0009.vdb")
    there = [1, 2, 3, 4, 7, 8, 10, 11, 12, 13]
    [finding] = said(lint_text(numbered(there, there)), "AST011")
    assert finding == (
        "AST011",
        "5-6, 9",
        "no samples at 5-6, 9, in a run that is regular otherwise (3 missing, 10 there)",
        "add 5: @./s.0005.vdb@, 9: @./s.0009.vdb@ (2 of 3 files are there)",
    )


def test_missing_samples_in_the_time_of_their_layer(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 7)))
    there = [1, 2, 3, 5, 6]
    (tmp_path / "fx.usda").write_text(numbered(there, there))
    report = lint_text("#usda 1.0\n(\n    subLayers = [@./fx.usda@ (offset = 100; scale = 2)]\n)\n")
    [finding] = [finding for finding in report.findings if finding.code == "AST011"]
    assert (finding.site.layer, finding.site.line, finding.site.frames) == ("fx.usda", 9, "108")
    assert finding.suggestion == "add 4: @./s.0004.vdb@ (the file is there)"


def test_missing_samples_that_no_layer_could_take(lint_text: Lint) -> None:
    """Nobody here knows which files a server has."""
    there = [1, 2, 3, 5, 6]
    report = lint_text(numbered(there, there, "omniverse://host/s.{:04}.vdb"))
    assert [(f[1], f[3]) for f in said(report, "AST011")] == [
        ("4", "add the samples, or write the frames that are missing")
    ]


@pytest.mark.parametrize(
    ("times", "numbers", "expected"),
    [
        pytest.param([1, 2, 3, 5, 6], None, "4", id="one"),
        pytest.param([1, 2, 3, 4, 6], None, "5", id="before the last"),
        pytest.param([1, 3, 4, 5, 6], None, None, id="after a rest frame"),
        pytest.param([1, 2, 3, 5, 7, 9, 10], None, None, id="a run of its own"),
        pytest.param([*range(1, 10), 11, 13, 15, *range(16, 22)], None, None, id="a retime inside"),
        pytest.param([1, 2, 3, 5, 6], [6, 5, 4, 2, 1], "4", id="backwards"),
        pytest.param([1, 2, 3, 5, 6], [1, 2, 3, 4, 5], None, id="held"),
        pytest.param([1, 2, 3, 5, 6], [1, 1, 1, 1, 2], None, id="mostly held"),
        pytest.param([1, 2, 3, 4.5, 5.5], None, None, id="shifted"),
        pytest.param([1, 2, 3, 1001, 1002, 1003], None, None, id="two ranges"),
        pytest.param([1, 1.25, 1.5, 2, 2.25], None, "1.75", id="sub-frames"),
        pytest.param([0.1, 0.2, 0.3, 0.5, 0.6], [1, 2, 3, 5, 6], "0.4", id="tenths"),
        pytest.param([2, 4, 8, 10, 12], [1, 2, 4, 5, 6], "6", id="stretched"),
        pytest.param([1, 2, 4, 7, 11], None, None, id="irregular"),
        pytest.param([1, 2, 4, 5], None, None, id="too few"),
    ],
)
def test_gaps(
    times: list[float], numbers: list[int] | None, expected: str | None, lint_text: Lint
) -> None:
    report = lint_text(numbered(numbers or times, times, "./s.{}.vdb"))
    assert frames(report, "AST011") == ([expected] if expected else [])


def test_strays_of_a_long_sequence(lint_text: Lint, tmp_path: Path) -> None:
    """Swapped at the end, one far off, and one whose proper file is not there."""
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 41) if frame != 30))
    numbers = list(range(1, 41))
    numbers[9], numbers[29], numbers[38], numbers[39] = 20, 7, 40, 39
    [finding] = said(lint_text(numbered(numbers, range(1001, 1041))), "AST013")
    assert finding == (
        "AST013",
        "1010, 1039-1040",
        "'./s.0020.vdb' is out of the order that the other file numbers keep (3 of 40 samples)",
        "did you mean './s.0010.vdb'?",
    )


@pytest.mark.parametrize(
    ("numbers", "expected"),
    [
        pytest.param([1, 2, 3, 9, 5, 6], ["4"], id="typo"),
        pytest.param([1, 2, 3, 9, 5], [], id="too few in line"),
        pytest.param([1, 2, 3, 4, 5, 9], [], id="last"),
        pytest.param([9, 2, 3, 4, 5, 6], [], id="first"),
        pytest.param([2, 1, 3, 4, 5, 6, 7], ["1-2"], id="first two changed places"),
        pytest.param([1, 2, 3, 9, 8, 7, 7, 8, 9, 10], [], id="many"),
        pytest.param([1, 1, 1, 1, 1, 2, 1, 1], [], id="held but for one"),
    ],
)
def test_strays(numbers: list[int], expected: list[str], lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 11)))
    assert frames(lint_text(numbered(numbers, range(1, len(numbers) + 1))), "AST013") == expected


def test_strays_at_another_pace(lint_text: Lint, tmp_path: Path) -> None:
    """Thirds of a frame do not add up, and are no strays."""
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 41)))
    numbers = list(range(1, 41))
    times = [100_000 + number * 3 for number in numbers]
    assert frames(lint_text(numbered(numbers, times)), "AST013") == []
    numbers[19] = 3
    assert frames(lint_text(numbered(numbers, times)), "AST013") == ["100060"]
    times = [round(frame / 3, 9) for frame in range(1, 41)]
    assert frames(lint_text(numbered(numbers, times)), "AST013") == ["6.666667"]


def test_a_stray_that_may_be_anywhere(lint_text: Lint) -> None:
    report = lint_text(numbered([1, 2, 3, 9, 5, 6], range(1, 7), "omniverse://host/s.{:04}.vdb"))
    assert [(f[1], f[3]) for f in said(report, "AST013")] == [
        ("4", "did you mean 'omniverse://host/s.0004.vdb'?")
    ]


def test_the_range_in_words(lint_text: Lint) -> None:
    header = "(\n    startTimeCode = 1001\n    endTimeCode = 1100\n)"
    samples = [(float(frame), f"./s.{frame:04}.vdb") for frame in range(1, 101)]
    [outside] = said(lint_text(sampled(samples, header)), "AST012")
    assert outside[2:] == (
        "the samples are at 1-100, the stage's range is 1001-1100: one file is held throughout",
        "if they are to begin with the stage, change their times by 1000: no layer offset moves "
        "the stage's own layer",
    )
    inside = [(1009 + time, path) for time, path in samples[:50]]
    [held] = said(lint_text(sampled(inside, header)), "AST012")
    assert held[2] == (
        "the samples are at 1010-1059, the stage's range is 1001-1100: the first file is held "
        "until 1010 and the last file is held from 1059 on"
    )


def test_a_range_that_ends_before_it_begins_is_none(lint_text: Lint) -> None:
    header = "(\n    startTimeCode = 10\n    endTimeCode = 1\n)"
    samples = [(float(frame), f"./s.{frame:04}.vdb") for frame in range(20, 23)]
    assert said(lint_text(sampled(samples, header)), "AST012") == []
    one_frame = header.replace("10", "1")
    assert len(said(lint_text(sampled(samples, one_frame)), "AST012")) == 1


def test_clips_have_times_of_their_own(lint_text: Lint, tmp_path: Path) -> None:
    """Gaps are those of the stage, and there is nothing to paste into one layer."""
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 9)))
    there = [1, 2, 3, 4, 6, 7, 8]
    samples = "".join(f"{frame}: @./s.{frame:04}.vdb@,\n" for frame in there)
    (tmp_path / "clip.usda").write_text(
        f'#usda 1.0\nover "density"\n{{\n    asset filePath.timeSamples = {{\n{samples}}}\n}}\n'
    )
    report = lint_text(
        """#usda 1.0
def OpenVDBAsset "density" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./clip.usda@]
            string primPath = "/density"
            double2[] active = [(101, 0)]
            double2[] times = [(101, 1), (108, 8)]
        }
    }
)
{
}
"""
    )
    assert [(f[0], f[1], f[3]) for f in said(report)] == [
        ("AST011", "105", "add the samples, or write the frames that are missing")
    ]
