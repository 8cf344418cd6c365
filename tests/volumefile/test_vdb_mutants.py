"""The OpenVDB reader against files that were changed anywhere."""

from __future__ import annotations

import struct
import time
from math import inf, nan
from pathlib import Path

import vdbwriter as w
from attempts import memory_below, outcome, with_each_byte_changed
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from process import SAMPLES


def _everything() -> bytes:
    """A file with every trait, small enough to change anywhere."""
    return w.vdb(
        w.Grid(
            "density\x1e0",
            metadata={
                "name": w.string("density"),
                "class": w.string("fog volume"),
                **w.bounds((0, 0, 0), (9, 9, 9)),
            },
        ),
        w.Grid("density\x1e1", "Tree_vec3s_5_4_3_HalfFloat", transform=w.affine(*w.UNIT)),
        w.Grid("i", parent="density\x1e0", transform=w.scale_translate((1, 2, 3), (4, 5, 6))),
        w.Grid(
            "f",
            transform=w.frustum((0, 0, 0), (9, 9, 9), 0.5, 2),
            metadata={"name": w.string("f"), **w.bounds((0, 0, 0), (9, 9, 9))},
        ),
        metadata_bytes=w.metadata({"creator": w.string("Houdini"), "v": w.value("vec3d", 1, 2, 3)}),
    )


SEEDS = [
    _everything(),
    w.vdb(w.Grid("s"), w.Grid("t"), seekable=False),
    *((SAMPLES / name).read_bytes() for name in ("lib12_float_half.vdb", "empty_grid.vdb")),
]
WORDS = [
    *(struct.pack("<i", n) for n in (0, 1, -1, 2**31 - 1, -(2**31), 65536, 100_000, 1 << 20)),
    *(struct.pack("<q", n) for n in (0, 1, -1, 2**63 - 1, -(2**63), 65, 500)),
    *(struct.pack("<d", n) for n in (0.0, nan, inf, 1e308, 5e-324)),
    *(b"\0", b"\xff", b"\x80", b"\x1e", w.text("NonlinearFrustumMap"), w.text("__x")),
]
CODES = {"not-a-volume-file", "truncated", "version-unsupported", "not-a-file"}


@st.composite
def mutants(draw: st.DrawFn) -> bytes:
    content = bytearray(draw(st.sampled_from(SEEDS)))
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, min(len(content), 1500)))
        word = draw(st.sampled_from(WORDS) | st.binary(min_size=1, max_size=8))
        match draw(st.integers(0, 3)):
            case 0 | 1:
                content[at : at + len(word)] = word
            case 2:
                content[at:at] = word
            case _:
                del content[at : at + draw(st.integers(1, 40))]
    return bytes(content)


def survives(path: Path, offset: int = 0, size: int | None = None) -> None:
    """Reading gives a file whose parts can be used, or the one kind of error."""
    start = time.perf_counter()
    code, file = outcome(str(path), offset, size)
    assert code is None or code in CODES
    if file is not None:
        assert file.complete == (code is None and len(file.grids) == file.grid_count)
    for grid in file.grids if file else ():
        grid.world_bounds(0.5)
    assert time.perf_counter() - start < 1


@settings(
    max_examples=2000,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(content=mutants())
def test_mutants_raise_nothing_else(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "mutant.vdb"
    path.write_bytes(content)
    survives(path)


@settings(
    max_examples=200,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(content=mutants())
def test_mutants_take_little_memory(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "mutant.vdb"
    path.write_bytes(content)
    with memory_below(len(content) + (8 << 20)):
        survives(path)


def test_every_byte_of_a_head_may_be_anything(tmp_path: Path) -> None:
    """Each byte on its own, at its extremes: what generated mutants may miss."""
    whole, path = _everything(), tmp_path / "bytes"
    for start in with_each_byte_changed(whole, path):
        survives(path, start, len(whole))
