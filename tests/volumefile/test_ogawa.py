"""The Field3D reader against Ogawa files of any content, and against files that lie."""

from __future__ import annotations

import random
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from attempts import Reader, memory_below, refusal
from process import SAMPLES

from usdvol_lint.volumefile import VolumeFileError, read_volume_file

OGAWA = SAMPLES / "f3d_ogawa.f3d"


class Ogawa:
    """Writes an Ogawa file from its leaves to its root."""

    def __init__(self) -> None:
        self.bytes = bytearray(b"Ogawa\xff\0\1" + bytes(8))

    def put(self, stored: bytes) -> int:
        self.bytes += stored
        return len(self.bytes) - len(stored)

    def data(self, content: bytes, size: int | None = None) -> int:
        size = len(content) if size is None else size
        return 1 << 63 | (self.put(struct.pack("<Q", size) + content) if size else 0)

    def node(self, *children: int, count: int | None = None) -> int:
        count = len(children) if count is None else count
        return self.put(struct.pack(f"<{len(children) + 1}Q", count, *children))

    def group(self, name: str, *children: int) -> int:
        return self.node(self.data(name.encode()), self.data(bytes(4)), *children)

    def attribute(self, name: str, kind: int, value: bytes) -> int:
        return self.node(
            self.data(name.encode()),
            self.data(struct.pack("<i", 1)),
            self.data(struct.pack("<i", kind)),
            self.data(value),
        )

    def dataset(self, name: str, *blocks: int) -> int:
        head = self.data(name.encode()), self.data(struct.pack("<i", 2)), self.data(bytes(4))
        return self.node(*head, *blocks)

    def text(self, name: str, value: str) -> int:
        return self.attribute(name, 16, value.encode())

    def int(self, name: str, value: int) -> int:
        return self.attribute(name, 4, struct.pack("<i", value))

    def version(self, *numbers: int) -> int:
        return self.attribute("version_number", 14, struct.pack("<3i", *numbers))

    def matrix(self, name: str, numbers: tuple[float, ...]) -> int:
        return self.attribute(name, 15, struct.pack("<16d", *numbers))

    def box(self, name: str, low: tuple[int, int, int], high: tuple[int, int, int]) -> list[int]:
        return [
            self.attribute(f"{name}_{end}", 14, struct.pack("<3i", *corner))
            for end, corner in (("min", low), ("max", high))
        ]

    def layer(self, name: str, *more: int, bits: int = 32, components: int = 1) -> int:
        said = self.text("class_type", "field3d_layer"), self.text("class_name", "MACField")
        numbers = self.int("bits_per_component", bits), self.int("components", components)
        return self.group(name, *said, *numbers, *more)

    def partition(self, name: str, *children: int) -> int:
        return self.group(name, self.text("is_field3d_partition", "1"), *children)

    def mapping(self, kind: str, *more: int) -> int:
        return self.group("mapping", self.text("mapping_type", kind), *more)

    def finish(self, *children: int, name: str = "f3droot", version: bool = True) -> bytes:
        said = [self.version(1, 7, 3)] if version else []
        self.bytes[8:16] = struct.pack("<Q", self.group(name, *said, *children))
        return bytes(self.bytes)


def test_mappings(read: Reader) -> None:
    file = Ogawa()
    extents = file.box("extents", (0, 0, 0), (9, 19, 39))
    moved = (2.0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 0, 0, 1)
    said = file.int("num_time_samples", 2), file.matrix("matrix_0", moved)
    content = file.finish(
        file.partition("null.0", file.mapping("NullFieldMapping"), file.layer("a", *extents)),
        file.partition("none", file.layer("b", *extents)),
        file.partition(
            "fast.0", file.mapping("MatrixFieldMapping", *said), file.layer("c", *extents)
        ),
        file.partition("view.0", file.mapping("FrustumFieldMapping"), file.layer("d", *extents)),
        file.partition("odd.0", file.mapping("MatrixFieldMapping"), file.layer("e", *extents)),
    )
    found = read(content)
    a, b, c, d, e = found.grids
    for grid in (a, b):
        assert grid.world_bounds(0.5) == ((0, 0, 0), (1, 1, 1))
    assert c.world_bounds(0.5) == ((5, 0, 0), (7, 2, 2))
    assert (d.transform, e.transform) == (None, None)
    assert [grid.purpose for grid in found.grids] == ["null", "none", "fast", "view", "odd"]


