"""`--fail-on-unchecked`: nothing passes that was not checked, at whatever level that is said."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ROOT, Ran, run, settings, write

from usdvol_lint import lint
from usdvol_lint.report import Options
from usdvol_lint.results import UNCHECKED

FIELD = """\
#usda 1.0
def Volume "smoke"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </smoke/density>
    def OpenVDBAsset "density"
    {
        asset filePath = @FILE@
        token fieldDataType = "float"
        token fieldName = "density"
        token fieldClass = "fogVolume"
    }
}
"""
URI = FIELD.replace("FILE", "studio://cloud.vdb")
STUDIO_FIELD = FIELD.replace("OpenVDBAsset", "StudioFieldAsset").replace("@FILE@", "@./a.vdb@")
ALEMBIC = '#usda 1.0\ndef Xform "set" (references = @./set.abc@)\n{\n}\n'
VARIANTS = """\
#usda 1.0
def Volume "smoke" (
    variants = {
        string look = "a"
    }
    prepend variantSets = "look"
)
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    variantSet "look" = {
        "a" {
        }
        "b" {
        }
        "c" {
        }
    }
}
"""
TOLD = re.compile(r"\b(?:un|not (?:be )?)checked\b|not looked into|was not compared")


def uri(folder: Path) -> Path:
    return write(folder, uri=URI)


@pytest.mark.parametrize(
    ("text", "arguments", "code"),
    [
        (URI, "", "AST010"),
        (URI, "--fail-on never", "AST010"),
        (STUDIO_FIELD, "", "LNT005"),
        (STUDIO_FIELD, "--ignore LNT", "LNT005"),
        (STUDIO_FIELD, "--select VOL", "LNT005"),
        *(
            (STUDIO_FIELD, f"--{chosen}", "LNT005")
            for chosen in (
                "select AST",
                "select VOL001",
                "ignore VOL",
                "ignore VOL002",
                "ignore ALL",
            )
        ),
        *((URI, f"--{chosen}", "AST010") for chosen in ("ignore AST", "select PRT", "ignore ALL")),
        (URI, "--config lax.toml", "AST010"),
        (ALEMBIC, "--ignore AST", "LNT005"),
        (ALEMBIC.replace(".abc", ".usda"), "--severity STG001=info", "STG001"),
        (VARIANTS, "--ignore VOL --variants all --config few.toml", "LNT005"),
    ],
)
def test_what_was_not_checked_fails_the_run(
    text: str, arguments: str, code: str, tmp_path: Path
) -> None:
    """And is told, since nobody could see otherwise why the run failed."""
    (tmp_path / "set.abc").write_text("Ogawa")
    per_path = '[[per-path]]\nfiles = "**"\nignore = ["AST"]\n'
    (tmp_path / "lax.toml").write_text(per_path, encoding="utf-8")
    (tmp_path / "few.toml").write_text("variant-limit = 1", encoding="utf-8")
    write(tmp_path, stage=text)
    ran = run("--fail-on-unchecked", "--quiet", *arguments.split(), "stage.usda", cwd=tmp_path)
    assert (ran.code, ran.err) == (1, "")
    assert re.findall(r"[A-Z]{3}\d{3} info", ran.out) == [f"{code} info"]


def test_it_fails_no_run_that_checks_all(tmp_path: Path) -> None:
    shot = ROOT / "docs" / "examples" / "shot"
    ran = run("--fail-on-unchecked", "--ignore", "STG", "--quiet", shot, cwd=tmp_path)
    assert ran == Ran(0, "", "")


def test_the_verdict_counts_it(tmp_path: Path) -> None:
    ran = run("--fail-on-unchecked", "uri.usda", cwd=uri(tmp_path))
    said = "no errors or warnings in 1 stage; 1 not checked, which --fail-on-unchecked counts; "
    assert ran.out.splitlines()[-1].startswith(f"{said}1 volume checked in ")


def test_a_configuration_can_ask_for_it(tmp_path: Path, tool: Callable[..., Ran]) -> None:
    (tmp_path / "usdvol-lint.toml").write_text("fail-on-unchecked = true", encoding="utf-8")
    assert settings(tool("--show-settings", "--output-format", "json"))["fail_on_unchecked"] is True
    assert run("--quiet", "uri.usda", cwd=uri(tmp_path)).code == 1
    assert run("--quiet", "--isolated", "uri.usda", cwd=tmp_path) == Ran(0, "", "")


def test_what_is_known_or_suppressed_does_not_count(tmp_path: Path) -> None:
    strict = ("--fail-on-unchecked", "--quiet", "uri.usda")
    (tmp_path / "usdvol-lint.toml").write_text('root = "."', encoding="utf-8")
    assert run(*strict, "--write-baseline", "known.jsonl", cwd=uri(tmp_path)).code == 0
    assert run(*strict, "--baseline", "known.jsonl", cwd=tmp_path) == Ran(0, "", "")
    suppress = 'suppress = [{ rules = ["AST010"], reason = "checked on the farm" }]'
    (tmp_path / "usdvol-lint.toml").write_text(suppress, encoding="utf-8")
    assert run(*strict, cwd=tmp_path) == Ran(0, "", "")


def test_every_format_knows_that_it_fails_the_run(tmp_path: Path) -> None:
    (cause,) = lint([str(uri(tmp_path) / "uri.usda")]).causes
    options = Options(fail_on=None)
    assert not options.fails(cause)
    assert options._replace(fail_on_unchecked=True).fails(cause)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        *(
            (
                f"--{name}",
                f"--fail-on-unchecked needs a run that looks at everything: leave out --{name}",
            )
            for name in ("content off", "content first", "times ends", "load none")
        ),
        *(
            (
                f"--ignore {code}",
                f"--ignore: {code} can't be ignored with --fail-on-unchecked: leave one out",
            )
            for code in ("LNT005", "lnt004", "AST010", "STG001", "path-unverifiable")
        ),
    ],
)
def test_it_excludes_what_leaves_something_out(
    arguments: str, said: str, tool: Callable[..., Ran]
) -> None:
    ran = tool("--fail-on-unchecked", "--show-settings", *arguments.split())
    assert ran == Ran(2, "", f"usdvol-lint: error: {said}\n")


def test_it_excludes_what_hides_it_by_path(tmp_path: Path) -> None:
    for said, ignored in (("LNT005", '["LNT005"]'), ("AST010", '["VOL", "AST010"]')):
        text = f'[[per-path]]\nfiles = "**"\nignore = {ignored}\n'
        (tmp_path / "usdvol-lint.toml").write_text(text, encoding="utf-8")
        ran = run("--fail-on-unchecked", "uri.usda", cwd=uri(tmp_path))
        told = f"ignore: {said} can't be ignored with --fail-on-unchecked: leave one out"
        assert (ran.code, ran.out) == (2, "")
        assert ran.err.endswith(f"per-path, table 1: {told}\n")


def test_it_excludes_what_is_assumed(tmp_path: Path) -> None:
    (tmp_path / "usdvol-lint.toml").write_text('assume-present = ["/mnt/**"]', encoding="utf-8")
    ran = run("--fail-on-unchecked", "uri.usda", cwd=uri(tmp_path))
    said = "--fail-on-unchecked needs a run that looks at everything: leave out "
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith(f"usdvol-lint: error: {said}")
    assert ran.err.endswith("usdvol-lint.toml: assume-present\n")


def test_what_only_watches_finds_nothing(tmp_path: Path) -> None:
    """A rule that is not in force says what it can't check, and nothing of what is wrong."""
    missing = FIELD.replace("</smoke/density>", "</smoke/gone>").replace("FILE", "./a.vdb")
    write(tmp_path, stage=missing)
    ran = run("--fail-on-unchecked", "--quiet", "--select", "PRT", "stage.usda", cwd=tmp_path)
    assert ran == Ran(0, "", "")


def test_every_rule_that_says_so_is_known() -> None:
    """A new rule, or case of one, that says that something was not checked has to be counted."""
    saying = {
        match[1]
        for path in (ROOT / "rules").rglob("*.words.txt")
        for match in re.finditer(r"(\b[A-Z]{3}\d{3}) .*\n(    .*\n)", path.read_text("utf-8"))
        if TOLD.search(match[2])
    }
    assert saying == UNCHECKED - {"LNT004"}  # which only an old USD shows
