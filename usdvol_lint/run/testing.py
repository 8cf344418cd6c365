"""Pages as tests: their examples are linted, and held against their marks and words."""

from __future__ import annotations

import os
import re
import shutil
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import chdir
from dataclasses import replace
from itertools import groupby
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple
from zipfile import ZipFile

from usdvol_lint.config import Config
from usdvol_lint.model import Finding, PackError, printable
from usdvol_lint.packs.catalog import USD_TOO_OLD, load
from usdvol_lint.packs.page import Example, Page, read_page
from usdvol_lint.paths import display
from usdvol_lint.rule import Rule
from usdvol_lint.run.lint import lint

STAGE = "example.usda"
"""What the stage of every example is called."""
_PACKED = "cloud.vdb"
"""The one of a pack's assets that is put into each package of an example."""
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
    """That a rule reports a line of a layer."""

    code: str
    level: str
    layer: str
    line: int

    def __str__(self) -> str:
        line = f":{self.line}" if self.line else ""
        return f"{self.code} {self.level} at {self.layer}{line}"


def pages(folder: Path) -> list[Page]:
    """The pages of a pack, in order: every `.md` file but those named in capitals (README.md).

    As with modules, what `_` or `.` hides is none.
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


# --- running --------------------------------------------------------------------------------------


def write_example(case: Case, folder: Path, assets: Path) -> None:
    """The example, its named files and all of a pack's assets, in one folder.

    A file whose name ends in .usdz is a package: the text is its root layer, beside cloud.vdb.
    """
    folder.mkdir(parents=True, exist_ok=True)
    if assets.is_dir():
        shutil.copytree(assets, folder, copy_function=_link, dirs_exist_ok=True)
    for name, text in case.texts.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.unlink(missing_ok=True)  # it may be a link to one of the assets
        if name.endswith(".usdz"):
            _pack(file, text, assets / _PACKED)
        else:
            file.write_text(text, encoding="utf-8", newline="\n")


def _link(source: str, target: str) -> None:
    """The same file once more, which takes a tenth of the time of a copy."""
    try:
        os.link(source, target)
    except OSError:  # another disk, or one without links
        shutil.copyfile(source, target)


def _pack(file: Path, text: str, asset: Path) -> None:
    with ZipFile(file, "w") as package:
        package.writestr("root.usda", text)
        if asset.is_file():
            package.write(asset, asset.name)


def run(
    examples: Sequence[Case], assets: Path, packs: Iterable[str] = ()
) -> list[tuple[Finding, ...]]:
    """What is found in each example under all rules, those that are off by default too."""
    config = Config(select=("ALL",), packs=tuple(map(os.path.realpath, packs)))
    assets = assets.resolve()
    with TemporaryDirectory() as temporary, chdir(temporary):
        here = Path.cwd()
        if assets.is_dir():
            assets = Path(shutil.copytree(assets, here / "assets"))
        folders = [here / f"example-{number:04}" for number in range(len(examples))]
        for case, folder in zip(examples, folders, strict=True):
            write_example(case, folder, assets)
        report = lint([f"{folder.name}/{STAGE}" for folder in folders], config)
    return [
        portable(stage.findings, folder)
        for stage, folder in zip(report.stages, folders, strict=True)
    ]


def portable(findings: Iterable[Finding], folder: Path) -> tuple[Finding, ...]:
    """The findings in an example as they are everywhere, whatever folder it was written to.

    What is said of an old USD, and not of the example, is left out.
    """

    def anywhere(text: str) -> str:
        for absolute in (str(folder), folder.as_posix()):
            text = text.replace(absolute, "<folder>")
        return text.replace(f"{folder.name}/", "")

    return tuple(
        replace(
            finding,
            message=anywhere(finding.message),
            suggestion=finding.suggestion and anywhere(finding.suggestion),
            site=replace(finding.site, layer=anywhere(finding.site.layer)),
        )
        for finding in findings
        if finding.code != USD_TOO_OLD.code
    )


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
    """The file that says what the examples of a page say."""
    return page.path.with_suffix(".words.txt")


def said(findings: Iterable[Finding]) -> str:
    """What is said of one example, each finding with its place, its message and its advice."""
    return "".join(f"  {line}\n" for finding in findings for line in _entry(finding))


def _entry(finding: Finding) -> Iterator[str]:
    site = finding.site
    about = f"{site.prim or ''}.{site.property}" if site.property else site.prim
    frames = f" [{site.frames}]" if site.frames else ""
    variant = f" (variant {site.variant})" if site.variant else ""
    place = f"{site.layer}:{site.line}" if site.line else site.layer
    level = finding.severity.label
    on = f" <{about}>" if about else ""
    yield printable(f"{place}: {finding.code} {level}{on}{frames}{variant}")
    yield f"  {printable(finding.message)}"
    if finding.suggestion:
        yield f"  help: {printable(finding.suggestion)}"


def words(page: Page, found: Iterable[tuple[Case, Iterable[Finding]]]) -> str:
    """The text of a page's words file; empty if its examples say nothing."""
    blocks = [f"\n{case.title}\n{text}" for case, findings in found if (text := said(findings))]
    head = f"# What is said of the examples in {page.path.name}.\n"
    return head + "".join(blocks) if blocks else ""


