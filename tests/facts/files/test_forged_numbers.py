"""No number in a name or at a time makes a rule fail, however long or odd it is."""

from __future__ import annotations

from collections.abc import Callable
from zipfile import ZipFile

import pytest

from usdvol_lint.facts.files.frame_names import FrameName, read_frame_name, read_lost_number
from usdvol_lint.facts.files.patterns import matching_frames
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]
DIGITS = "9" * 5000


def test_names_of_thousands_of_digits_are_no_frames() -> None:
    names = [f"a.{DIGITS}.vdb", "a.0002.vdb"]
    assert FrameName("a.", "0001", ".vdb").among(names) == {2: "a.0002.vdb"}
    assert FrameName("a.", "", ".vdb").among(names) == {2: "a.0002.vdb"}
    assert matching_frames("a.$F4.vdb", names) == [(2, "a.0002.vdb")]
    assert matching_frames("a.$F999.vdb", names) == []
    assert read_frame_name(f"{'a' * 200_000}.0001.vdb") is None
    assert read_lost_number(f"{'a' * 200_000}..vdb") is None


@pytest.mark.parametrize("name", [f"v{DIGITS}", f"v{'9' * 60_000}a"])
def test_prims_with_numbers_beside_a_numbered_file(name: str, lint_text: Lint) -> None:
    with ZipFile("a.usdz", "w") as archive:
        for number in ("0001", "0002", "0003", DIGITS):
            archive.writestr(f"smoke.{number}.vdb", "x" * 2000)
    for file in ("./a.usdz[smoke.0002.vdb]", "./a.usdz[smoke..vdb]", "./a.usdz[smoke.$F4.vdb]"):
        codes = found(lint_text, f"asset filePath = @{file}@", name)
        assert codes, "the file is no volume, or none is there"


@pytest.mark.parametrize(
    "times",
    [
        ("0", "1", "2", "3", "4", "5", "1e308", "1.1e308"),
        ("-1e308", "0", "1", "2", "3", "4", "5", "1e308"),
        tuple(f"{time}e307" for time in (*range(-17, -8), *range(10, 18))),
        ("-inf", "0", "1", "2", "3", "4", "5", "inf"),
        ("0", "1", "2", "3", "4", "5", "6", "nan"),
    ],
)
def test_times_that_no_clock_shows(times: tuple[str, ...], lint_text: Lint) -> None:
    paths = [f"@./a.{number:04}.vdb@" for number in range(len(times))]
    for hole in ([], [3], [len(times) - 2]):
        named = ["None" if number in hole else path for number, path in enumerate(paths)]
        samples = ", ".join(f"{time}: {path}" for time, path in zip(times, named, strict=True))
        assert found(lint_text, f"asset filePath.timeSamples = {{ {samples} }}")


def found(lint_text: Lint, value: str, name: str = "a") -> set[str]:
    stage = f'#usda 1.0\n(startTimeCode = 0\n endTimeCode = 5)\ndef OpenVDBAsset "{name}" {{\n'
    report = lint_text(f'{stage}{value}\ntoken fieldName = "density"\n}}')
    codes = {finding.code for finding in report.findings}
    assert not codes & {"LNT001", "LNT002"}, report.findings
    return codes
