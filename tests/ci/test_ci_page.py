"""docs/ci.md: its commands in their order, in the repository of somebody who begins."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from actionsteps import path_with
from process import ROOT, environment

from usdvol_lint.command.cli import command

PAGE = ROOT / "docs" / "ci.md"
BLOCK = re.compile(r"^( *)```(sh|toml|text)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
FAILS = "  # exits with 1"
KNOWN = {name for parameter in command.params for name in parameter.opts}
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")

pytestmark = pytest.mark.skipif(
    os.name == "nt" or shutil.which("bash") is None or shutil.which("git") is None,
    reason="needs a bash of its own, and git",
)


class Beginner:
    """Who types what the page says, and compares what it shows."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.said = ""
        self.pending: list[str] = []
        tool = folder / ".bin" / "usdvol-lint"
        tool.parent.mkdir()
        tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -P -m usdvol_lint "$@"\n')
        tool.chmod(0o755)
        names = {f"GIT_{who}_{what}": "a@b.c" for who in ("AUTHOR", "COMMITTER")
                 for what in ("NAME", "EMAIL")}  # fmt: skip
        self._env = environment(
            PATH=path_with(tool.parent),
            GIT_CONFIG_GLOBAL=os.devnull,
            GIT_CONFIG_NOSYSTEM="1",
            **names,
        )

    def type(self, line: str) -> None:
        if line.startswith("pip "):
            return
        if line.startswith("usdvol-lint") and set(OPTION.findall(line)) - KNOWN:
            self.pending.append(line)
            return
        done = subprocess.run(
            ["bash", "-c", line],
            cwd=self.folder,
            env=self._env,
            capture_output=True,
            text=True,
            encoding="utf-8",
            check=False,
        )
        assert done.returncode == int(line.endswith(FAILS)), f"{line}\n{done.stdout}{done.stderr}"
        self.said = done.stdout

    def follow(self, language: str, text: str) -> None:
        if language == "sh":
            for line in text.splitlines():
                self.type(line)
        elif language == "text":
            for piece in re.split(r"^…\n|…$", text, flags=re.MULTILINE):
                assert piece.strip("\n") in self.said
        elif "[[suppress]]" in text:
            with (self.folder / "usdvol-lint.toml").open("a", encoding="utf-8") as file:
                file.write(text)
        elif "ignore" in text:
            (self.folder / "usdvol-lint.toml").write_text(text, encoding="utf-8")


def test_the_page(tmp_path: Path) -> None:
    shutil.copytree(ROOT / "docs" / "examples" / "broken", tmp_path / "shots")
    beginner = Beginner(tmp_path)
    for line in ("git init --quiet", "git add shots", "git commit --quiet --message begun"):
        beginner.type(line)
    for indent, language, text in BLOCK.findall(PAGE.read_text(encoding="utf-8")):
        beginner.follow(language, re.sub(f"^{indent}", "", text, flags=re.MULTILINE))
    assert (tmp_path / "usdvol-lint.json").stat().st_size > 0
    if beginner.pending:
        pytest.skip(f"not there yet: {'; '.join(beginner.pending)}")