def test_boxes(read: Reader) -> None:
    def bounds(*boxes: list[int]) -> Any:
        layer = file.layer("a", *(part for box in boxes for part in box))
        return read(file.finish(file.partition("p.0", layer))).grids[0].index_bounds

    file = Ogawa()
    extents = file.box("extents", (0, 0, 0), (9, 9, 9))
    assert bounds(extents, file.box("data_window", (2, -5, 0), (20, 5, 9))) == (
        (2, 0, 0),
        (9, 5, 9),
    )
    assert bounds(extents, file.box("data_window", (20, 0, 0), (30, 9, 9))) == (
        (0, 0, 0),
        (9, 9, 9),
    )
    assert bounds(extents) == ((0, 0, 0), (9, 9, 9))
    assert bounds(extents[:1]) is None
    assert bounds(file.box("extents", (5, 0, 0), (4, 9, 9))) is None


def test_what_is_no_layer_is_passed_over(read: Reader) -> None:
    file = Ogawa()
    blocks = [file.data(b"block")] * 3000
    content = file.finish(
        file.group("notes", file.layer("a")),
        file.partition(
            "p.0",
            file.group("b"),
            file.layer("c", file.dataset("data", *blocks), bits=8, components=2),
            0,
            file.data(b"stray"),
        ),
    )
    (grid,) = read(content).grids
    assert (grid.name, grid.value_type, grid.tree_type) == ("c", "unknown", "MACField")
    assert (grid.index_bounds, grid.world_bounds()) == (None, None)


def test_values_that_are_unknown_or_too_large(read: Reader) -> None:
    file = Ogawa()
    more = [
        file.attribute("later", 17, b"abc"),
        file.attribute("long", 16, b"x" * ((1 << 20) + 1)),
        file.attribute("latin", 16, b"gr\xf6\xdfe"),
        file.attribute("half", 8, struct.pack("<e", 0.5)),
        file.attribute("byte", 1, b"\x03"),
    ]
    (grid,) = read(file.finish(file.partition("p.0", file.layer("a", *more)))).grids
    assert {
        name: grid.metadata[name].value for name in ("later", "long", "latin", "half", "byte")
    } == {
        "later": None,
        "long": None,
        "latin": "gr\udcf6\udcdfe",
        "half": 0.5,
        "byte": 3,
    }


