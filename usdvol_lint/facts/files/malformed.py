"""Paths that are not written so that every platform reads them alike."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import NamedTuple

from pxr import Ar

from usdvol_lint.facts.files.assets import Affected, AssetSample, AssetSamples
from usdvol_lint.facts.files.states import AssetState, PathDefect

_SUSPECT = re.compile(r"[A-Za-z]:|~|\s|[^\\]*+(?:\\|(?<=\s)\Z)")
_HOME = re.compile(r"~[^/\\]*[/\\]")
_ROOT = re.compile(r"[A-Za-z]:|\\\\")
_READ_ON_WINDOWS = frozenset({PathDefect.DRIVE, PathDefect.BACKSLASHES})


class Malformed(NamedTuple):
    """Samples with malformed paths; `defects` are those of the first.

    `is_cause`: whether nothing is found because of them.
    `corrected`: the first path with `/` between names and no blank at its ends; None where it
    begins with what no other platform has.
    `leads_to_file`: whether there is a file at `corrected`.
    """

    affected: Affected
    defects: tuple[PathDefect, ...]
    is_cause: bool
    corrected: str | None
    leads_to_file: bool


def malformed(paths: AssetSamples) -> Iterator[Malformed]:
    """The samples with malformed paths: those where nothing is found for it, and the others."""
    suspect = paths.matching(_SUSPECT)
    found = [sample for sample in suspect.samples if any(_defects(sample))] if suspect else []
    for is_cause in (True, False):
        affected = paths.affected(sample for sample in found if hides_file(sample) is is_cause)
        if affected:
            first = affected.first
            corrected = _corrected(first.path)
            meant = first._replace(path=corrected or "")
            leads_to_file = bool(corrected) and _is_there(paths.anchored(meant))
            yield Malformed(affected, tuple(_defects(first)), is_cause, corrected, leads_to_file)


def hides_file(sample: AssetSample) -> bool:
    """Whether nothing is found because the path is malformed."""
    is_readable = _READ_ON_WINDOWS if os.sep == "\\" else frozenset[PathDefect]()
    return sample.state is AssetState.MISSING and bool(set(_defects(sample)) - is_readable)


def _defects(sample: AssetSample) -> Iterator[PathDefect]:
    path = sample.path
    if sample.is_arranged:
        return
    if path[1:2] == ":" and path[0].isalpha():
        yield PathDefect.DRIVE
    if _HOME.match(path) and not sample.is_there:  # a file may well be called so
        yield PathDefect.HOME
    if "\\" in path:
        yield PathDefect.BACKSLASHES
    if path != path.strip():
        yield PathDefect.BLANK


def _corrected(path: str) -> str | None:
    if _ROOT.match(path) or _HOME.match(path):
        return None
    return re.sub(r"\\+", "/", path.strip())


def _is_there(path: str) -> bool:
    return bool(Ar.GetResolver().Resolve(path))
