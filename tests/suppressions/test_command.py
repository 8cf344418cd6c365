"""Suppressions as users meet them: verdicts, exit codes, baselines, and what is listed."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from process import Ran, environment, run
from stagetexts import INSTANCE, field, on_layer, on_prim, prim

RULES = 'root = "."\nselect = ["AST002", "FLD002", "LNT"]\n'
TABLE = '[[suppress]]\nprims = "/World/Old/**"\nreason = "an old cache"\n'


@pytest.fixture
def library(tmp_path: Path) -> Path:
    """An asset under two shots, each of which ignores it for a reason of its own or not at all."""
    stages = {
        "asset": '(defaultPrim = "Smoke")\n' + prim("Smoke", inside=field()),
        "s1": prim("World", "references = @./asset.usda@", on_prim(AST002="shot one")),
        "s2": prim("World", inside=prim("Old", "references = @./asset.usda@")),
    }
    for name, text in stages.items():
        (tmp_path / f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    (tmp_path / "usdvol-lint.toml").write_text(RULES + TABLE, encoding="utf-8")
    return tmp_path


def causes(library: Path, *arguments: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = run(*arguments, "--output-format", "json", cwd=library).json[
        "causes"
    ]
    return found


def states(library: Path, *arguments: str) -> list[tuple[str, str, str | None, int]]:
    return [
        (each["code"], each["state"], each["reason"], each["count"])
        for each in causes(library, *arguments)
    ]


def test_places_are_taken_away_and_a_cause_once_none_is_left(library: Path) -> None:
    """A suppression of one shot and one of the configuration both hold, each with its reason."""
    assert states(library, "s1.usda", "s2.usda", "asset.usda") == [("AST002", "new", None, 1)]
    ran = run("s1.usda", "s2.usda", "--show", "suppressed", cwd=library)
    assert (ran.code, ran.err) == (0, "")
    assert [
        line.strip() for line in ran.out.splitlines() if "suppressed" in line or "reason" in line
    ] == [
        "AST002 error (suppressed): no file at './gone.vdb'",
        "reason: shot one",
        "reason: an old cache",
        ran.out.splitlines()[-1],
    ]
    assert ran.out.splitlines()[-1].startswith("no findings in 2 stages; 1 suppressed; ")
    (cause,) = causes(library, "s1.usda", "s2.usda")
    assert (cause["state"], cause["reason"], cause["count"]) == ("suppressed", "shot one", 2)
    assert [place.get("reason") for place in cause["places"]] == [None, "an old cache"]


def test_the_reason_in_a_stage_comes_first(library: Path) -> None:
    file = library / "usdvol-lint.toml"
    file.write_text(f'{RULES}[[suppress]]\nprims = "/**"\nreason = "all"\n', encoding="utf-8")
    (cause,) = causes(library, "s1.usda", "s2.usda")
    assert [cause["reason"], cause["places"][1]["reason"]] == ["shot one", "all"]


def test_who_audits_sees_all(library: Path) -> None:
    (library / "usdvol-lint.toml").write_text(
        f'suppressions = "configuration"\n{RULES}{TABLE}', encoding="utf-8"
    )
    assert states(library, "s1.usda") == [("AST002", "new", None, 1)]
    assert states(library, "s2.usda") == [("AST002", "suppressed", "an old cache", 1)]
    assert states(library, "s1.usda", "s2.usda", "--no-suppressions") == [
        ("AST002", "new", None, 2)
    ]


def test_what_is_suppressed_is_in_no_number_level_or_baseline(library: Path) -> None:
    """Only places that are left make a cause's level, its cover and its entry."""
    ran = run("s1.usda", "s2.usda", "--write-baseline", "b.jsonl", cwd=library)
    assert ran.code == 0
    assert len((library / "b.jsonl").read_text("utf-8").splitlines()) == 1
    report = run("s1.usda", "s2.usda", "--output-format", "json", cwd=library).json
    assert report["summary"]["errors"] == 0
    assert report["summary"]["stages_with_findings"] == 0
    assert report["summary"]["by_state"] == {"suppressed": 1}
    assert [stage["levels"] for stage in report["stages"]] == [{}, {}]

    frames = "".join(f"{frame}: @./gone.{frame}.vdb@," for frame in (1, 2))
    timed = field().replace(
        "asset filePath = @./gone.vdb@", f"asset filePath.timeSamples = {{{frames}}}"
    )
    asset = f'#usda 1.0\n(defaultPrim = "Smoke")\n{prim("Smoke", inside=timed)}'
    (library / "asset.usda").write_text(asset, encoding="utf-8")
    (library / "gone.2.vdb").write_bytes(b"not empty")
    found = causes(library, "s1.usda", "asset.usda", "--select", "AST002")
    assert [(each["cover"]["frames"], each["state"], each["count"]) for each in found] == [
        ("1", "new", 1)
    ]


