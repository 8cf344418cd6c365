"""Times pairs of commands as whole processes, or reads the figures that they print."""

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
    """A command ended with another exit code than expected, so its time means nothing."""


@dataclass(frozen=True, slots=True)
class Command:
    """A program with its arguments, and the exit code it must end with.

    It is measured from start to exit, unless it `prints` a figure, which is taken instead.
    """

    words: tuple[str, ...]
    exit_code: int = 0
    prints: bool = False


def python(code: str, prints: bool = False) -> Command:
    """A Python process that runs `code`; the path of the stage is `sys.argv[1]`."""
    return Command((sys.executable, "-c", code), prints=prints)


def linter(*arguments: str, exit_code: int = 0) -> Command:
    """The linter as users run it: the installed script, or the module if there is none."""
    script = Path(sys.executable).with_name("usdvol-lint")
    program = (str(script),) if script.exists() else (sys.executable, "-m", "usdvol_lint")
    return Command((*program, *arguments), exit_code)


def gauged(gauge: str, command: Command) -> Command:
    """The command run by a gauge of `bench.gauges`, whose figure is taken instead of the time."""
    words = (sys.executable, "-m", "bench.gauges", gauge, *command.words)
    return replace(command, words=words, prints=True)


@dataclass(frozen=True, slots=True)
class Pairs:
    """The figures of two commands that ran in turn; `floor` is empty if a case has none."""

    floor: tuple[float, ...]
    ours: tuple[float, ...]

    @property
    def ratio(self) -> float:
        """The median over the pairs: a slow moment of the machine affects both runs of a pair."""
        return median(ours / floor for floor, ours in zip(self.floor, self.ours, strict=True))


def measure(
    floor: tuple[Command, Sequence[str]] | None,
    ours: tuple[Command, Sequence[str]],
    runs: int,
    cache: Path,
) -> Pairs:
    """Runs both commands in turn `runs` times, after one run of each to fill the caches.

    `cache` is the folder for compiled modules; raises UnexpectedExitError.
    """
    environment = _environment(cache)
    sides: tuple[list[float], list[float]] = [], []
    for _ in range(runs + 1):
        for side, run in zip(sides, (floor, ours), strict=True):
            if run:
                side.append(_figure(*run, environment))
    return Pairs(tuple(sides[0][1:]), tuple(sides[1][1:]))


def _environment(cache: Path) -> Mapping[str, str]:
    """The environment of an installed package, whose modules are compiled."""
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
