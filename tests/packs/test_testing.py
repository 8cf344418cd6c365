"""`--test` runs the examples of a pack's pages, and says which report something else."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

import pytest
from process import ROOT, ROUGH, STUDIO, Ran, run

from usdvol_lint.model import Cover, Finding, Severity, Site, Source
from usdvol_lint.packs.catalog import load
from usdvol_lint.packs.examples import cases, pages, words_file, words_of
from usdvol_lint.packs.page import read_page
from usdvol_lint.run.testing import all_words, portable, write_example

PASSED = "examples: 2, pages: 1; all report what they should\n"
WITHOUT_CACHES = shutil.ignore_patterns("__pycache__")
FAILED = "examples: 2, pages: 1; failures: 1\n"


@pytest.fixture
def pack(tmp_path: Path) -> Path:
    """A copy of the studio's pack, to be changed."""
    return Path(shutil.copytree(STUDIO, tmp_path / "pack", ignore=WITHOUT_CACHES))


def edit(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1
    file.write_text(text.replace(old, new), encoding="utf-8")


def test_a_pack_that_passes(pack: Path, tmp_path: Path) -> None:
    """Wherever it is run from; the examples are written to a folder of their own."""
    before = sorted(tmp_path.rglob("*"))
    assert run("--test", STUDIO, cwd=tmp_path) == Ran(0, PASSED, "")
    assert run("--test", "pack", cwd=tmp_path) == Ran(0, PASSED, "")
    assert run(f"--test={os.path.relpath(pack, pack / 'house')}", cwd=pack / "house").code == 0
    assert [
        path for path in sorted(tmp_path.rglob("*")) if "__pycache__" not in str(path)
    ] == before


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "# STU001 STU002",
            "# STU001",
            "expected nothing more, found STU002 warning at example.usda:2 (seen)",
        ),
        (
            "# STU001 STU002",
            "# STU001=info STU002",
            "expected STU001 info at example.usda:2, "
            "found STU001 error at example.usda:2 (name 'fog', wanted smoke, fire)",
        ),
        (
            "# STU001 STU002",
            "# STU001 STU002 STU003",
            "expected STU003 (no such rule) at example.usda:2, found nothing more",
        ),
        (
            'Volume "fog"  # STU001 STU002\n{',
            'Volume "fog"\n{  # STU001 STU002',
            "expected STU001 error at example.usda:3, STU002 warning at example.usda:3, "
            "found STU001 error at example.usda:2 (name 'fog', wanted smoke, fire), "
            "STU002 warning at example.usda:2 (seen)",
        ),
    ],
)
def test_a_mark_that_is_wrong(old: str, new: str, said: str, pack: Path, tmp_path: Path) -> None:
    edit(pack / "house" / "volume_name.md", old, new)
    line = f"pack/house/volume_name.md:12: Wrong 1: {said}\n"
    assert run("--test", "pack", cwd=tmp_path) == Ran(1, line + FAILED, "")


def test_a_file_beside_the_example_has_marks_too(pack: Path, tmp_path: Path) -> None:
    edit(pack / "house" / "volume_name.md", '"smoke"  # STU002', '"smoke"')
    ran = run("--test", "pack", cwd=tmp_path)
    line = (
        "pack/house/volume_name.md:47: Right 1: "
        "expected nothing, found STU002 warning at smoke.usda:2 (seen)\n"
    )
    assert ran == Ran(1, line + FAILED, "")