def test_from_another_folder_it_is_the_same(library: Path) -> None:
    (library / "usdvol-lint.toml").write_text(
        f'{RULES}[[suppress]]\nstages = "/s2.usda"\nfiles = "/asset.usda"\nreason = "x"\n',
        encoding="utf-8",
    )
    inside = library / "inside"
    inside.mkdir()
    assert run("../s2.usda", "--quiet", cwd=inside).code == 0
    assert run("../asset.usda", "--quiet", cwd=inside).code == 1
    assert run("s2.usda", "--quiet", cwd=library).code == 0


def test_what_is_over_is_told(library: Path) -> None:
    file = library / "usdvol-lint.toml"
    file.write_text(f"{RULES}{TABLE}until = 2026-12-31\n", encoding="utf-8")
    ran = run("s2.usda", "--today", "2026-12-31", cwd=library)
    assert (ran.code, ran.err) == (0, "")
    ran = run("s2.usda", "--today", "2027-01-01", cwd=library)
    told = "suppress, table 1: was until 2026-12-31, which is over: 'an old cache'"
    assert (ran.code, ran.err) == (1, f"usdvol-lint: {file}: {told}\n")
    assert run("s2.usda", "--today", "2027-01-01", "--quiet", cwd=library).err == ""


def test_one_of_several_instances(library: Path) -> None:
    instances = prim("Old", INSTANCE) + prim("New", INSTANCE)
    text = f"#usda 1.0\n{prim('World', inside=instances)}"
    (library / "s3.usda").write_text(text, encoding="utf-8")
    (cause,) = causes(library, "s3.usda")
    assert [place["prim"] for place in cause["places"]] == ["/World/New/density"]


def test_what_is_suppressed_at_any_level_is_listed_where_asked(library: Path) -> None:
    bare = field().replace('token fieldDataType = "float"', "")
    text = f"#usda 1.0\n{on_layer(FLD002='known', AST002='gone')}{bare}"
    (library / "s4.usda").write_text(text, encoding="utf-8")
    ran = run("s4.usda", "--show", "suppressed", cwd=library)
    assert "; 2 suppressed; " in ran.out
    assert ran.out.count("(suppressed): ") == 2
    assert "suppressed):" not in run("s4.usda", cwd=library).out


def test_unused_ones_need_a_whole_run(tool: Callable[..., Ran]) -> None:
    for option, value in (("load", "none"), ("content", "first"), ("times", "ends")):
        ran = tool("--show", "unused", f"--{option}", value, ".")
        said = "--show unused needs a run that looks at everything: leave out"
        assert (ran.code, ran.err) == (2, f"usdvol-lint: error: {said} --{option} {value}\n")


def test_unused_ones_are_shown(library: Path) -> None:
    text = f"#usda 1.0\n{prim('Calm', on_prim(AST002='once'))}"
    (library / "calm.usda").write_text(text, encoding="utf-8")
    assert "LNT003" not in run("calm.usda", cwd=library).out
    ran = run("calm.usda", "--show", "unused", cwd=library)
    assert "LNT003 warning: AST002 is ignored here, and nothing is found that" in ran.out
    assert ran.code == 0


def test_settings_say_what_is_suppressed(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ran = run("--show-settings", "--output-format", "json", cwd=library)
    settings = json.loads(ran.out)
    assert settings["suppressions"] == "all"
    assert settings["suppress"] == [{"prims": ["/World/Old/**"], "reason": "an old cache"}]


def test_a_run_without_tables_needs_no_patterns(library: Path) -> None:
    """`pathspec` is imported only where a configuration suppresses something."""
    program = (
        "import sys; sys.argv = ['usdvol-lint', *sys.argv[1:]]; import os; leave = os._exit\n"
        "os._exit = lambda code: (print('pathspec' in sys.modules, flush=True), leave(code))\n"
        "from usdvol_lint.__main__ import main; main()"
    )
    for option, is_imported in (("--isolated", "False"), ("--fail-on=never", "True")):
        done = subprocess.run(
            [sys.executable, "-P", "-c", program, "--quiet", option, "s1.usda"],
            cwd=library,
            env=environment(),
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.stdout.split()[-1] == is_imported


def test_bad_values_are_named(tool: Callable[..., Ran], tmp_path: Path) -> None:
    ran = tool("--today", "31.12.2026", ".")
    said = "usdvol-lint: error: --today must be a date such as 2026-12-31, not '31.12.2026'\n"
    assert (ran.code, ran.err) == (2, said)
    file = tmp_path / "usdvol-lint.toml"
    file.write_text("[[suppress]]\nfile = 'x'\n", encoding="utf-8")
    ran = tool(".")
    assert ran.code == 2
    assert ran.err == (
        f"usdvol-lint: error: {file}: suppress, table 1: unknown key 'file'; "
        "did you mean 'files'?\n"
    )
    file.write_text("suppressions = 'stages'\n", encoding="utf-8")
    ran = tool(".")
    assert ran.err == (
        f"usdvol-lint: error: {file}: suppressions must be one of all, configuration, none, "
        "not 'stages'\n"
    )