def read_words(page: Page) -> dict[str, str] | None:
    """What is to be said of each example, by its title; None where there is no words file."""
    try:
        text = words_file(page).read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    blocks = (block.partition("\n") for block in text.split("\n\n")[1:])
    return {title: said.rstrip("\n") + "\n" for title, _, said in blocks}


def all_words(folder: Path, packs: Iterable[str] = ()) -> dict[Path, str]:
    """Every words file that the pack in a folder should have, with its text."""
    examples = [case for page in pages(folder) for case in cases(page)]
    found = zip(examples, run(examples, folder / "assets", packs), strict=True)
    by_page = groupby(found, key=lambda pair: pair[0].page)
    texts = {words_file(page): words(page, pairs) for page, pairs in by_page}
    return {path: text for path, text in texts.items() if text}


# --- a whole pack ---------------------------------------------------------------------------------


def check_pack(pack: str, others: Sequence[str] = ()) -> tuple[list[str], str]:
    """A line for each example of a pack that fails, and the verdict.

    The built-in rules are in force too, and those of `others`.
    Raises UsageError for a pack without examples, or with one that can't be read.
    """
    packs = (*others, pack)
    rules = load(packs).rules
    folder = Path(pack)
    every = pages(folder)
    examples = [case for page in every for case in cases(page)]
    if not examples:
        raise PackError(f"rule pack {pack!r}: {'no page has an example' if every else 'no pages'}")
    failures = [line for page in every for line in _faults(page, rules)]
    for case, found in zip(examples, run(examples, folder / "assets", packs), strict=True):
        failures += _failures(case, found, rules)
    return failures, _verdict(len(failures), len(examples), len(every))


def _faults(page: Page, rules: Mapping[str, Rule]) -> Iterator[str]:
    rule = rules.get(page.code)
    if rule is None or rule.name != page.name:
        yield f"{display(str(page.path))}:1: there is no rule {page.name} ({page.code})"


def _failures(case: Case, findings: Sequence[Finding], rules: Mapping[str, Rule]) -> Iterator[str]:
    """One line that says what is other than marks and words have it, if something is."""
    place = f"{display(str(case.page.path))}:{case.example.line}: {case.title}"
    expected, found = marks(case, rules), Counter(map(mark, findings))
    if expected != found:
        unexpected = found - expected
        surplus = [
            f"{mark(each)} ({printable(each.message)})"
            for each in findings
            if mark(each) in unexpected
        ]
        missing = list(map(str, (expected - found).elements()))
        yield f"{place}: expected {_list(missing, expected)}, found {_list(surplus, found)}"
        return
    agreed = read_words(case.page)
    if agreed is not None and (text := said(findings)) != (wanted := agreed.get(case.title, "")):
        yield f"{place}: expected the words {_first(wanted, text)}, found {_first(text, wanted)}"


def _list(differing: list[str], every: Counter[Mark]) -> str:
    return ", ".join(differing) or ("nothing more" if every else "nothing")


def _first(text: str, other: str) -> str:
    """The first line of a text that is another one in the other."""
    lines, others = text.splitlines(), other.splitlines()
    differing = (line for n, line in enumerate(lines) if others[n : n + 1] != [line])
    return repr(next(differing, "nothing more").strip())


def _verdict(failures: int, examples: int, pages: int) -> str:
    came_to = f"failures: {failures}" if failures else "all report what they should"
    return f"examples: {examples}, pages: {pages}; {came_to}"
