"""Times pairs of commands as whole processes, or takes the figures that they print."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

ROOT = Path(__file__).parent.parent


class UnexpectedExitError(Exception):
    """A command that did not do what was to be timed."""


@dataclass(frozen=True, slots=True)
class Command:
    """A program with its arguments, and the exit code it must end with.

    What counts is its time from start to exit or, if it `prints` a figure, that.
    """

    words: tuple[str, ...]
    exit_code: int = 0
    prints: bool = False


def python(code: str, prints: bool = False) -> Command:
    """A Python process that runs `code`, which finds the stage in `sys.argv[1]`."""
    return Command((sys.executable, "-c", code), prints=prints)


def linter(*arguments: str, exit_code: int = 0) -> Command:
    """The linter as users run it: the installed script, or else the module."""
    script = Path(sys.executable).with_name("usdvol-lint")
    program = (str(script),) if script.exists() else (sys.executable, "-m", "usdvol_lint")
    return Command((*program, *arguments), exit_code)


def gauged(gauge: str, command: Command) -> Command:
    """The command under a gauge of `bench.gauges`, whose figure counts instead of the time."""
    words = (sys.executable, "-m", "bench.gauges", gauge, *command.words)
    return replace(command, words=words, prints=True)


@dataclass(frozen=True, slots=True)
class Pairs:
    """What two commands took in turn; nothing, for the one that a case leaves out."""

    floor: tuple[float, ...]
    ours: tuple[float, ...]

    @property
    def ratio(self) -> float:
        """The median over the pairs: a slow moment of the machine touches both of a pair."""
        return median(ours / floor for floor, ours in zip(self.floor, self.ours, strict=True))


def measure(
    floor: tuple[Command, Sequence[str]] | None,
    ours: tuple[Command, Sequence[str]],
    runs: int,
    cache: Path,
) -> Pairs:
    """Runs both commands in turn, after a run of each that warms the caches."""
    environment = _environment(cache)
    sides: tuple[list[float], list[float]] = [], []
    for _ in range(runs + 1):
        for side, run in zip(sides, (floor, ours), strict=True):
            if run:
                side.append(_figure(*run, environment))
    return Pairs(tuple(sides[0][1:]), tuple(sides[1][1:]))


def _environment(cache: Path) -> Mapping[str, str]:
    """As after an installation, which leaves compiled modules."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    path = {"PYTHONPATH": os.environ["PYTHONPATH"]} if "PYTHONPATH" in os.environ else {}
    return {**kept, **path, "PYTHONPYCACHEPREFIX": str(cache)}


def _figure(command: Command, arguments: Sequence[str], environment: Mapping[str, str]) -> float:
    words = [*command.words, *arguments]
    began = time.perf_counter()
    done = subprocess.run(
        words,
        cwd=ROOT,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE if command.prints else subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=False,
    )
    seconds = time.perf_counter() - began
    if done.returncode != command.exit_code:
        raise UnexpectedExitError(f"exit code {done.returncode}, not {command.exit_code}: {words}")
    return float(done.stdout) if command.prints else seconds
