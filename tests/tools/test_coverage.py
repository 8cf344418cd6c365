"""docs/coverage.md has a row for each sentence of the schema that demands something."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pxr
import pytest
from process import ROOT
from pxr import Sdf

from tools.coverage import Sentence, coverage, demands, read_sentences
from usdvol_lint.packs.catalog import Catalog

_QUOTE = re.compile(r'"([^"]+)"')
_OF_THE_GUIDE = re.compile(r"user guide|UsdVol overview")


def _schema() -> Path | None:
    """The schema as it is written, with its documentation; wheels have it since 26.8."""
    found = Path(pxr.__file__).parent.rglob("usdVol/resources/usdVol/schema.usda")
    return next(found, None)


def _documentation(layer: Sdf.Layer) -> Iterator[str]:
    for prim in layer.rootPrims:
        yield prim.documentation
        for attribute in prim.attributes:
            yield attribute.documentation


@pytest.fixture(scope="module")
def sentences() -> list[Sentence]:
    return read_sentences()


@pytest.mark.skipif(_schema() is None, reason="this USD comes without the text of its schema")
def test_each_sentence_of_the_installed_schema_has_a_row(sentences: list[Sentence]) -> None:
    """One that the installed schema lacks, because it is older, may have a row all the same."""
    layer = Sdf.Layer.FindOrOpen(str(_schema()))
    found = {each for text in _documentation(layer) for each in demands(text)}
    assert len(found) > 30
    assert found - {sentence.text for sentence in sentences} == set()


def test_each_quote_of_the_guide_has_a_row(sentences: list[Sentence]) -> None:
    texts = " ".join(each.text for each in sentences).replace("`", "")
    quotes = [
        quote.rstrip(".,")
        for page in sorted((ROOT / "rules").rglob("*.md"))
        for line in page.read_text(encoding="utf-8").splitlines()
        if _OF_THE_GUIDE.search(line)
        for quote in _QUOTE.findall(line)
    ]
    assert len(quotes) > 5
    assert [quote for quote in quotes if quote not in texts] == []


def test_no_row_is_empty_and_rules_exist(sentences: list[Sentence], catalog: Catalog) -> None:
    for sentence in sentences:
        assert sentence.rules or sentence.why, sentence.text
        assert sentence.places, sentence.text
        assert set(sentence.rules) <= catalog.rules.keys(), sentence.text
    texts = [(sentence.source, sentence.text) for sentence in sentences]
    assert len(texts) == len(set(texts))


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Holds data. It must be a file.", ["It must be a file."]),
        ("If it is\n    too short, none.  Others\nmay be.", ["If it is too short, none."]),
        ("A mustang is no demand.", []),
    ],
)
def test_sentences_that_demand_something(text: str, found: list[str]) -> None:
    assert list(demands(text)) == found


def test_a_row_has_links_and_what_is_left_open(catalog: Catalog) -> None:
    page = catalog.page("AST002")
    assert page
    sentence = Sentence("**If** a|b.", "a book", ("Volume",), ("AST002",), "not all")
    assert coverage("", [sentence], {"AST002": page}).splitlines()[-1] == (
        "| \\*\\*If\\*\\* a\\|b. | `Volume` | [AST002](../rules/asset/file_missing.md). not all |"
    )
