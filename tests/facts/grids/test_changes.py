"""Which frames hold other grids than most: what decides, and what is said of the first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
import vdbwriter as w

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]
DENSITY = 'token fieldName = "density"'
FLOAT = 'token fieldDataType = "float"'


def holding(*grids: str) -> bytes:
    """A file with these grids, of floats if no type follows the name."""
    split = (each.partition(" ") for each in grids)
    return w.vdb(*(w.Grid(name, f"Tree_{kind or 'float'}_5_4_3") for name, _, kind in split))


ONE = holding("density")
TWO = holding("density", "heat")
FEW = holding("density", "a", "b", "c")
MANY = holding("density", "a", "b", "c", "d")


@pytest.mark.parametrize(
    ("files", "statements", "frames", "words"),
    [
        pytest.param([ONE, TWO, TWO], [DENSITY], "1", "lacks 'heat'", id="lacking"),
        pytest.param(
            [TWO, holding("heat", "density"), ONE, TWO],
            [DENSITY],
            "3",
            "lacks 'heat'",
            id="grids in another order are the same",
        ),
        pytest.param([FEW, ONE, ONE], [DENSITY], "1", "also has 'a', 'b', 'c'", id="three"),
        pytest.param([MANY, ONE, ONE], [DENSITY], "1", "also has 'a' and 3 more", id="four"),
        pytest.param(
            [holding("density", "density"), ONE, ONE],
            [DENSITY],
            "1",
            "has 'density' as float and float instead of float",
            id="two of a name",
        ),
        pytest.param([TWO[:-40], ONE, ONE], [DENSITY], None, "", id="a file that is cut short"),
        pytest.param([w.vdb(), TWO, ONE, TWO], [], "3", "lacks 'heat'", id="no name, no grids"),
        pytest.param(
            [TWO, FEW, FEW],
            [FLOAT],
            "1",
            "lacks 'a', 'b', 'c', also has 'heat'",
            id="no name, but a type",
        ),
    ],
)
def test_frames_that_differ(
    files: Sequence[bytes],
    statements: Sequence[str],
    frames: str | None,
    words: str,
    lint_text: Lint,
    tmp_path: Path,
) -> None:
    samples = []
    for frame, data in enumerate(files, start=1):
        (tmp_path / f"fog.{frame}.vdb").write_bytes(data)
        samples.append(f"{frame}: @./fog.{frame}.vdb@")
    lines = "\n".join([*statements, f"asset filePath.timeSamples = {{{', '.join(samples)}}}"])
    report = lint_text(
        f"""#usda 1.0
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </cloud/density>
    def OpenVDBAsset "density"
    {{
{lines}
    }}
}}
"""
    )
    found = [finding for finding in report.findings if finding.code == "GRD013"]
    assert [finding.site.frames for finding in found] == ([frames] if frames else [])
    assert all(f" {words}, unlike most" in finding.message for finding in found)
