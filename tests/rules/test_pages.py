"""Every example on every rule page reports what its marks and words say, under all rules."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from causes import told_twice
from process import ROOT

from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.catalog import load
from usdvol_lint.packs.examples import (
    STAGE,
    Case,
    cases,
    mark,
    marks,
    pages,
    read_words,
    words_file,
    words_of,
)
from usdvol_lint.packs.page import Page
from usdvol_lint.run.testing import portable, write_example

RULES = ROOT / "rules"

PAGES = pages(RULES)
CASES = [case for page in PAGES for case in cases(page)]
EXAMPLES = [
    pytest.param(case, id=f"{case.page.code}-{case.title.replace(' ', '-')}") for case in CASES
]


@pytest.mark.parametrize("case", EXAMPLES)
def test_example_reports_its_marks_and_says_its_words(
    case: Case, engine: Engine, assets: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_example(case, tmp_path, assets)
    monkeypatch.chdir(tmp_path)
    findings = portable(engine.lint(STAGE).findings, tmp_path)
    place = f"{case.page.path}:{case.example.line}"
    words = words_of(findings)
    assert not told_twice(findings), place
    assert Counter(map(mark, findings)) == marks(case, load().rules), f"{place}\n{words}"
    agreed = (read_words(case.page) or {}).get(case.title, "")
    assert words == agreed, f"{place}: `make generate` writes the words"


def test_words_are_those_of_examples() -> None:
    """A page that is gone leaves no words behind, and no example that is gone does."""
    titles = {(words_file(case.page), case.title) for case in CASES}
    written = {page: read_words(page) or {} for page in PAGES}
    assert {words_file(page) for page, words in written.items() if words} == set(
        RULES.rglob("*.words.txt")
    )
    assert {(words_file(page), title) for page in PAGES for title in written[page]} <= titles


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.code)
def test_page_shows_what_it_is_about(page: Page) -> None:
    """At least one Wrong that the rule itself reports, and one Right."""
    if page.path.parent.name == "lint":
        return
    wrong = [case for case in cases(page) if case.example.heading == "Wrong"]
    right = [case for case in cases(page) if case.example.heading == "Right"]
    assert right
    assert wrong
    for case in wrong:
        codes = {mark.code for mark in marks(case, load().rules)}
        assert page.code in codes, f"{page.path}:{case.example.line} never shows {page.code}"
    assert "## Why it matters" in page.text


def test_every_rule_has_its_page_and_every_page_its_rule() -> None:
    rules = load().rules
    assert {page.code: page.name for page in PAGES} == {
        code: rule.name for code, rule in rules.items()
    }
    for page in PAGES:
        assert page.path.stem == page.name.replace("-", "_")
