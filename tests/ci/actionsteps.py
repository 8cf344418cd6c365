"""The shell steps of `action.yml`, run as a runner does."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from process import ROOT, environment

ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
INSTALL, CHECK = ACTION["runs"]["steps"]
_INPUT = re.compile(r"\$\{\{ inputs\.([a-z-]+) \}\}")
_SHELL = ["bash", "--noprofile", "--norc", "-e", "-o", "pipefail"]
"""As runners start `shell: bash`."""
_RECORDER = """\
import json, os, sys
told = {"arguments": sys.argv[1:], "summary": os.environ.get("GITHUB_STEP_SUMMARY")}
with open(os.environ["RECORD"], "w") as file:
    json.dump(told, file)
"""


@dataclass(frozen=True)
class Step:
    """What came of a step; `told` is what the tool, if it was a recorder, was called with."""

    code: int
    said: str
    told: Any = None


class Runner:
    """A runner's folders: a workspace, and a temporary one with the tool as it is installed."""

    def __init__(self, folder: Path) -> None:
        self.workspace = folder / "work space"
        self.temporary = folder / "runner temp"
        self.bin = self.temporary / "usdvol-lint" / "bin"
        self.record = folder / "record.json"
        for each in (self.workspace, self.bin):
            each.mkdir(parents=True)
        self.program("python", f'exec "{sys.executable}" "$@"')

    def program(self, name: str, script: str, folder: Path | None = None) -> None:
        """A shell script that stands for a program."""
        file = (folder or self.bin) / name
        file.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        file.chmod(0o755)

    def records(self, name: str, folder: Path | None = None) -> None:
        """A program that writes down what it is called with."""
        recorder = self.record.with_suffix(".py")
        recorder.write_text(_RECORDER, encoding="utf-8")
        self.program(name, f'exec "{sys.executable}" "{recorder}" "$@"', folder)

    def environment(self, step: dict[str, Any], inputs: dict[str, str]) -> dict[str, str]:
        """What a step sees: the runner's variables, and its `env` with the inputs put in."""
        given = {name: each["default"] for name, each in ACTION["inputs"].items()} | inputs
        own = {
            name: _INPUT.sub(lambda match: given[match[1]], value)
            for name, value in step["env"].items()
        }
        return environment(
            GITHUB_ACTIONS="true",
            GITHUB_ACTION_PATH=str(ROOT),
            GITHUB_WORKSPACE=str(self.workspace),
            GITHUB_STEP_SUMMARY=str(self.temporary / "summary.md"),
            RUNNER_TEMP=str(self.temporary),
            RECORD=str(self.record),
            **own,
        )

    def start(
        self, step: dict[str, Any], inputs: dict[str, str], **changes: str
    ) -> subprocess.Popen[str]:
        script = self.temporary / "step.sh"
        script.write_text(step["run"], encoding="utf-8", newline="\n")
        return subprocess.Popen(
            [*_SHELL, str(script)],
            cwd=self.workspace,
            env=self.environment(step, inputs) | changes,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
        )

    def run(self, step: dict[str, Any], inputs: dict[str, str], **changes: str) -> Step:
        process = self.start(step, inputs, **changes)
        said, _ = process.communicate(timeout=300)
        told = json.loads(self.record.read_text()) if self.record.exists() else None
        return Step(process.returncode, said, told)


def path_with(folder: Path) -> str:
    """A search path on which a folder comes first."""
    return os.pathsep.join([str(folder), os.environ["PATH"]])
