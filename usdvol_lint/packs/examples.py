"""The examples on the pages of a pack, and what they have to report: marks and words."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from usdvol_lint.model import Finding
from usdvol_lint.packs.page import Example, Page, read_page
from usdvol_lint.rule import Rule
from usdvol_lint.words import printable

STAGE = "example.usda"
"""What the stage of every example is called."""
_MARK = re.compile(r"#((?:\s+[A-Z]{3}\d{3}(?:=(?:error|warning|info))?)+)\s*$")


class Case(NamedTuple):
    """An example that is to be run; `title` is its heading and its number under it: `Wrong 2`."""

    page: Page
    example: Example
    title: str

    @property
    def texts(self) -> dict[str, str]:
        """The stage and the files beside it."""
        return {**self.example.files, STAGE: self.example.text}


class Mark(NamedTuple):
    """The report of a line of a layer, as a mark demands it or a finding makes it."""

    code: str
    level: str
    layer: str
    line: int

    def __str__(self) -> str:
        line = f":{self.line}" if self.line else ""
        return f"{self.code} {self.level} at {self.layer}{line}"


def pages(folder: Path) -> list[Page]:
    """The pages of a pack, in order: every `.md` file but those named in capitals (README.md).

    As with modules, names with `_` or `.` first are hidden.
    """
    return [
        read_page(path)
        for path in sorted(folder.rglob("*.md"))
        if path.stem != path.stem.upper()
        and not any(part.startswith(("_", ".")) for part in path.relative_to(folder).parts)
    ]


def cases(page: Page) -> Iterator[Case]:
    """The examples of a page, numbered under each heading."""
    numbers: Counter[str] = Counter()
    for example in page.examples():
        numbers[example.heading] += 1
        yield Case(page, example, f"{example.heading} {numbers[example.heading]}".strip())


# --- marks ----------------------------------------------------------------------------------------


def marks(case: Case, rules: Mapping[str, Rule]) -> Counter[Mark]:
    """Each `# CODE` or `# CODE=level` at the end of a line of an example.

    `# CODE` alone means the severity that the rule has.
    """
    return Counter(
        Mark(code, level or _level(rules.get(code)), layer, number)
        for layer, text in case.texts.items()
        for number, line in enumerate(text.splitlines(), start=1)
        if (found := _MARK.search(line))
        for code, _, level in (mark.partition("=") for mark in found[1].split())
    )


def _level(rule: Rule | None) -> str:
    return rule.severity.label if rule else "(no such rule)"


def mark(finding: Finding) -> Mark:
    """The mark that an example should have for a finding."""
    site = finding.site
    return Mark(finding.code, finding.severity.label, site.layer, site.line or 0)


# --- words ----------------------------------------------------------------------------------------


def words_file(page: Page) -> Path:
    """The file beside a page that has the text of the findings in its examples."""
    return page.path.with_suffix(".words.txt")


def words_of(findings: Iterable[Finding]) -> str:
    """The text of the findings in one example: layer and line, message and advice of each."""
    return "".join(f"  {line}\n" for finding in findings for line in _entry(finding))


def _entry(finding: Finding) -> Iterator[str]:
    site = finding.site
    about = f"{site.prim or ''}.{site.property}" if site.property else site.prim
    frames = f" [{site.frames}]" if site.frames else ""
    variant = f" (variant {site.variant})" if site.variant else ""
    location = f"{site.layer}:{site.line}" if site.line else site.layer
    level = finding.severity.label
    on = f" <{about}>" if about else ""
    yield printable(f"{location}: {finding.code} {level}{on}{frames}{variant}")
    yield f"  {printable(finding.message)}"
    if finding.suggestion:
        yield f"  help: {printable(finding.suggestion)}"


def words(page: Page, found: Iterable[tuple[Case, Iterable[Finding]]]) -> str:
    """The text of a page's words file; empty if its examples have no findings."""
    blocks = [f"\n{case.title}\n{text}" for case, findings in found if (text := words_of(findings))]
    head = f"# What is said of the examples in {page.path.name}.\n"
    return head + "".join(blocks) if blocks else ""


def read_words(page: Page) -> dict[str, str] | None:
    """The agreed text of the findings in each example, by title; None without a words file."""
    try:
        text = words_file(page).read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    blocks = (block.partition("\n") for block in text.split("\n\n")[1:])
    return {title: text.rstrip("\n") + "\n" for title, _, text in blocks}
