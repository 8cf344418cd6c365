"""The OpenVDB reader against files that lie, and files that are cut off."""

from __future__ import annotations

import time
from collections.abc import Callable
from math import inf, nan
from pathlib import Path

import pytest
import vdbwriter as w
from attempts import Reader, memory_below, outcome, refusal, refusal_of_file
from process import SAMPLES

from usdvol_lint.volumefile import Metadatum, read_volume_file


def _lie(start: int, blocks: int, end: int) -> Callable[[int, int, int], tuple[int, int, int]]:
    return lambda *_: (start, blocks, end)


LIES: dict[str, tuple[bytes, str]] = {
    "grids-2^31": (w.vdb(w.Grid(), count=2**31), "not-a-volume-file"),
    "grids-2^31-1": (w.vdb(w.Grid(), count=2**31 - 1), "not-a-volume-file"),
    "grids-100000": (w.vdb(w.Grid(), count=100_000), "truncated"),
    "grids-one-more": (w.vdb(w.Grid(), count=2), "truncated"),
    "name-4-gib": (
        w.vdb(w.Grid(b"")).replace(b"\x00\x00\x00\x00\x10", b"\xff" * 4 + b"\x10"),
        "not-a-volume-file",
    ),
    "entries-4-g": (w.vdb(metadata_bytes=b"\xff\xff\xff\xff"), "not-a-volume-file"),
    "entries-1000": (w.vdb(metadata_bytes=w.metadata({}, count=1000)), "truncated"),
    "entry-unnamed": (w.vdb(metadata_bytes=w.metadata({"": w.string("x")})), "not-a-volume-file"),
    "entry-key-long": (
        w.vdb(metadata_bytes=w.metadata({}, w.text(b"", 2**32 - 1) + bytes(9), 1)),
        "not-a-volume-file",
    ),
    "value-4-gib": (
        w.vdb(metadata_bytes=w.metadata({}, w.metadatum("a", "string", b"", 2**32 - 1), 1)),
        "truncated",
    ),
    "value-4-gib-opaque": (
        w.vdb(metadata_bytes=w.metadata({}, w.metadatum("a", "blob", b"", 2**32 - 1), 1)),
        "truncated",
    ),
    "value-size": (
        w.vdb(metadata_bytes=w.metadata({}, w.metadatum("a", "int32", bytes(8)), 1)),
        "not-a-volume-file",
    ),
    "value-out-of-section": (
        w.vdb(
            w.Grid(raw_metadata=w.metadata({}, w.metadatum("a", "x", b"", 2000), 1)),
            w.Grid(voxels=bytes(4000)),
        ),
        "not-a-volume-file",
    ),
    "offsets-zero": (w.vdb(w.Grid(offsets=_lie(0, 0, 0))), "not-a-volume-file"),
    "offsets-backward": (w.vdb(w.Grid(offsets=lambda a, b, c: (a, c, b))), "not-a-volume-file"),
    "offsets-loop": (w.vdb(w.Grid(offsets=_lie(65, 65, 65)), count=1), "not-a-volume-file"),
    "offsets-negative": (w.vdb(w.Grid(offsets=_lie(-1, -1, -1))), "not-a-volume-file"),
    "offsets-2^63-1": (w.vdb(w.Grid(offsets=_lie(*(2**63 - 1,) * 3))), "truncated"),
    "blocks-before-transform": (
        w.vdb(w.Grid(offsets=lambda a, b, c: (a, a + 40, c))),
        "not-a-volume-file",
    ),
    "end-one-more": (w.vdb(w.Grid(offsets=lambda a, b, c: (a, b, c + 1))), "truncated"),
    "instance-end": (
        w.vdb(w.Grid("a"), w.Grid("b", parent="a", offsets=lambda a, b, c: (a, b, c - 1))),
        "not-a-volume-file",
    ),
    "map-unknown": (w.vdb(w.Grid(transform=w.text("HelixMap"))), "not-a-volume-file"),
    "map-nameless": (w.vdb(w.Grid(transform=w.text(""))), "not-a-volume-file"),
    "map-name-long": (w.vdb(w.Grid(transform=w.text("x" * 300))), "not-a-volume-file"),
    "type-long": (w.vdb(w.Grid(type="x" * 1025)), "not-a-volume-file"),
    "name-long": (w.vdb(w.Grid("x" * 65537)), "not-a-volume-file"),
    "nan-affine": (w.vdb(w.Grid(transform=w.affine(nan, *w.UNIT[1:]))), "not-a-volume-file"),
    "nan-last-column": (w.vdb(w.Grid(transform=w.affine(*w.UNIT[:-1], nan))), "not-a-volume-file"),
    "inf-scale": (w.vdb(w.Grid(transform=w.scale(inf, 1, 1))), "not-a-volume-file"),
    "nan-translation": (w.vdb(w.Grid(transform=w.translation(0, 0, nan))), "not-a-volume-file"),
    "nan-scale-translate": (
        w.vdb(w.Grid(transform=w.scale_translate((1, 1, 1), (0, inf, 0)))),
        "not-a-volume-file",
    ),
    "frustum-in-frustum": (
        w.vdb(
            w.Grid(
                transform=w.frustum(
                    (0, 0, 0), (1, 1, 1), 1, 1, w.frustum((0, 0, 0), (1, 1, 1), 1, 1)
                )
            )
        ),
        "not-a-volume-file",
    ),
    "frustum-flat": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 0, 1), 1, 1))),
        "not-a-volume-file",
    ),
    "frustum-taper": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 1, 1), 0, 1))),
        "not-a-volume-file",
    ),
    "frustum-depth": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 1, 1), 1, nan))),
        "not-a-volume-file",
    ),
    "frustum-nan-map": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 1, 1), 1, 1, w.scale(nan, 1, 1)))),
        "not-a-volume-file",
    ),
}


