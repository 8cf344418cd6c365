"""A rule's page: its title names the rule, its examples are stages that show what it finds."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from usdvol_lint.model import PackError

_TITLE = re.compile(r"^# (?P<name>[a-z0-9-]+) \((?P<code>[A-Z]{3}\d{3})\)\n+(?P<summary>[^\n]+)")
_BLOCK = re.compile(
    r"^```usda(?: (?P<file>[^\n`]+))?\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL
)
_HEADING = re.compile(r"^## (?P<title>.+)$", re.MULTILINE)


class Example(NamedTuple):
    """One example of a page: the text of a stage, and files that are written beside it.

    `heading` is the one that it stands under, `line` its first line on the page.
    """

    heading: str
    text: str
    files: Mapping[str, str]
    line: int


class Page(NamedTuple):
    """A rule's page: its documentation and its test."""

    code: str
    name: str
    summary: str
    text: str
    path: Path

    def sections(self) -> Mapping[str, str]:
        """By heading, in order, what stands under it; what stands before the first is left out."""
        _, *parts = _HEADING.split(self.text)
        return {title: text.strip() for title, text in zip(parts[::2], parts[1::2], strict=True)}

    def examples(self) -> Iterator[Example]:
        """The unnamed blocks under `## Wrong` and `## Right`, with the named ones before each."""
        headings = [(match.start(), match["title"]) for match in _HEADING.finditer(self.text)]
        files: dict[str, str] = {}
        for block in _BLOCK.finditer(self.text):
            heading = [title for start, title in headings if start < block.start()][-1:]
            if block["file"]:
                files[block["file"].strip()] = block["text"]
            else:
                line = self.text.count("\n", 0, block.start()) + 2
                yield Example(heading[0] if heading else "", block["text"], files, line)
                files = {}


def read_page(path: Path) -> Page:
    """Parses a page: its title names the rule, the next paragraph says what is wrong.

    Raises PackError for a page that can't be read, or has no such title.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise PackError(f"{path}: {error}") from error
    title = _TITLE.match(text)
    if title is None:
        raise PackError(f"{path}: the page must begin with '# name (CODE)' and one sentence")
    return Page(title["code"], title["name"], title["summary"], text, path)
