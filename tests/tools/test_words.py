"""docs/words.txt has what stands beside the pages, and an answer to each bad input."""

from __future__ import annotations

import re
import tomllib

from process import ROOT

from tools.words import DATA, TARGET, by_code
from usdvol_lint.packs.catalog import Catalog

PAGE = TARGET.read_text(encoding="utf-8")
SAID_OF_INPUT = PAGE[PAGE.index("\nThe command line\n") :]


def test_all_that_stands_beside_the_pages_is_on_it_once(catalog: Catalog) -> None:
    files = sorted((ROOT / "rules").rglob("*.words.txt"))
    texts = [path.read_text(encoding="utf-8") for path in files]
    for paragraph in by_code(catalog, texts):
        assert f"\n{paragraph}\n" in PAGE, "run `make generate`"
    for text in texts:
        for line in re.findall(r"^    (.*)", text, re.MULTILINE):
            assert f" {line}\n" in PAGE, line


def test_each_bad_input_is_answered() -> None:
    data = tomllib.loads(DATA.read_text(encoding="utf-8"))
    titles = [
        *(f"usdvol-lint {arguments}".rstrip() for arguments in data["commands"]),
        *data["configurations"],
        *(f"--pack {name}: {'; '.join(text.values())}" for name, text in data["packs"].items()),
    ]
    for title in titles:
        assert re.search(f"^  {re.escape(title)}\n    .*\\S", SAID_OF_INPUT, re.MULTILINE), title
    for name in data["stages"]:
        assert re.search(
            f"^  {re.escape(name)}(:\\d+)?: LNT00\\d error", SAID_OF_INPUT, re.MULTILINE
        )
