"""Which files the command line and the configuration choose, and what is said of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from process import ONLY_STUDIO, Ran, run, settings, volume, write

from usdvol_lint.command import linting


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    write(tmp_path / "shots", shot=volume("smoke"), old=volume("fog"))
    write(tmp_path / "assets", smoke=volume("smoke"))
    return tmp_path


@pytest.mark.parametrize(
    ("file", "arguments", "shown"),
    [
        ("", "shots assets", "assets/smoke.usda shots/old.usda shots/shot.usda"),
        ("", ".", "assets/smoke.usda shots/old.usda shots/shot.usda"),
        ('exclude = ["old.usda"]', ".", "assets/smoke.usda shots/shot.usda"),
        ('exclude = ["old.usda"]', ". --exclude assets/", "shots/shot.usda"),
        ('exclude = ["old.usda"]', "shots --exclude !old.usda", "shots/old.usda shots/shot.usda"),
        ("", "--files-from list.txt", "assets/smoke.usda shots/old.usda"),
        (
            "",
            "shots/shot.usda --files-from list.txt",
            "assets/smoke.usda shots/old.usda shots/shot.usda",
        ),
    ],
)
def test_show_files(
    file: str, arguments: str, shown: str, tree: Path, tool: Callable[..., Ran]
) -> None:
    (tree / "usdvol-lint.toml").write_text(file, encoding="utf-8")
    names = "assets/smoke.usda\r\n\r\nshots/old.usda\r\n./assets/smoke.usda"
    (tree / "list.txt").write_text(names, encoding="utf-8")
    expected = "".join(f"{path}\n" for path in shown.split())
    assert tool("--show-files", *arguments.split()) == Ran(0, expected, "")


def test_show_files_marks_parts(tree: Path, tool: Callable[..., Ran]) -> None:
    (tree / "usdvol-lint.toml").write_text('stages = ["shots/*"]', encoding="utf-8")
    shown = "part   assets/smoke.usda\nwhole  shots/old.usda\nwhole  shots/shot.usda\n"
    assert tool("--show-files", ".") == Ran(0, shown, "")


def test_show_files_says_why_there_are_none(tree: Path, tool: Callable[..., Ran]) -> None:
    (tree / "empty.txt").touch()
    said = "usdvol-lint: nothing to check: the list of files is empty\n"
    assert tool("--show-files", "--files-from", "empty.txt") == Ran(0, "", said)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["smok.usda"], "no such file or folder: 'smok.usda'"),
        ([""], "an argument is empty"),
        (["gone/*.usda"], "'gone/*.usda' matches no stage"),
        (["--files-from", "gone.txt"], "--files-from gone.txt: No such file or directory"),
        (["--exclude", "!", "."], "--exclude: '!' is no pattern as in a .gitignore"),
        (["--search-path", "gone", "."], "--search-path gone: no such folder"),
        (["--frames", "3-1", "."], "--frames: '3-1' ends before it begins"),
        (
            ["--frames", "1..3", "."],
            "--frames: write it as FIRST-LAST, such as 1001-1100, not '1..3'",
        ),
        (["--changed-since", "-x", "."], None),
    ],
)
def test_mistakes(
    arguments: list[str], said: str | None, tree: Path, tool: Callable[..., Ran]
) -> None:
    """Each is told before a stage is looked at, so no list is shown either."""
    ran = tool("--isolated", "--show-files", *arguments)
    assert (ran.code, ran.out) == (2, "")
    assert said is None or ran.err == f"usdvol-lint: error: {said}\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("exclude = 'old'", "exclude must be a list of strings, not 'old'"),
        ("exclude = ['!']", "exclude: '!' is no pattern as in a .gitignore"),
        ("stages = ['']", "stages has an empty string, which names nothing: leave it out"),
        ("frames = 1001", "frames: write it as FIRST-LAST, such as 1001-1100, not 1001"),
        ("search-path = [3]", "search-path must be a list of strings, not [3]"),
        ("path-map = ['P:/']", "path-map must be a table, not ['P:/']"),
        ("path-map = { 'P:/' = 3 }", "path-map.P:/ must be a text, not 3"),
    ],
)
def test_mistakes_in_a_configuration(
    text: str, said: str, tree: Path, tool: Callable[..., Ran]
) -> None:
    (tree / "usdvol-lint.toml").write_text(text, encoding="utf-8")
    file = tree / "usdvol-lint.toml"
    assert tool("--show-settings") == Ran(2, "", f"usdvol-lint: error: {file}: {said}\n")


def test_a_search_path_in_a_configuration_is_there(tree: Path, tool: Callable[..., Ran]) -> None:
    file = tree / "usdvol-lint.toml"
    file.write_text("search-path = ['shots', 'nope']", encoding="utf-8")
    said = f"{file}: search-path: there is no folder {str(tree / 'nope')!r}"
    assert tool("--show-settings") == Ran(2, "", f"usdvol-lint: error: {said}\n")


def test_settings_are_relative_to_their_file(tree: Path, tool: Callable[..., Ran]) -> None:
    text = (
        'exclude = ["old/"]\nframes = "1001-1100"\nsearch-path = ["lib"]\n'
        'assume-present = ["/mnt/**"]\npath-map = { "P:/" = "share" }\n'
    )
    (tree / "usdvol-lint.toml").write_text(text, encoding="utf-8")
    (tree / "lib").mkdir()
    shown = settings(
        tool(
            "--show-settings",
            "--output-format",
            "json",
            "--frames",
            "-5-7.5",
            "--exclude",
            "*.usdz",
        )
    )
    names = ("exclude", "stages", "frames", "search_path", "assume_present", "path_map")
    assert {name: shown[name] for name in names} == {
        "exclude": ["old/", "*.usdz"],
        "stages": [],
        "frames": "-5-7.5",
        "search_path": [str(tree / "lib")],
        "assume_present": ["/mnt/**"],
        "path_map": {"P:/": str(tree / "share")},
    }


def test_nothing_to_check_is_said(tree: Path, tool: Callable[..., Ran]) -> None:
    """Also as a report for programs: a missing one would look like a failure."""
    everything = ("--isolated", "--exclude", "*", ".")
    assert tool(*everything) == Ran(0, "nothing to check: every stage is excluded\n", "")
    report = tool(*everything, "--output-format", "json").json
    assert (report["stages"], report["causes"], report["failure"]) == ([], [], None)


def test_an_absolute_argument_is_shown_as_it_was_typed(tree: Path) -> None:
    stage = tree / "shots" / "old.usda"
    for here, layer in ((tree, "shots/old.usda"), (tree / "assets", stage.as_posix())):
        ran = run(*ONLY_STUDIO, "--ignore", "STU002", stage, cwd=here)
        first, _, _, place, *_ = ran.out.splitlines()
        assert (first, place) == (stage.as_posix(), f"      --> {layer}:2:1")


def test_more_jobs_than_processors(
    tree: Path, tool: Callable[..., Ran], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(linting, "owned", lambda: 2)
    said = "usdvol-lint: 3 jobs are no faster than 2 here, where this process may use 2 processors"
    arguments = ("--isolated", "--exclude", "*", ".", "--jobs")
    assert tool(*arguments, "3").err.splitlines() == [said]
    assert tool(*arguments, "3", "--quiet").err == ""
    assert tool(*arguments, "2").err == ""
