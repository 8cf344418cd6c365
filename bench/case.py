"""A case of the benchmarks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from bench.measure import Command

Make: TypeAlias = Callable[[Path, float], Path]
"""Writes a stage, or a folder of files, of a size by scale into a folder, and returns its path."""


@dataclass(frozen=True, slots=True)
class Case:
    """Our command, the floor to compare it with, and the ratio that is wanted.

    Both commands get the path of what `make` wrote, the floor that of `make_floor` if there is one.
    Without a floor, `wanted` is a figure that our command prints, in `unit`.
    `needs` names a program that must be installed.
    One that `is_big` is run only where it is named.
    """

    name: str
    ours: Command
    floor: Command | None
    wanted: float
    make: Make | None = None
    make_floor: Make | None = None
    unit: str = "s"
    needs: str | None = None
    is_big: bool = False
