"""Gaps in sequences where a condition turns."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import pytest

from usdvol_lint.model import Finding, StageReport

Lint = Callable[[str], StageReport]


def stage(samples: Iterable[tuple[float, str]]) -> str:
    """A Volume whose field has these samples."""
    lines = "".join(f"{time}: @{path}@,\n" for time, path in samples)
    return f"""#usda 1.0
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </cloud/density>
    def OpenVDBAsset "density"
    {{
        token fieldName = "density"
        asset filePath.timeSamples = {{
{lines}}}
    }}
}}
"""


def gaps(lint: Lint, times: Sequence[float], numbers: Sequence[int]) -> list[Finding]:
    """What AST011 finds, or that it failed."""
    paths = [f"./fog.{number:04}.vdb" for number in numbers]
    report = lint(stage(zip(times, paths, strict=True)))
    return [finding for finding in report.findings if finding.code in ("AST011", "LNT002")]


@pytest.mark.parametrize(
    "jump",
    [
        pytest.param(2.4, id="no multiple of the step"),
        pytest.param(1.00005, id="rounded otherwise"),
    ],
)
def test_a_step_that_leaves_nothing_out(jump: float, lint_text: Lint) -> None:
    times = [1, 2, 3, 4, 4 + jump, 5 + jump, 6 + jump]
    assert not gaps(lint_text, times, [1, 2, 3, 4, *(range(4 + round(jump), 7 + round(jump)))])
    assert gaps(lint_text, [1, 2, 3, 4, 6, 7, 8], [1, 2, 3, 4, 6, 7, 8])


@pytest.mark.parametrize(
    ("times", "frames"),
    [
        ([1, 2, 3, 4, 5, 7, 9, 10, 11, 12, 13], ["6, 8"]),
        ([*range(1, 10), 11, 13, *range(15, 24)], []),  # played faster for a while
    ],
)
def test_gaps_side_by_side(times: list[float], frames: list[str], lint_text: Lint) -> None:
    numbers = list(map(int, times))
    assert [finding.site.frames for finding in gaps(lint_text, times, numbers)] == frames


@pytest.mark.parametrize(("missing", "more"), [(4, False), (5, True)])
def test_samples_to_add(missing: int, more: bool, lint_text: Lint, tmp_path: Path) -> None:
    after = 9 + missing
    for number in range(9, after):
        (tmp_path / f"fog.{number:04}.vdb").write_bytes(b"x")
    there = [*range(1, 9), *range(after, after + 8)]
    [finding] = gaps(lint_text, there, there)
    assert finding.suggestion is not None
    assert finding.suggestion.startswith("add 9: @./fog.0009.vdb@, 10: ")
    assert (", …" in finding.suggestion) == more
    assert finding.suggestion.endswith(f"({missing} of {missing} files are there)")


def test_one_path_of_five_may_be_another(lint_text: Lint) -> None:
    paths = ["./rest.vdb", *(f"./fog.{number:04}.vdb" for number in (2, 3, 4, 6))]
    report = lint_text(stage(zip([1, 2, 3, 4, 6], paths, strict=True)))
    assert [f.site.frames for f in report.findings if f.code == "AST011"] == ["5"]


def test_what_stands_where_numbers_do(lint_text: Lint) -> None:
    """A letter is no number, and ends no rule."""
    paths = [f"./s{name}.vdb" for name in "12345x"]
    report = lint_text(stage(zip([1, 2, 3, 4, 5, 7], paths, strict=True)))
    assert not [f for f in report.findings if f.code in ("AST011", "AST013", "LNT002")]
