"""Runs the examples of pages, and compares the findings with their marks and words."""

from __future__ import annotations

import os
import shutil
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import chdir
from itertools import groupby
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

from usdvol_lint.config import Config
from usdvol_lint.model import Finding, PackError
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import USD_TOO_OLD, load
from usdvol_lint.packs.examples import (
    STAGE,
    Case,
    Mark,
    cases,
    mark,
    marks,
    pages,
    read_words,
    words,
    words_file,
    words_of,
)
from usdvol_lint.packs.page import Page
from usdvol_lint.paths import display
from usdvol_lint.rule import Rule
from usdvol_lint.run.lint import stage_reports
from usdvol_lint.run.parts import completed_by
from usdvol_lint.run.pool import Pool
from usdvol_lint.words import printable

_PACKED = "cloud.vdb"
"""The asset of a pack that is put into each package of an example."""

_HERE = "<folder>"
"""What the folder of an example is called in it, and in what is said of it."""


def write_example(case: Case, folder: Path, assets: Path) -> None:
    """The example, its named files and all of a pack's assets, in one folder.

    `<folder>` in a text stands for the absolute path of that folder.
    A file whose name ends in .usdz is a package: the text is its root layer, beside cloud.vdb.
    """
    folder.mkdir(parents=True, exist_ok=True)
    if assets.is_dir():
        shutil.copytree(assets, folder, copy_function=_link, dirs_exist_ok=True)
    for name, text in case.texts.items():
        text = text.replace(_HERE, folder.as_posix())
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.unlink(missing_ok=True)  # it may be a link to one of the assets
        if name.endswith(".usdz"):
            _pack(file, text, assets / _PACKED)
        else:
            file.write_text(text, encoding="utf-8", newline="\n")


def _link(source: str, target: str) -> None:
    """Links a file, which takes a tenth of the time of a copy."""
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
    """The findings in each example under all rules, those that are off by default too."""
    config = Config(select=("ALL",), packs=tuple(map(os.path.realpath, packs)))
    assets = assets.resolve()
    with TemporaryDirectory() as temporary, chdir(temporary):
        here = Path.cwd()
        if assets.is_dir():
            assets = Path(shutil.copytree(assets, here / "assets"))
        folders = [here / f"example-{number:04}" for number in range(len(examples))]
        for case, folder in zip(examples, folders, strict=True):
            write_example(case, folder, assets)
        found = findings_in([f"{folder.name}/{STAGE}" for folder in folders], config)
    return [portable(each, folder) for each, folder in zip(found, folders, strict=True)]


def findings_in(paths: Sequence[str], config: Config) -> list[tuple[Finding, ...]]:
    """What each stage shows, without what others of them complete."""
    pool = Pool()
    try:
        active = activate(config, load(config.packs))
        reports = [
            report
            for report in stage_reports(pool, paths, config, active, os.cpu_count() or 1)
            if report
        ]
    finally:
        pool.close()
    is_completed = completed_by(reports)
    return [
        tuple(each for each in report.findings if not is_completed(report, each))
        for report in reports
    ]


def portable(findings: Iterable[Finding], folder: Path) -> tuple[Finding, ...]:
    """The findings in an example, independent of the folder that it was written to.

    LNT004, which is about an old USD and not about the example, is left out, and what the example
    ignores.
    """

    def anywhere(text: str) -> str:
        for absolute in (str(folder), folder.as_posix()):
            text = text.replace(absolute, _HERE)
        return text.replace(f"{folder.name}/", "")

    return tuple(
        finding._replace(
            message=anywhere(finding.message),
            suggestion=finding.suggestion and anywhere(finding.suggestion),
            site=finding.site._replace(layer=anywhere(finding.site.layer)),
        )
        for finding in findings
        if finding.code != USD_TOO_OLD.code and finding.ignored is None
    )


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
    """One line on how findings differ from the marks, or else from the words, if they do."""
    location = f"{display(str(case.page.path))}:{case.example.line}: {case.title}"
    expected, found = marks(case, rules), Counter(map(mark, findings))
    if expected != found:
        unexpected = found - expected
        surplus = [
            f"{mark(each)} ({printable(each.message)})"
            for each in findings
            if mark(each) in unexpected
        ]
        missing = list(map(str, (expected - found).elements()))
        yield f"{location}: expected {_list(missing, expected)}, found {_list(surplus, found)}"
        return
    agreed = read_words(case.page)
    if agreed is None:
        return
    wanted, text = agreed.get(case.title, ""), words_of(findings)
    if text != wanted:
        yield f"{location}: expected the words {_first(wanted, text)}, found {_first(text, wanted)}"


def _list(differing: list[str], every: Counter[Mark]) -> str:
    return ", ".join(differing) or ("nothing more" if every else "nothing")


def _first(text: str, other: str) -> str:
    """The first line of a text that differs from the other text."""
    lines, others = text.splitlines(), other.splitlines()
    differing = (line for n, line in enumerate(lines) if others[n : n + 1] != [line])
    return repr(next(differing, "nothing more").strip())


def _verdict(failures: int, examples: int, pages: int) -> str:
    came_to = f"failures: {failures}" if failures else "all report what they should"
    return f"examples: {examples}, pages: {pages}; {came_to}"
