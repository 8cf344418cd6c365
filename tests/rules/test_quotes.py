"""What pages quote from a schema has to stand in the schema that is installed."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from process import ROOT
from pxr import Plug, Usd

PAGES = sorted((ROOT / "rules").glob("*/*.md"))
QUOTE = re.compile(r'"((?:[^"]|"field")+)"')
GAP = re.compile(r"\[\.\.\.\]|…|\[\w+\]")
SCHEMAS = {"usdVol/schema.usda": "usdVol", "usdGeom/schema.usda": "usdGeom"}


def plain(text: str) -> str:
    """Without case, line breaks and the marks that quoting and Doxygen put around words."""
    return re.sub(r"\s+", " ", re.sub(r"""[\\_*"']""", "", text)).lower()


def schema(name: str) -> str:
    folder = Plug.Registry().GetPluginWithName(name).resourcePath
    with open(f"{folder}/{name}/schema.usda", encoding="utf-8") as file:
        return plain(file.read())


def quotes() -> Iterator[tuple[str, str, str]]:
    """Page, schema and quoted text, where a line names one schema as the source."""
    for page in PAGES:
        for line in page.read_text(encoding="utf-8").splitlines():
            named = [name for name in SCHEMAS if name in line]
            if len(named) == 1:
                for quote in QUOTE.findall(line.split("](")[0]):
                    if len(quote.split()) > 3:
                        yield page.stem, named[0], quote


@pytest.mark.skipif(Usd.GetVersion() < (0, 26, 3), reason="this USD has no particle fields")
@pytest.mark.parametrize(("page", "name", "quote"), list(quotes()))
def test_quotes_stand_in_the_schema(page: str, name: str, quote: str) -> None:
    text = schema(SCHEMAS[name])
    for part in GAP.split(plain(quote)):
        assert part.strip(" .,;:") in text
