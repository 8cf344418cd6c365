"""Times pairs of commands as whole processes, by the clock on the wall."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median

ROOT = Path(__file__).parent.parent


class UnexpectedExit(Exception):
    """A command that did not do what was to be timed."""


@dataclass(frozen=True, slots=True)
class Command:
    """A program with its arguments, and the exit code it must end with."""

    words: tuple[str, ...]
    exit_code: int = 0


def python(code: str) -> Command:
    """A Python process that runs `code`, which finds the stage in `sys.argv[1]`."""
    return Command((sys.executable, "-c", code))


def linter(*arguments: str, exit_code: int = 0) -> Command:
    """The linter as users run it: the installed script, or else the module."""
    script = Path(sys.executable).with_name("usdvol-lint")
    program = (str(script),) if script.exists() else (sys.executable, "-m", "usdvol_lint")
    return Command((*program, *arguments), exit_code)


@dataclass(frozen=True, slots=True)
class Pairs:
    """Seconds that two commands took in turn."""

    floor: tuple[float, ...]
    ours: tuple[float, ...]

    @property
    def ratio(self) -> float:
        """The median over the pairs: a slow moment of the machine touches both of a pair."""
        return median(ours / floor for floor, ours in zip(self.floor, self.ours, strict=True))


def measure(floor: Command, ours: Command, arguments: list[str], runs: int, cache: Path) -> Pairs:
    """Runs both commands in turn, after a run of each that warms the caches."""
    environment = _environment(cache)
    pairs = []
    for number in range(runs + 1):
        pair = (_seconds(floor, arguments, environment), _seconds(ours, arguments, environment))
        if number:
            pairs.append(pair)
    return Pairs(tuple(pair[0] for pair in pairs), tuple(pair[1] for pair in pairs))


def _environment(cache: Path) -> Mapping[str, str]:
    """As after an installation, which leaves compiled modules."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    path = {"PYTHONPATH": os.environ["PYTHONPATH"]} if "PYTHONPATH" in os.environ else {}
    return {**kept, **path, "PYTHONPYCACHEPREFIX": str(cache)}


def _seconds(command: Command, arguments: list[str], environment: Mapping[str, str]) -> float:
    words = [*command.words, *arguments]
    began = time.perf_counter()
    done = subprocess.run(
        words,
        cwd=ROOT,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=False,
    )
    seconds = time.perf_counter() - began
    if done.returncode != command.exit_code:
        raise UnexpectedExit(f"exit code {done.returncode}, not {command.exit_code}: {words}")
    return seconds