@pytest.mark.parametrize(("content", "code"), LIES.values(), ids=LIES)
def test_lies_are_told(read: Reader, content: bytes, code: str) -> None:
    with memory_below(2 << 20):
        start = time.perf_counter()
        error = refusal(read, content)
        assert time.perf_counter() - start < 1
    assert error.code == code
    assert error.offset is not None
    assert error.offset >= 0
    assert len(str(error)) < 300
    assert error.partial is not None
    assert (error.partial.version, error.partial.library) == ("224", "10.0")


def test_an_error_says_where_and_what_came_before(read: Reader) -> None:
    good, bad = w.Grid("good"), w.Grid("bad", transform=w.text("HelixMap"))
    content = w.vdb(good, bad)
    error = refusal(read, content)
    assert error.message == "unknown transform 'HelixMap'"
    assert error.offset == content.index(b"HelixMap") - 4
    assert str(error) == f"unknown transform 'HelixMap' (at byte {error.offset})"
    assert error.partial is not None
    assert [grid.name for grid in error.partial.grids] == ["good"]
    assert (error.partial.complete, error.partial.grid_count) == (False, 2)


def test_promised_grids_need_room(read: Reader) -> None:
    """No work is done for a number that the file can't hold."""
    error = refusal(read, w.vdb(w.Grid(), count=100_000))
    assert (error.code, error.offset) == ("truncated", 65)
    assert error.partial is not None
    assert (error.partial.grids, error.partial.complete) == ((), False)


def test_truncated_voxels_leave_the_grid_readable(read: Reader) -> None:
    content = w.vdb(w.Grid("a"), w.Grid("b"))
    error = refusal(read, content[:-1])
    assert (error.code, error.offset) == ("truncated", len(content) - 1)
    assert str(len(content)) in error.message
    assert error.partial is not None
    assert [grid.name for grid in error.partial.grids] == ["a", "b"]
    assert not error.partial.complete


def test_many_entries_take_memory_in_proportion(read: Reader) -> None:
    one = w.metadatum("same", "bool", b"\1")
    content = w.vdb(metadata_bytes=w.metadata({}, one * 20_000, 20_000))
    with memory_below(len(content) + (8 << 20)):
        assert read(content).metadata == {"same": Metadatum("bool", True, 1)}


def test_texts_that_nobody_asks_for_are_passed_over(read: Reader) -> None:
    """However many and long they are, and what is asked for is read behind them."""
    long = [(f"m{number}", w.string(b"x" * (1 << 20))) for number in range(12)]
    many = [(f"n{number}", w.string(b"x" * 60_000)) for number in range(200)]
    short = [(f"s{number}", w.string(b"x" * 100)) for number in range(2000)]
    file = w.metadata(dict(long + many + short))
    grid = w.Grid(metadata={"name": w.string("density"), "class": w.string("level set")})
    content = w.vdb(grid, metadata_bytes=file)
    with memory_below(len(content) + (6 << 20)):
        found = read(content)
    assert (found.grids[0].name, found.grids[0].grid_class) == ("density", "level set")
    kept = [value.value for value in found.metadata.values() if value.value is not None]
    assert 60 < len(kept) < 1000


def test_names_without_end_are_refused(read: Reader, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("usdvol_lint.volumefile.window._MOST_TEXT", 1 << 20)
    grids = [w.Grid("d" * 60_000, metadata={}) for _ in range(20)]
    error = refusal(read, w.vdb(*grids))
    assert (error.code, error.message) == ("not-a-volume-file", "more than 1 MiB of names")


WHOLE = sorted(SAMPLES.glob("*.vdb"))


@pytest.mark.parametrize("path", WHOLE, ids=lambda path: path.name)
def test_every_cut_is_noticed(path: Path) -> None:
    whole = read_volume_file(str(path))
    size = path.stat().st_size
    last = path.read_bytes().rfind(b"Tree_")
    cuts = {1, 4, 7, 8, 12, 20, 21, 30, 57, 60, 64, 65, 90, 130, 200, 300, size - 1, size // 2}
    cuts |= set(range(0, min(size, 900), 3)) | set(range(97, size, 97))
    cuts |= {last + step for step in range(0, 700, 11)}
    for cut in sorted(cut for cut in cuts if 0 <= cut < size):
        code, file = outcome(str(path), 0, cut)
        if code is None:
            assert whole.streamed, cut  # nothing else can do without its end
        else:
            assert code == ("truncated" if cut else "not-a-file"), cut
        before = [grid.label for grid in file.grids] if file else []
        assert before == [grid.label for grid in whole.grids[: len(before)]]


@pytest.mark.parametrize("cut", [4, 8, 12, 30, 60, 400, 10_000])
def test_cut_files_are_noticed_as_cut_views_are(tmp_path: Path, cut: int) -> None:
    whole = (SAMPLES / "class_0.vdb").read_bytes()
    (tmp_path / "cut.vdb").write_bytes(whole[:cut])
    assert refusal_of_file(tmp_path / "cut.vdb").code == "truncated"
