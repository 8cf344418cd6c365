"""Every example on every rule page reports exactly what its marks say, under all rules."""

from __future__ import annotations

import re
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from zipfile import ZipFile

import pytest

from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.catalog import load
from usdvol_lint.packs.page import Example, Page, read_page

ROOT = Path(__file__).parent.parent
ASSETS = ROOT / "rules" / "assets"
MARK = re.compile(r"#((?:\s+[A-Z]{3}\d{3}(?:=(?:error|warning|info))?)+)\s*$")
STAGE = "example.usda"

PAGES = [
    read_page(path) for path in sorted((ROOT / "rules").glob("*/*.md")) if path.name != "README.md"
]
EXAMPLES = [
    pytest.param(page, example, id=f"{page.code}-{example.heading}-{example.line}")
    for page in PAGES
    for example in page.examples()
]


def marks(file: str, text: str) -> Iterator[tuple[str, str, int]]:
    """Each `# CODE` or `# CODE=level` at the end of a line: the finding, its layer, its line.

    `# CODE` alone means the severity that the rule has.
    """
    rules = load().rules
    for number, line in enumerate(text.splitlines(), start=1):
        found = MARK.search(line)
        for mark in found[1].split() if found else ():
            code, _, level = mark.partition("=")
            yield f"{code}={level or rules[code].severity.label}", file, number


def write_example(example: Example, folder: Path) -> None:
    """The example, its named files and everything in rules/assets, in one folder.

    A file whose name ends in .usdz is a package: the text is its root layer, beside cloud.vdb.
    """
    shutil.copytree(ASSETS, folder, dirs_exist_ok=True)
    for name, text in {**example.files, STAGE: example.text}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        if name.endswith(".usdz"):
            with ZipFile(folder / name, "w") as package:
                package.writestr("root.usda", text)
                package.write(ASSETS / "cloud.vdb", "cloud.vdb")
        else:
            (folder / name).write_text(text, encoding="utf-8")


@pytest.mark.parametrize(("page", "example"), EXAMPLES)
def test_example_reports_its_marks_and_nothing_else(
    page: Page, example: Example, engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_example(example, tmp_path)
    monkeypatch.chdir(tmp_path)
    expected = Counter(
        mark
        for name, text in {**example.files, STAGE: example.text}.items()
        for mark in marks(name, text)
    )
    report = engine.lint(STAGE)
    found = Counter(
        (f"{finding.code}={finding.severity.label}", finding.site.layer, finding.site.line or 0)
        for finding in report.findings
        if finding.code != "LNT004"  # of an old USD, not of the stage
    )
    said = "\n".join(f"{f.site.line}: {f.code} {f.message}" for f in report.findings)
    assert found == expected, f"{page.path}:{example.line}\n{said}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.code)
def test_page_shows_what_it_is_about(page: Page) -> None:
    """At least one Wrong that the rule itself reports, and one Right."""
    if page.path.parent.name == "lint":
        return
    wrong = [example for example in page.examples() if example.heading == "Wrong"]
    right = [example for example in page.examples() if example.heading == "Right"]
    assert right
    assert wrong
    for example in wrong:
        texts = [example.text, *example.files.values()]
        codes = {mark[0][:6] for text in texts for mark in marks("", text)}
        assert page.code in codes, f"{page.path}:{example.line} never shows {page.code}"
    assert "## Why it matters" in page.text


def test_every_rule_has_its_page_and_every_page_its_rule() -> None:
    rules = load().rules
    assert {page.code: page.name for page in PAGES} == {
        code: rule.name for code, rule in rules.items()
    }
    for page in PAGES:
        assert page.path.stem == page.name.replace("-", "_")
