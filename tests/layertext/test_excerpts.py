"""The line of a text that a finding points to, as much of it as a report can show."""

from __future__ import annotations

import pytest

from usdvol_lint.layertext.excerpts import excerpt
from usdvol_lint.model import Excerpt

MARK = "¦"


def found(text: str, ending: str = "\n") -> Excerpt:
    """The excerpt at a mark, which stands in the second of three lines."""
    before, _, after = f"first{ending}{text}{ending}third".partition(MARK)
    data = (before + after).encode("utf-8", "surrogateescape")
    start = data.index(b"\n") + 1
    return excerpt(data, start, len(before.encode("utf-8", "surrogateescape")))


@pytest.mark.parametrize("ending", ["\n", "\r\n"])
@pytest.mark.parametrize(
    ("text", "shown", "column"),
    [
        ("¦def Volume", "def Volume", 1),
        ("    ¦def Volume", "def Volume", 1),
        ("\t\tasset ¦filePath", "asset filePath", 7),
        ('  string Größe = "x"; ¦int i', 'string Größe = "x"; int i', 21),
        ("¦", "", 1),
        ("¦  ", "  ", 1),
        ("a \udcff¦b", "a \ufffdb", 4),
    ],
)
def test_the_line_without_its_indent(text: str, shown: str, column: int, ending: str) -> None:
    assert found(text, ending) == Excerpt(shown, column)


def test_the_first_line_is_without_its_byte_order_mark() -> None:
    assert excerpt("\ufeff#usda 1.0\n".encode(), 0, 3) == Excerpt("#usda 1.0", 1)


def test_the_last_line_may_have_no_end() -> None:
    assert excerpt(b"a\ndef b", 2, 6) == Excerpt("def b", 5)


@pytest.mark.parametrize(
    ("before", "after", "shown", "column"),
    [
        (0, 160, "a" * 160, 1),
        (0, 161, "a" * 159 + "…", 1),
        (60, 100, "b" * 60 + "a" * 100, 61),
        (60, 101, "b" * 60 + "a" * 99 + "…", 61),
        (100, 60, "b" * 100 + "a" * 60, 101),
        (100, 61, "…" + "b" * 60 + "a" * 61, 62),
        (100_000, 100_000, "…" + "b" * 60 + "a" * 98 + "…", 62),
    ],
)
def test_a_long_line_is_shown_around_its_mark(
    before: int, after: int, shown: str, column: int
) -> None:
    assert found(f"{'b' * before}¦{'a' * after}") == Excerpt(shown, column)


def test_characters_of_several_bytes_are_not_cut() -> None:
    """Where a line goes on for long, no more of it is read than can be shown."""
    assert found(f"{'煙' * 100}¦{'é' * 60}") == Excerpt("煙" * 100 + "é" * 60, 101)
    shown = found(f"¦{'煙' * 5000}")
    assert shown == Excerpt("煙" * 159 + "…", 1)
