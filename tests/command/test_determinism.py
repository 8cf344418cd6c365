"""Equal runs say equal bytes, whoever makes them, wherever, and with however many processes."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

import pytest
from process import ROOT, environment, run

from usdvol_lint.report import FORMATS

FIELDS = """\
#usda 1.0
def Volume "v"
{{
    rel field:d = </v/d>
    rel field:e = </v/e>
    def OpenVDBAsset "d"
    {{
        asset filePath = @./gone.{name}.vdb@
    }}
    def OpenVDBAsset "e"
    {{
        asset filePath.timeSamples = {{1: @x.1.vdb@, 2: @x.2.vdb@}}
    }}
}}
"""
OTHER_WORLD = {
    "PYTHONHASHSEED": "7",
    "LC_ALL": "C",
    "PYTHONCOERCECLOCALE": "0",
    "PYTHONUTF8": "0",
    "TZ": "Asia/Kathmandu",
    "COLUMNS": "37",
}
"""Another seed, locale, time zone and width."""
FOR_PROGRAMS = ("json", "jsonl", "sarif", "github", "gitlab")


@pytest.fixture
def library(tmp_path: Path) -> Path:
    """The examples of the guide, stages whose names sort otherwise elsewhere, and a broken one."""
    folder = tmp_path / "library"
    shutil.copytree(ROOT / "docs" / "examples", folder / "examples")
    (folder / ".git").mkdir()
    for name in ("b", "A", "Z", "ä", "ß"):
        (folder / f"{name}.usda").write_text(FIELDS.format(name=name), encoding="utf-8")
    (folder / "broken.usda").write_text("#usda 1.0\ngarbage\n", encoding="utf-8")
    (folder / "usdvol-lint.toml").write_text("max-places = 2\njobs = 1\n", encoding="utf-8")
    return folder


def reports(
    library: Path, *arguments: str, cwd: Path | None = None, **variables: str
) -> dict[str, str]:
    """The reports of one run by format, without what is of the run alone."""
    out = library.parent / "out"
    out.mkdir(exist_ok=True)
    asked = [word for name in FORMATS for word in (f"--output-format={name}", f"--output={name}")]
    placed = [word.replace("--output=", f"--output={out}{os.sep}") for word in asked]
    named = ("--config", str(library / "usdvol-lint.toml"))
    ran = run(*named, *placed, *arguments, cwd=cwd or library, env=environment(**variables))
    assert (ran.code, ran.out, ran.err) == (2, "", ""), "the text goes to a file too"
    return {name: _of_any_run(name, (out / name).read_text("utf-8")) for name in FORMATS}


def _of_any_run(format: str, text: str) -> str:
    """The report without `run`, how long it took, and the command line that the text repeats."""
    if format == "json":
        return re.sub(r'^  "run": .*$', "", text, flags=re.MULTILINE)
    if format == "jsonl":
        return re.sub(r', "run": .*$', "", text, flags=re.MULTILINE)
    if format == "junit":
        return re.sub(r' (time|timestamp)="[^"]*"', "", text)
    return re.sub(r" in [\d.]+ s\b|: usdvol-lint --(summary|write-baseline) .*", "", text)


def test_the_same_bytes_in_another_world(library: Path) -> None:
    one = reports(library, ".")
    assert all(one.values())
    assert "gone.ä.vdb" in one["json"]
    assert reports(library, ".", "--jobs", "2", **OTHER_WORLD) == one


def test_the_same_bytes_for_programs_from_another_folder(library: Path) -> None:
    """What people read names what lies below the working directory in relation to that."""
    one = reports(library, str(library))
    other = reports(library, str(library), cwd=library / "examples")
    for name in FOR_PROGRAMS:
        assert one[name] == other[name], name


def test_the_same_bytes_for_any_order_of_arguments(library: Path) -> None:
    names = sorted(f"./{each.name}" for each in library.glob("*.usda"))
    one = reports(library, "examples", *names)
    assert reports(library, *names[::-1], "examples") == one
