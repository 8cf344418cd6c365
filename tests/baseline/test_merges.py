"""Branches that add entries to one baseline merge, as neighbours in it are strangers."""

from __future__ import annotations

import random
import shutil
import subprocess
from pathlib import Path

import pytest
from runs import cause, using, written

from usdvol_lint.baseline.entry import Entry, by_fingerprint, entry_as_json, entry_of
from usdvol_lint.baseline.file import Baseline, as_text
from usdvol_lint.baseline.values import line_of
from usdvol_lint.results import Cause

PAIRS = 100
LIBRARY = 5000

pytestmark = pytest.mark.skipif(not shutil.which("git"), reason="git merges here")


def branch(base: Baseline, entries: list[Entry]) -> str:
    return as_text(base._replace(entries=by_fingerprint([*base.entries.values(), *entries])))


def one_line(added: Cause) -> str:
    return f"{line_of(entry_as_json(entry_of(added)))}\n"


def merged(folder: Path, ours: str, base: str, theirs: str, *options: str) -> tuple[int, str]:
    """The number of conflicts, and the text."""
    for name, text in (("ours", ours), ("base", base), ("theirs", theirs)):
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
    command = ["git", "merge-file", "-p", "-q", *options, "ours", "base", "theirs"]
    done = subprocess.run(command, cwd=folder, capture_output=True, check=False)
    return done.returncode, done.stdout.decode("utf-8")


def test_most_pairs_of_branches_merge(tmp_path: Path) -> None:
    """What two branches add meets only between two entries that were there."""
    numbers = random.Random(1)
    library = [cause(f"assets/{n % 99}.usda", f"/A{n}") for n in range(LIBRARY)]
    first, *lines = written(tmp_path, *library).read_text("utf-8").splitlines(keepends=True)
    conflicts = 0
    for _ in range(PAIRS):
        ours, theirs = (
            [one_line(cause("assets/7.usda", f"/B{numbers.random()}")) for _ in range(10)]
            for _ in range(2)
        )
        texts = ["".join([first, *sorted([*lines, *more])]) for more in (ours, (), theirs)]
        found, result = merged(tmp_path, *texts)
        conflicts += bool(found)
        if not found:
            assert result == "".join([first, *sorted([*lines, *ours, *theirs])])
    assert conflicts <= PAIRS // 10


def test_the_union_of_both_sides_is_a_baseline(tmp_path: Path) -> None:
    """What `merge=union` in .gitattributes makes of a conflict: lines of both, in any order."""
    base = using(written(tmp_path, cause(prim="/A"))).baseline
    assert base
    ours = branch(base, [entry_of(cause(prim=f"/B{n}", frames=(1.0,))) for n in range(10)])
    theirs = branch(base, [entry_of(cause(prim=f"/B{n}", frames=(2.0,))) for n in range(9, 19)])
    assert merged(tmp_path, ours, as_text(base), theirs)[0]
    found, text = merged(tmp_path, ours, as_text(base), theirs, "--union")
    assert found == 0
    (tmp_path / "b.jsonl").write_text(text, encoding="utf-8", newline="\n")
    read = using(tmp_path / "b.jsonl").baseline
    assert read
    assert len(read.entries) == 20
    assert read.entries[cause(prim="/B9").fingerprint].cover.frames == (1.0, 2.0)