def test_the_built_in_rules_are_in_force(pack: Path, tmp_path: Path) -> None:
    (pack / "assets" / "fog.vdb").unlink()
    ran = run("--test", "pack", cwd=tmp_path)
    said = "AST002 error at {}:9 (no file at './fog.vdb')"
    lines = (
        "pack/house/volume_name.md:12: Wrong 1: expected nothing more, found "
        f"{said.format('example.usda')}\n"
        "pack/house/volume_name.md:47: Right 1: expected nothing more, found "
        f"{said.format('smoke.usda')}\n"
    )
    assert ran == Ran(1, f"{lines}examples: 2, pages: 1; failures: 2\n", "")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "    name 'fog', wanted smoke, fire",
            "    name 'fog'",
            '''expected the words "name 'fog'", found "name 'fog', wanted smoke, fire"''',
        ),
        (
            "wanted smoke, fire\n",
            "wanted smoke, fire\n    help: rename it\n",
            "expected the words 'help: rename it', found 'example.usda:2: STU002 warning </fog>'",
        ),
        (
            "    seen\n\n",
            "\n",
            "expected the words 'nothing more', found 'seen'",
        ),
    ],
)
def test_words_that_are_others(old: str, new: str, said: str, pack: Path, tmp_path: Path) -> None:
    edit(pack / "house" / "volume_name.words.txt", old, new)
    line = f"pack/house/volume_name.md:12: Wrong 1: {said}\n"
    assert run("--test", "pack", cwd=tmp_path) == Ran(1, line + FAILED, "")


def test_words_are_not_required(pack: Path, tmp_path: Path) -> None:
    (pack / "house" / "volume_name.words.txt").unlink()
    assert run("--test", "pack", cwd=tmp_path) == Ran(0, PASSED, "")


def test_an_example_that_is_missing_from_the_words(pack: Path, tmp_path: Path) -> None:
    edit(pack / "house" / "volume_name.words.txt", "Right 1", "Right 2")
    ran = run("--test", "pack", cwd=tmp_path)
    line = (
        "pack/house/volume_name.md:47: Right 1: expected the words 'nothing more', "
        "found 'smoke.usda:2: STU002 warning </smoke>'\n"
    )
    assert ran == Ran(1, line + FAILED, "")


def test_a_page_of_no_rule(pack: Path, tmp_path: Path) -> None:
    edit(pack / "house" / "volume_name.md", "volume-name (STU001)", "volume-nam (STU001)")
    ran = run("--test", "pack", cwd=tmp_path)
    line = "pack/house/volume_name.md:1: there is no rule volume-nam (STU001)\n"
    assert ran == Ran(1, line + FAILED, "")


def test_rules_that_fail_or_crash(tmp_path: Path) -> None:
    """Each is one example that fails, and the others are run."""
    pack = Path(shutil.copytree(ROUGH, tmp_path / "pack"))
    page = "# behaves (RGH001)\n\nIt does what it is called.\n\n## Wrong\n" + "".join(
        f'```usda\n#usda 1.0\ndef Volume "{name}"  # {marks}\n{{\n}}\n```\n'
        for name, marks in (
            ("raise", "SCH007 VOL010=info"),
            ("abort", "RGH001 SCH007 VOL010=info"),
            ("good", "RGH001 SCH007 VOL010=info"),
        )
    )
    (pack / "behaves.md").write_text(page, encoding="utf-8")
    ran = run("--test", "pack", cwd=tmp_path)
    raised, crashed, verdict = ran.out.splitlines()
    assert raised == (
        "pack/behaves.md:7: Wrong 1: expected nothing more, found LNT002 error at example.usda:2 "
        "(rule RGH001 (behaves) failed here: ValueError: at /raise: second line)"
    )
    assert re.fullmatch(
        r"pack/behaves\.md:13: Wrong 2: expected RGH001 error at example\.usda:2, "
        r"(.+, )?found LNT001 error at example\.usda \(.+\)",
        crashed,
    )
    assert (ran.code, verdict, ran.err) == (1, "examples: 3, pages: 1; failures: 2", "")


@pytest.mark.parametrize(
    ("page", "said"),
    [
        (None, "rule pack 'pack': no pages"),
        ("# volume-name (STU001)\n\nWrong.\n", "rule pack 'pack': no page has an example"),
        (
            "no title\n",
            f"{Path('pack/house/volume_name.md')}: "
            "the page must begin with '# name (CODE)' and one sentence",
        ),
    ],
)
def test_a_pack_without_examples(page: str | None, said: str, pack: Path, tmp_path: Path) -> None:
    file = pack / "house" / "volume_name.md"
    file.unlink() if page is None else file.write_text(page, encoding="utf-8")
    ran = run("--test", "pack", cwd=tmp_path)
    assert ran == Ran(2, "", f"usdvol-lint: error: {said}\n")


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    said = "usdvol-lint: error: rule pack 'nowhere': no such folder\n"
    assert run("--test", "nowhere", cwd=tmp_path) == Ran(2, "", said)


