"""Baselines as users meet them: options, exit codes, configuration, and what is said."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ONLY_STUDIO, STUDIO, Ran, run, volume, write

ROOTED = "root = '.'\nselect = ['STU']\nbaseline = 'b.jsonl'\n"


@pytest.fixture
def library(tmp_path: Path) -> Path:
    """A folder with two stages, and with a configuration that names a baseline."""
    write(tmp_path, fog=volume("fog"), smoke=volume("smoke"))
    (tmp_path / "usdvol-lint.toml").write_text(ROOTED, encoding="utf-8")
    return tmp_path


def checked(*arguments: str | Path, cwd: Path) -> Ran:
    """A run with the rules of a studio, and with the configuration that is found there."""
    return run("--pack", STUDIO, *arguments, cwd=cwd)


def test_a_library_is_adopted(library: Path) -> None:
    """The finding of today is known tomorrow, from any folder; a new stage over it is not."""
    assert checked(".", "--no-baseline", cwd=library).code == 1
    ran = checked("--write-baseline", "b.jsonl", ".", cwd=library)
    assert (ran.code, ran.err) == (0, "")
    assert len((library / "b.jsonl").read_text("utf-8").splitlines()) == 1 + len(states(library))
    assert checked(".", cwd=library).code == 0
    assert checked(library, cwd=write(library / "sub")).code == 0
    assert set(states(library)) == {"known"}

    write(library / "sub", mist=volume("mist"))
    assert checked(".", cwd=library).code == 1
    assert checked("--write-baseline", "b.jsonl", "sub", cwd=library).code == 0
    assert checked(".", cwd=library).code == 0, "what sub does not cover was kept"


def test_what_a_run_does_not_look_at_is_kept(library: Path) -> None:
    """Also where the baseline is written without being read, or nothing is checked."""
    write = ("--no-baseline", "--write-baseline", "b.jsonl")
    checked(*write, ".", cwd=library)
    before = (library / "b.jsonl").read_text("utf-8")
    assert checked(*write, "fog.usda", cwd=library).code == 0
    assert (library / "b.jsonl").read_text("utf-8") == before
    (library / "empty.txt").touch()
    for nothing in (("--exclude", "*", "."), ("--files-from", "empty.txt")):
        for options in (write, write[1:]):
            ran = checked(*options, *nothing, cwd=library)
            assert (ran.code, ran.err) == (0, "")
            assert ran.out.startswith("nothing to check: ")
            assert ran.out.endswith("; b.jsonl stays as it is\n")
            assert (library / "b.jsonl").read_text("utf-8") == before
    (library / "fog.usda").unlink()
    assert checked(*write, ".", cwd=library).code == 0
    assert "fog" not in (library / "b.jsonl").read_text("utf-8")


def states(library: Path) -> list[str]:
    ran = checked(".", "--output-format", "json", cwd=library)
    return [cause["state"] for cause in ran.json["causes"]]


def test_what_is_gone_is_told_and_pruned(library: Path) -> None:
    checked("--write-baseline", "b.jsonl", ".", cwd=library)
    (library / "smoke.usda").unlink()
    assert checked(".", cwd=library).code == 0
    assert checked(".", "--fail-on-unpruned", cwd=library).code == 1
    ran = checked("fog.usda", "--prune-baseline", cwd=library)
    assert (ran.code, ran.err) == (
        2,
        "usdvol-lint: error: --prune-baseline: this run sees less than b.jsonl has: "
        "not checked: .\n",
    )
    assert checked("fog.usda", "--fail-on-unpruned", cwd=library).code == 0
    assert checked(".", "--prune-baseline", cwd=library).code == 0
    assert checked(".", "--fail-on-unpruned", cwd=library).code == 0


def test_a_stage_that_cannot_be_read_stays_red(library: Path) -> None:
    (library / "broken.usda").write_text("nonsense", encoding="utf-8")
    ran = checked("--write-baseline", "b.jsonl", ".", cwd=library)
    assert ran.code == 2
    assert ran.err == (
        "usdvol-lint: error: b.jsonl is written, but it can't hold broken.usda (LNT001): "
        "mend it, or check the others without it\n"
    )
    assert checked(".", cwd=library).code == 2
    assert checked("fog.usda", "smoke.usda", cwd=library).code == 0


def test_a_report_is_a_baseline(library: Path) -> None:
    report = ("--no-baseline", "--output-format", "json", "--output", "r.json")
    assert checked(".", *report, cwd=library).code == 1
    assert json.loads((library / "r.json").read_text("utf-8"))["schema_version"].startswith("2.")
    assert checked(".", "--baseline", "r.json", cwd=library).code == 0
    (library / "smoke.usda").unlink()
    assert checked(".", "--baseline", "r.json", "--fail-on-unpruned", cwd=library).code == 1


@pytest.mark.parametrize("new", ["mist.usda", "./mist.usda", "gone/../mist.usda/"])
def test_a_new_name_may_be_spelt_in_any_way(new: str, library: Path) -> None:
    assert checked(".", "--write-baseline", "b.jsonl", cwd=library).code == 0
    (library / "fog.usda").rename(library / "mist.usda")
    assert checked(".", "--baseline", "b.jsonl", cwd=library).code == 1
    moved = ("--moved", f"fog.usda={new}")
    assert checked(".", "--baseline", "b.jsonl", *moved, cwd=library).code == 0


def test_a_broken_baseline_of_a_configuration_is_told_with_its_key(library: Path) -> None:
    (library / "usdvol-lint.toml").write_text('baseline = "fog.usda"\n', encoding="utf-8")
    ran = checked(".", cwd=library)
    assert ran.code == 2
    assert "usdvol-lint.toml: baseline" in ran.err
    assert "fog.usda:1: no JSON, as a baseline is" in ran.err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--baseline", "a", "--no-baseline"], "--baseline and --no-baseline exclude each other"),
        (["--prune-baseline"], "--prune-baseline needs a baseline: name it with --baseline FILE"),
        (
            ["--fail-on-unpruned"],
            "--fail-on-unpruned needs a baseline: name it with --baseline FILE",
        ),
        (["--moved", "a=b"], "--moved needs a baseline: name it with --baseline FILE"),
        (
            ["--baseline", "gone"],
            "gone: there is no such baseline; --write-baseline gone writes one",
        ),
        (
            ["--baseline", "fog.usda"],
            "fog.usda:1: no JSON, as a baseline is: Expecting value (column 1)",
        ),
        (["--write-baseline", "."], "--write-baseline .: this is no file, name one"),
        (["--baseline", "."], ".: no baseline: it is no file"),
        (
            ["--write-baseline", "fog.usda"],
            "--write-baseline fog.usda: the file that is there is no baseline: name another",
        ),
        (
            ["--baseline", "fog.usda", "--moved", "a"],
            "--moved a: write it as OLD=NEW, such as assets/smoke=lib/smoke",
        ),
        (
            ["--write-baseline", "b.jsonl"],
            '--write-baseline b.jsonl: there is no root that layers go by: set `root = "."` '
            "in a usdvol-lint.toml, or --root FOLDER",
        ),
    ],
)
def test_what_is_asked_for_wrongly(
    arguments: list[str], said: str, tool: Callable[..., Ran], two: Path
) -> None:
    ran = tool(*ONLY_STUDIO, *arguments, "fog.usda")
    assert ran.code == 2
    assert ran.out == ""
    assert ran.err.splitlines()[-1].removeprefix("usdvol-lint: ").lower() == (
        f"error: {said}".lower()
    )


def test_another_root(library: Path) -> None:
    checked("--write-baseline", "b.jsonl", ".", cwd=library)
    ran = checked("--root", "..", ".", cwd=library)
    assert ran.code == 2
    assert ": leave out --root, or write it anew" in ran.err
