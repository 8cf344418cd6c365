"""What a case is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from bench.measure import Command

Make: TypeAlias = Callable[[Path, float], Path]
"""Writes a stage, or a folder of files, into a folder, at a scale, and returns it."""


@dataclass(frozen=True, slots=True)
class Case:
    """A command of ours, what it is held against, and how much longer it may take.

    Both commands get the path of what `make` wrote, the floor that of `make_floor` if it differs.
    Without a floor, `wanted` is not a ratio but a figure that ours prints, in `unit`.
    `needs` names a program that must be installed.
    """

    name: str
    ours: Command
    floor: Command | None
    wanted: float
    make: Make | None = None
    make_floor: Make | None = None
    unit: str = "s"
    needs: str | None = None