def test_what_is_a_page(pack: Path) -> None:
    """What is named in capitals, as a README is, is none, nor is what `_` or `.` hides."""
    for name in ("README.md", "house/CHANGES.md", "_old/page.md", ".git/page.md", "house/_a.md"):
        (pack / name).parent.mkdir(exist_ok=True)
        (pack / name).write_text("no page\n", encoding="utf-8")
    assert [page.path for page in pages(pack)] == [pack / "house" / "volume_name.md"]


def test_a_pack_named_twice_is_loaded_once() -> None:
    """That its examples are run wherever it is installed, and those of the built-in rules."""
    assert load([str(ROOT / "rules")]) == load()


def test_words_are_written_as_they_are_read() -> None:
    file = words_file(pages(STUDIO)[0])
    assert all_words(STUDIO, [str(STUDIO)]) == {file: file.read_text(encoding="utf-8")}


def test_the_folder_of_an_example_is_not_in_its_words(tmp_path: Path) -> None:
    folder = tmp_path / "example-0001"
    finding = Finding(
        "AST002",
        "file-missing",
        Severity.ERROR,
        f"no file at {folder}/a.vdb or {folder.as_posix()}/b.vdb, example-0001/c.usda",
        Site("example-0001/example.usda", "/a", "b", "look=thin", 3, 7, (1.0, 2.0), True),
        Source("a.usda"),
        Cover(Severity.ERROR),
        suggestion=f"look at {folder}",
    )
    old = finding._replace(code="LNT004", message="old", site=Site("a.usda"))
    bare = finding._replace(
        code="LNT005",
        severity=Severity.INFO,
        message="two\nlines",
        site=Site("a.usdc"),
        suggestion=None,
    )
    assert words_of(portable([finding, old, bare], folder)) == (
        "  example.usda:3: AST002 error </a.b> [default, 1-2] (variant look=thin)\n"
        "    no file at <folder>/a.vdb or <folder>/b.vdb, c.usda\n"
        "    help: look at <folder>\n"
        "  a.usdc: LNT005 info\n"
        "    two\\x0alines\n"
    )


def test_an_example_may_have_a_file_called_like_an_asset(tmp_path: Path) -> None:
    """The asset itself stays what it was."""
    page, assets = tmp_path / "page.md", tmp_path / "assets"
    page.write_text("# page (STU009)\n\nA.\n\n```usda a.usda\nhere\n```\n```usda\nstage\n```\n")
    assets.mkdir()
    for name in "ab":
        (assets / f"{name}.usda").write_text("asset\n")
    (case,) = cases(read_page(page))
    write_example(case, tmp_path / "run", assets)
    read = {path.name: path.read_text() for path in (tmp_path / "run").iterdir()}
    assert read == {"a.usda": "here\n", "b.usda": "asset\n", "example.usda": "stage\n"}
    assert (assets / "a.usda").read_text() == "asset\n"


def test_a_package_of_an_example(tmp_path: Path) -> None:
    """It holds its text and cloud.vdb, if the pack has that."""
    from zipfile import ZipFile

    page = tmp_path / "page.md"
    page.write_text(
        "# page (STU009)\n\nA page.\n\n```usda in/a.usdz\n#usda 1.0\n```\n```usda\n#usda 1.0\n```\n"
    )
    (case,) = cases(read_page(page))
    for name, assets in (("with", ROOT / "rules" / "assets"), ("without", tmp_path / "none")):
        write_example(case, tmp_path / name, assets)
        packed = ZipFile(tmp_path / name / "in" / "a.usdz").namelist()
        assert packed == ["root.usda", *(["cloud.vdb"] if name == "with" else [])]
    assert sorted(path.name for path in (tmp_path / "without").iterdir()) == ["example.usda", "in"]