def _lies() -> dict[str, tuple[bytes, str]]:
    def file(make: Callable[[Ogawa], bytes]) -> bytes:
        return make(Ogawa())

    def loop(o: Ogawa) -> bytes:
        name, kind = o.data(b"p.0"), o.data(bytes(4))
        here = len(o.bytes)
        return o.finish(o.node(name, kind, *[here] * 1000))

    def shared(o: Ogawa) -> bytes:
        big = o.attribute("text", 16, b"x" * 500_000)
        return o.finish(*[o.group("p", *[big] * 50)] * 50)

    cut = struct.pack("<Q", 2**62)
    return {
        "writer-died": (b"Ogawa\0" + OGAWA.read_bytes()[6:], "truncated"),
        "root-far": (OGAWA.read_bytes()[:8] + cut, "truncated"),
        "root-nowhere": (OGAWA.read_bytes()[:8] + bytes(200), "truncated"),
        "alembic": (file(lambda o: o.finish(name="ABC")), "not-a-volume-file"),
        "no-version": (file(lambda o: o.finish(version=False)), "not-a-volume-file"),
        "loop": (file(loop), "not-a-volume-file"),
        "shared": (file(shared), "not-a-volume-file"),
        "children-2^61": (file(lambda o: o.finish(o.node(count=2**61))), "truncated"),
        "children-2^64": (file(lambda o: o.finish(o.node(count=2**64 - 1))), "truncated"),
        "child-far": (file(lambda o: o.finish(2**62)), "truncated"),
        "data-2^64": (
            file(lambda o: o.finish(o.node(o.data(b"x", 2**64 - 1), o.data(bytes(4))))),
            "truncated",
        ),
        "children-many": (
            file(lambda o: o.finish(*[0] * 100_001)),
            "not-a-volume-file",
        ),
        "type-short": (
            file(
                lambda o: o.finish(
                    o.node(o.data(b"x"), o.data(struct.pack("<i", 1)), o.data(b"\1"), o.data(b"y"))
                )
            ),
            "not-a-volume-file",
        ),
        "name-long": (
            file(lambda o: o.finish(o.node(o.data(b"x" * 70_000), o.data(bytes(4))))),
            "not-a-volume-file",
        ),
        "kind-short": (
            file(lambda o: o.finish(o.node(o.data(b"x"), o.data(b"\0")))),
            "not-a-volume-file",
        ),
        "name-is-group": (file(lambda o: o.finish(o.node(16, 16))), "not-a-volume-file"),
        "group-bare": (file(lambda o: o.finish(o.node())), "not-a-volume-file"),
        "attribute-bare": (
            file(lambda o: o.finish(o.node(o.data(b"x"), o.data(struct.pack("<i", 1))))),
            "not-a-volume-file",
        ),
        "attribute-size": (
            file(lambda o: o.finish(o.attribute("x", 4, bytes(5)))),
            "not-a-volume-file",
        ),
        "matrix-nan": (
            file(
                lambda o: o.finish(
                    o.partition(
                        "p.0",
                        o.mapping("MatrixFieldMapping", o.matrix("matrix_0", (float("nan"),) * 16)),
                    )
                )
            ),
            "not-a-volume-file",
        ),
    }


LIES = _lies()


@pytest.mark.parametrize(("content", "code"), LIES.values(), ids=LIES)
def test_lies_are_told(read: Reader, content: bytes, code: str) -> None:
    with memory_below(len(content) * 5 + (8 << 20)):
        error = refusal(read, content)
    assert error.code == code


def test_mutants_raise_nothing_else(tmp_path: Path) -> None:
    """The Ogawa sample alone: HDF5 is read by a C library, which is not ours to break."""
    dice = random.Random(3)
    whole, path = OGAWA.read_bytes(), tmp_path / "mutant.f3d"
    for _ in range(60):
        mutants = []
        for _ in range(20):
            content = bytearray(whole)
            for _ in range(dice.randint(1, 6)):
                at = dice.randrange(len(whole) - 8)
                word = dice.choice([0, 1, 2**63, 2**64 - 1, at, dice.randrange(len(whole))])
                width = dice.choice([1, 4, 8])
                content[at : at + width] = struct.pack("<Q", word)[:width]
            mutants.append(bytes(content))
        path.write_bytes(b"".join(mutants))
        for number in range(len(mutants)):
            try:
                file = read_volume_file(str(path), number * len(whole), len(whole))
            except VolumeFileError as error:
                str(error).encode()
            else:
                for grid in file.grids:
                    grid.world_bounds(0.5)


@pytest.mark.parametrize("number", [float("nan"), float("inf"), -float("inf")])
def test_a_version_that_is_no_number(read: Reader, number: float) -> None:
    file = Ogawa()
    version = file.attribute("version_number", 13, struct.pack("<3d", 1, number, 3))
    error = refusal(read, file.finish(version, version=False))
    assert (error.code, error.message) == ("not-a-volume-file", "the container holds no Field3D")
