"""Arrays of strange values, types and sizes, and what the large ones cost."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from particlefields import DEGREE, SH, Field, bare, codes, found, lint, splats, write
from process import ROOT, run

from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport


@pytest.mark.parametrize(
    ("opacities", "hint"),
    [
        ("[1.15, 2.4, 3.89]", "logits"),
        ("[-2.3, 1.9, 3.9]", "logits"),
        ("[0, 128, 255]", "bytes"),
        ("[0.5, 0.6, 1.5]", "clamp"),
    ],
)
def test_the_remedy_for_opacities(
    opacities: str, hint: str, lint_text: Callable[[str], StageReport]
) -> None:
    """The logits of an opaque scan are all positive: they are no bytes for that."""
    positions = "point3f[] positions = [(0, 0, 0), (1, 1, 1), (2, 2, 2)]"
    body = f"{positions}\nfloat[] opacities = {opacities}"
    findings = [each for each in lint_text(bare(body)).findings if each.code == "ARR008"]
    assert [hint in (each.suggestion or "") for each in findings] == [True]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("= 0", "= -2147483648", ["ARR005 error"]),
        ("= 0", "= 1000000000", ["ARR004 error"]),
        ("uniform int", "uniform token", None),
        (f"uniform int {DEGREE} = 0", f'uniform string {DEGREE} = "0"', ["SCH003 error"]),
        (f"uniform int {DEGREE} = 0", f"uniform int {DEGREE} = None", ["ARR004 error"]),
        ("point3f[] positions", "double3[] positions", ["SCH003 error"]),
        ("point3f[] positions", "float3[] positions", ["SCH003 warning"]),
        (f"float3[] {SH}", f"double3[] {SH}", ["SCH003 error"]),
        ("positions = [(0, 0, 0), (1, 1, 1)]", "positions = None", ["ARR001 warning"]),
        ("positions = [(0, 0, 0), (1, 1, 1)]", "positions", ["ARR001 warning"]),
        ("    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n", "", ["SCH007 warning"]),
        ("[(1, 1, 1), (1, 1, 1)]\n", "None\n", ["ARR017 warning"]),
    ],
)
def test_strange_values(
    old: str, new: str, expected: list[str] | None, lint_text: Callable[[str], StageReport]
) -> None:
    text = bare("")
    assert old in text
    report = lint_text(text.replace(old, new, 1))
    if expected is None:  # not even a layer
        assert codes(report.findings) == ["LNT001 error"]
    else:
        assert codes(found(report)) == expected


def test_strange_types_of_optional_arrays(lint_text: Callable[[str], StageReport]) -> None:
    body = """
    double[] opacities = [7, nan, 3]
    string scales = "none"
    quatd[] orientations = [(0, 0, 0, 0)]
    half opacitiesh = 3
    half3[] scalesh = [(0.1, 0.1, 0.1), (0.1, 0.1, 0.1)]
"""
    assert set(codes(found(lint_text(bare(body))))) == {"SCH003 error"}


def test_no_particles_with_many_coefficients(engine: Engine, tmp_path: Path) -> None:
    """Nothing of what no particle has is looked at, not even NaN."""
    arrays = {"positions": np.zeros((0, 3)), SH: np.full((300_000, 3), np.nan)}
    findings = lint(engine, Field((arrays,), 3), tmp_path / "stage.usdc")
    assert codes(findings) == ["ARR001 warning"]


def test_sizes_beyond_any_integer(engine: Engine, tmp_path: Path) -> None:
    particles = Field((splats(3),), 2**31 - 1)
    (finding,) = lint(engine, particles, tmp_path / "stage.usdc")
    assert finding.message == (
        "3 coefficients, 1 for each particle; degree 2147483647 takes 4,611,686,018,427,387,904"
    )
    assert finding.suggestion == f"author {DEGREE} = 0, which fits"


def test_a_truncated_crate_ends_no_run(tmp_path: Path) -> None:
    """Arrays that end beyond the file: USD raises, reads nothing, or dies of a bus error."""
    write(Field((splats(200_000, 1),), 1), tmp_path / "whole.usdc")
    data = (tmp_path / "whole.usdc").read_bytes()
    places = int.from_bytes(data[16:24], "little")
    for number, share in enumerate((0.3, 0.7)):
        # What is left out lies in the arrays: the tables at the end are kept, and still found.
        left_out = int(places * share) // 8 * 8
        short = bytearray(data[:88] + data[88 + left_out :])
        short[16:24] = struct.pack("<q", places - left_out)
        (tmp_path / f"short{number}.usdc").write_bytes(short)
    (tmp_path / "good.usda").write_text(bare(""))
    ran = run("--isolated", "--output-format", "concise", "--jobs", "1", ".", cwd=tmp_path)
    said = {line.partition(":")[0] for line in ran.out.splitlines() if "LNT004" not in line}
    assert said == {"short0.usdc", "short1.usdc"}
    assert ran.code in (1, 2), ran.err


def test_memory_does_not_grow_with_the_particles(engine: Engine, tmp_path: Path) -> None:
    """Arrays are views on the mapped file: what is allocated is a chunk or two."""
    write(Field((splats(300_000, 2),), 2), tmp_path / "stage.usdc")
    assert (tmp_path / "stage.usdc").stat().st_size > 40_000_000
    engine.lint(str(tmp_path / "stage.usdc"))
    tracemalloc.start()
    try:
        assert found(engine.lint(str(tmp_path / "stage.usdc"))) == ()
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 12_000_000


def test_numpy_is_imported_for_particles_alone(tmp_path: Path) -> None:
    (tmp_path / "volume.usda").write_text(
        '#usda 1.0\ndef Volume "v"\n{\n    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n}\n'
        'def ParticleField "p"\n{\n}\n'
    )
    program = """
import sys
from usdvol_lint.packs.catalog import load
from usdvol_lint.config import Config, Depth
from usdvol_lint.packs.activation import activate
from usdvol_lint.engine.engine import Engine
catalog = load()
Engine(catalog.rules, activate(Config(), catalog)).lint(sys.argv[1])
sys.exit("numpy" in sys.modules)
"""
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "volume.usda")],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=False,
    )
    assert done.returncode == 0
