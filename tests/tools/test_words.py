"""docs/words.txt has what stands beside the pages, and an answer to each bad input."""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator

from process import ROOT

from tools.words import DATA, TARGET, by_code
from usdvol_lint.packs.catalog import Catalog

PAGE = TARGET.read_text(encoding="utf-8")
SAID_OF_INPUT = PAGE[PAGE.index("\nThe command line\n") :]

MADE_OF_WORDS = {"NotChecked", "Trouble", "tell_cut"}
"""What makes a sentence of LNT001 or LNT005 of a text."""
NOT_BY_A_FILE = {
    "not opened: its arcs multiply what they bring: the same ": "takes seconds to find",
    " of memory; the limit for one process is ": "hangs on the machine",
    " was not looked into: ": "a package in a package, or a machine without h5py",
    "a folder that holds no USD file": "a folder",
    "not a regular file (a pipe, socket or device)": "a pipe",
    "USD opens no file whose path is not UTF-8": "a name that not every disk takes",
    "a package in which USD finds no layer to open": "no package is known of which USD says so",
    "USD can't open this layer and does not say why": "no layer is known of which USD says so",
    ": no schema that is installed here is called ": "a pack that asks for another schema",
}
"""Sentences that tools/words.toml has nothing for, and why."""


def sentences() -> Iterator[str]:
    """The longest piece of each text that such a sentence is made of."""
    for path in (*(ROOT / "usdvol_lint").rglob("*.py"), *(ROOT / "rules").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in MADE_OF_WORDS:
                texts = (
                    each for each in node.args if isinstance(each, ast.Constant | ast.JoinedStr)
                )
                for text in texts:
                    parts = text.values if isinstance(text, ast.JoinedStr) else [text]
                    said = (str(each.value) for each in parts if isinstance(each, ast.Constant))
                    yield max(said, key=len)
                    break


def test_each_sentence_on_what_was_not_checked_is_on_it() -> None:
    found = set(sentences())
    assert len(found) > 25
    assert found >= NOT_BY_A_FILE.keys()
    missing = {each for each in found if each not in PAGE}
    assert missing - NOT_BY_A_FILE.keys() == set(), "tools/words.toml has nothing that says so"


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
    for name in data["partly"]:
        assert re.search(f"^  {re.escape(name)}:1?\\d*: LNT005 info", SAID_OF_INPUT, re.MULTILINE)
