"""`assert_clean`: a line in an exporter's own tests that fails with the report."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from process import ROOT, environment, write

from usdvol_lint import Config, UsageError, assert_clean, lint
from usdvol_lint.config import Glob

STAGE = """\
#usda 1.0
def Volume "smoke"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </smoke/density>
    def OpenVDBAsset "density"
    {
        token fieldDataType = "float"
        token fieldName = "density"
        token fieldClass = "fogVolume"
        asset filePath = @FILE@
    }
}
"""
GONE = STAGE.replace("FILE", "./gone.vdb")
URI = STAGE.replace("FILE", "studio://cloud.vdb")
TOLD = """\
1 error in 1 stage; 1 volume checked in ? s

gone.usda
  /smoke/density
    AST002 error: no file at './gone.vdb'
      --> gone.usda:11:26
      11 | asset filePath = @./gone.vdb@
         |                  ^
      at filePath
      help: write or copy it there, or name a file that is there
"""
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
EXPORTER = """\
import sys

from usdvol_lint import assert_clean


def test_export(monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert_clean("gone.usda")


def test_usd_is_in_other_processes_alone():
    assert not {"pxr", "numpy"} & sys.modules.keys()
"""


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return write(tmp_path, gone=GONE, uri=URI)


def said(*paths: str | Path, **options: object) -> str:
    with pytest.raises(AssertionError) as caught:
        assert_clean(*paths, **options)  # type: ignore[arg-type]
    return re.sub(r"in [\d.,]+ s\b", "in ? s", str(caught.value))


def test_it_fails_with_the_report(here: Path) -> None:
    """Of what counts: the info of the other stage is not told."""
    assert said("gone.usda") == TOLD
    assert (
        said(here).replace(f"{here}{os.sep}", "").partition("\n\n")[2] == TOLD.partition("\n\n")[2]
    )


def test_what_is_clean_passes(here: Path) -> None:
    assert_clean(here / "uri.usda")
    assert_clean("gone.usda", "uri.usda", ignore="SCH,AST002")
    assert_clean(here, ignore=["AST,"])
    assert_clean(here, select=["VOL"])


def test_levels(here: Path) -> None:
    assert "AST010 info" in said("uri.usda", fail_on="info")
    assert "AST010 info" in said("uri.usda", config=Config(fail_on_unchecked=True))
    assert "AST002" in said("gone.usda", config=Config(fail_on="never"))
    assert_clean("uri.usda", config=Config(fail_on="never"))
    assert "AST002" in said("gone.usda", config=Config(fail_on="never"), fail_on="error")


def test_a_stage_that_cannot_be_read_is_not_clean(here: Path) -> None:
    (here / "cut.usda").write_text("#usda 1.0\ndef Volume", encoding="utf-8")
    assert "LNT001 error" in said("cut.usda", fail_on="error")


def test_only_a_configuration_that_is_named_counts(here: Path) -> None:
    (here / "usdvol-lint.toml").write_text("ignore = ['AST']", encoding="utf-8")
    assert "AST002" in said("gone.usda")
    assert_clean("gone.usda", config="usdvol-lint.toml")
    assert_clean("gone.usda", config="usdvol-lint.toml", ignore="SCH")
    (here / "usdvol-lint.toml").write_text("exclude = ['*.usda']", encoding="utf-8")
    with pytest.raises(UsageError, match="nothing was checked: every stage is excluded"):
        assert_clean("gone.usda", config="usdvol-lint.toml")
    suppress = "suppress = [{ files = '/gone.usda', reason = 'later' }]"
    (here / "usdvol-lint.toml").write_text(suppress, encoding="utf-8")
    assert_clean("gone.usda", config=here / "usdvol-lint.toml")
    (here / "lax").mkdir()
    lax = here / "lax" / "lax.toml"
    lax.write_text(f"{suppress}\nroot = '..'", encoding="utf-8")
    assert_clean("gone.usda", config=lax)
    assert "AST010" in said(".", config=lax, fail_on="info", ignore="SCH")


@pytest.mark.parametrize(
    ("call", "words"),
    [
        ("assert_clean()", "assert_clean: nothing to check: name a stage or a folder"),
        ("assert_clean('gone.usda', ignore='AST02')", "'AST02' is no rule"),
        ("assert_clean('gone.usda', fail_on='warn')", "fail_on must be one of"),
        (
            "assert_clean('gone.usda', fail_on='never')",
            "fail_on must be one of error, warning, info, not 'never'",
        ),
        ("assert_clean('gone.usda', config='no.toml')", "no.toml: No such file or directory"),
        ("assert_clean('gone.usda', config=3)", "config must be a text or a Path, not 3"),
        ("assert_clean(['gone.usda'])", "not ['gone.usda']; name several one by one"),
        ("assert_clean(b'gone.usda')", "a path must be a text or a Path, not b'gone.usda'"),
        ("assert_clean(3)", "assert_clean: a path must be a text or a Path, not 3"),
        ("assert_clean('')", "an argument is empty"),
        ("assert_clean('gone.usda', select=[])", "`select` is empty"),
        ("assert_clean('gone.usda', config=Config(select=()))", "`select` is empty"),
        ("assert_clean('gone.usda', select='')", "select has an empty string"),
        ("assert_clean('gone.usda', select=['AST', ','])", "select has an empty string"),
        ("assert_clean('gone.usda', ignore='')", "ignore has an empty string"),
        ("assert_clean('gone.usda', ignore=3)", "ignore must be a text or a list of texts, not 3"),
        ("assert_clean('gone.usda', ignore=[3])", "ignore must be a list of strings, not [3]"),
    ],
)
def test_mistakes_are_no_finding(call: str, words: str, here: Path) -> None:
    with pytest.raises(UsageError, match=re.escape(words)):
        eval(call)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"exclude": (3,)}, "exclude must be a list of strings, not [3]"),
        ({"exclude": "*"}, "exclude must be a list of strings, not '*'"),
        ({"exclude": 3}, "exclude must be a list of strings, not 3"),
        ({"exclude": (Glob(None, "*"),)}, "exclude: the folder of a pattern must be a text"),  # type: ignore[arg-type]
        ({"stages": ("!",)}, "stages: '!' is no pattern"),
        ({"frames": "1-x"}, "frames: write it as FIRST-LAST, such as 1001-1100, not '1-x'"),
        ({"frames": (10, 1)}, "frames: '10-1' ends before it begins"),
        ({"frames": (1, "x")}, "frames: write it as FIRST-LAST, such as 1001-1100, not '1-x'"),
        ({"per_path": ({"files": "a"},)}, "per_path, table 1: say what is so there"),
        ({"per_path": 3}, "per_path must be tables, each below a line [[per-path]], not [3]"),
        ({"suppress": ({"rules": "AST"},)}, "suppress, table 1: 'reason' must say why"),
        ({"ignore": "AST"}, "ignore must be a list of strings, not 'AST'"),
        ({"select": "AST"}, "select must be a list of strings, not 'AST'"),
        ({"severity": {"AST": "nfo"}}, "severity.AST must be one of"),
        ({"severity": {3: "info"}}, "severity must be a table with texts as keys, not 3"),
        ({"options": {"AST002": 3}}, "options.AST002 must be a table, not 3"),
        ({"jobs": "x"}, "jobs must be a whole number from 0, not 'x'"),
        ({"jobs": None}, "jobs must be a whole number from 0, not None"),
        ({"statistics": 1}, "statistics must be true or false, not 1"),
        ({"required_version": ">9"}, "required_version is '>9', and this is usdvol-lint"),
        ({"version_pattern": "("}, "version_pattern: '(' is no regular expression"),
        ({"version_pattern": "(" * 5000}, "is no regular expression: it is nested too deep"),
        ({"version_pattern": r"(?i)v\d+"}, "has flags for all of a path: write '(?i:…)' around it"),
        ({"version_pattern": r"^v\d+"}, "begins or ends with '^' or '$': leave it out, for"),
        ({"version_pattern": r"v\d+$"}, "begins or ends with '^' or '$': leave it out, for"),
        ({"today": "x"}, "today must be a date"),
        ({"search_path": ("gone",)}, "search_path: there is no folder 'gone'"),
        ({"path_map": {"": "cache"}}, "path_map has an empty beginning, which every path has"),
        ({"path_map": {"P:/": ""}}, "path_map.P:/ must not be empty"),
        ({"origins": 3}, "the settings must be a usdvol_lint.Config"),
    ],
)
def test_wrong_settings_of_a_program_are_no_finding(
    settings: dict[str, Any], words: str, here: Path
) -> None:
    config = Config(**settings)
    with pytest.raises(UsageError, match=re.escape(words)):
        assert_clean("uri.usda", config=config)
    with pytest.raises(UsageError, match=re.escape(words)):
        lint(["uri.usda"], config)


def test_settings_of_a_program_mean_what_those_of_a_file_do(here: Path) -> None:
    assert_clean(here, config=Config(exclude=("gone.usda",)))  # type: ignore[arg-type]
    assert_clean(here, config=Config(ignore=["AST"], frames=(1, 10)))  # type: ignore[arg-type]
    later = {"files": "/gone.usda", "ignore": ["AST"]}
    assert_clean(here, config=Config(per_path=(later,), root=str(here)))  # type: ignore[arg-type]
    (here / "lax.toml").write_text("content = 'off'\nfail-on-unchecked = true", encoding="utf-8")
    refused = "needs a run that looks at everything: leave out "
    with pytest.raises(UsageError, match=f"{refused}content off"):
        assert_clean("uri.usda", config=Config(fail_on_unchecked=True, content="off"))
    with pytest.raises(UsageError, match=f"{refused}lax.toml: content = 'off'"):
        assert_clean("uri.usda", config="lax.toml")


def exporter(folder: Path, text: str) -> list[str]:
    """What pytest prints for the tests in the text, without its marks of errors."""
    (folder / "test_exporter.py").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-P", "-m", "pytest", "-q", "-p", "no:cacheprovider", "-W", "error"],
        cwd=folder,
        env=environment(PYTHONPATH=str(ROOT)),
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 1, done.stdout + done.stderr
    return done.stdout.splitlines()


def test_in_the_tests_of_an_exporter(here: Path) -> None:
    """Pytest shows the line of the test and the report, and nothing of ours between them."""
    lines = exporter(here, EXPORTER)
    assert "E           AST002 error: no file at './gone.vdb'" in lines
    told = "FAILED test_exporter.py::test_export - AssertionError: 1 error in 1 stage"
    assert [line for line in lines if line.startswith(told)]
    assert "1 failed, 1 passed" in lines[-1]
    assert not [line for line in lines if "asserting.py" in line]


def test_the_page_shows_what_happens(here: Path) -> None:
    test, *others = BLOCK.findall((ROOT / "docs" / "pytest.md").read_text(encoding="utf-8"))
    stage = STAGE.replace("FILE", "./smoke.0001.vdb")
    lines = exporter(here, f"def export_smoke(path): path.write_text({stage!r})\n{test[1]}")
    printed = [re.sub(r"in [\d.]+ s$|\S+/(?=smoke\.usda)", "", line.rstrip()) for line in lines]
    for line in others.pop(0)[1].splitlines():
        assert re.sub(r"in [\d.]+ s$", "", line) in printed
    write(here / "out", stage='#usda 1.0\ndef Xform "x"\n{\n}\n')
    (here / "usdvol-lint.toml").write_text("", encoding="utf-8")
    for language, text in others:
        assert language == "python"
        exec(text, {"assert_clean": assert_clean})
