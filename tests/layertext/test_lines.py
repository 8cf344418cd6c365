"""Positions of prims in usda text, also in variants, by example."""

from __future__ import annotations

import pytest
from marks import PRIMS, VARIANTS, find, marked, with_mark

from usdvol_lint.layertext.lines import Position, TextLayer

VARIANT_PATHS = [
    "/a.p",
    "/a{v=}",
    "/a{v=x}",
    "/a{v=x}.p",
    "/a{v=x}b",
    "/a{v=x}b.p",
    "/a{v=x}b{v=}",
    "/a{v=x}b{v=x}",
    "/a{v=x}b{v=x}.p",
    "/a{v=x}{w=}",
    "/a{v=x}{w=y}",
    "/a{v=x}{w=y}b",
    "/a{v=x}{w=y}b.p",
    "/a{v=y}",
    "/a{v=y}b",
    "/a{w=y}",
    "/a/b",
    "/a/b.p",
]


@pytest.mark.parametrize(("path", "text"), PRIMS.values(), ids=PRIMS)
def test_prims(path: str, text: str) -> None:
    text, expected = marked(text)
    assert find(text, path) == expected


@pytest.mark.parametrize(("place", "path"), list(enumerate(VARIANT_PATHS)), ids=VARIANT_PATHS)
def test_variants(place: int, path: str) -> None:
    text, expected = with_mark(VARIANTS, place)
    assert find(text, path) == expected


@pytest.mark.parametrize(
    "path", ["/a{v=z}", "/a{u=}", "/a{w=y}b", "/a{v=x}c", "/a{v=y}b.p", "/b", "/a/b.q", "/a/b.p.q"]
)
def test_absent_from_variants(path: str) -> None:
    assert find(with_mark(VARIANTS, -1)[0], path) is None


def test_byte_order_mark_is_no_character() -> None:
    text = '\ufeff#usda 1.0\ndef "a" {}\n'
    assert [find(text, "/"), find(text, "/a")] == [Position(1, 1), Position(2, 1)]
    assert find('\ufeffdef "a" {}', "/a") == Position(1, 1)


def test_lines_are_counted_across_a_large_text() -> None:
    text = "#usda 1.0\n" + "".join(f'def "p{i}"\n{{\n}}\n' for i in range(30_000))
    layer = TextLayer(text.encode())
    numbers = [29_999, 0, 7_000, 15_000]
    assert [layer.find(f"/p{i}") for i in numbers] == [Position(2 + 3 * i, 1) for i in numbers]
