"""Positions of properties, time samples and asset paths in usda text, by example."""

from __future__ import annotations

from typing import Any

import pytest
from marks import ASSETS, PROPERTIES, SAMPLES, find, in_prim, marked, with_mark

from usdvol_lint.layertext.lines import TextLayer

SAMPLE_QUERIES: list[tuple[int, str, dict[str, Any]]] = [
    (0, "p", {}),
    (2, "p", {"time": 1}),
    (2, "p", {"time": 1.0000001}),
    (1, "p", {"time": 1.001}),
    (1, "p", {"time": 2}),
    (3, "p", {"time": 2.5}),
    (1, "p", {"time": 3}),
    (4, "p", {"time": -15}),
    (5, "p", {"time": 0.5}),
    (6, "p", {"time": 4}),
    (1, "p", {"time": 7}),
    (1, "p", {"time": 8}),
    (1, "p", {"time": 9}),
    (7, "p", {"time": 1000}),
    (1, "p", {"time": float("nan")}),
    (1, "p", {"time": float("inf")}),
    (9, "q", {"asset": "a.vdb"}),
    (9, "q", {"time": 0, "asset": "a.vdb"}),
    (10, "q", {"time": 1, "asset": "a.vdb"}),
    (11, "q", {"time": 2, "asset": "b.vdb"}),
    (9, "q", {"time": 3, "asset": "a.vdb"}),
    (8, "q", {"time": 3, "asset": "c.vdb"}),
    (8, "q", {"asset": "c.vdb"}),
    (13, "r", {"time": 1}),
    (14, "r", {"time": 2}),
    (12, "r", {"time": 3}),
    (15, "r", {"time": 30}),
    (16, "s", {"time": 1}),
]

ASSET_QUERIES = [
    (1, "/", "sub.usda"),
    (2, "/", "odd@name@@@"),
    (0, "/", "ref.usda"),
    (4, "/a", "ref.usda"),
    (6, "/a", "x.vdb"),
    (8, "/a", "y.vdb"),
    (9, "/a", ""),
    (3, "/a", "z.vdb"),
    (6, "/a.p", "x.vdb"),
    (5, "/a.p", "y.vdb"),
    (8, "/a.q", "y.vdb"),
    (7, "/a.q", "z.vdb"),
    (11, "/a/b", "z.vdb"),
    (10, "/a/b", "x.vdb"),
]


@pytest.mark.parametrize(("name", "statements"), PROPERTIES.values(), ids=PROPERTIES)
def test_properties(name: str, statements: str) -> None:
    text, expected = marked(in_prim(statements))
    assert find(text, f"/a.{name}") == expected
    assert find(text.replace("\n", "\r\n"), f"/a.{name}") == expected


@pytest.mark.parametrize(("place", "name", "what"), SAMPLE_QUERIES)
def test_time_samples(place: int, name: str, what: dict[str, Any]) -> None:
    text, expected = with_mark(SAMPLES, place)
    assert find(text, f"/a.{name}", **what) == expected


@pytest.mark.parametrize(("place", "path", "asset"), ASSET_QUERIES)
def test_assets(place: int, path: str, asset: str) -> None:
    text, expected = with_mark(ASSETS, place)
    assert find(text, path, asset=asset) == expected


@pytest.mark.parametrize(
    ("declaration", "below"),
    [
        ('    token a = "x"', '"x"'),
        ("    token[] a = [\n", "["),
        ('    token /* of\n two lines */ a = "x"', "token /* of"),
        ("    token a (\n        doc = 'd'\n    )", "token a ("),
    ],
)
def test_the_mark_is_below_the_value_or_else_below_the_statement(
    declaration: str, below: str
) -> None:
    """Never in another line than the one that is shown."""
    text = TextLayer(f'#usda 1.0\ndef "p"\n{{\n{declaration}\n}}\n'.encode())
    position = text.find("/p.a")
    assert position
    assert position.excerpt
    words, column = position.excerpt
    assert (position.line, words[column - 1 :]) == (4, below)
