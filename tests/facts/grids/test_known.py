"""What is known of contents and claims from one stage to the next, and when it is forgotten."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import vdbwriter as w
from gridtexts import DENSITY, density, field, grid, stage
from pxr import Usd

import usdvol_lint.facts.grids.known as known_module
from usdvol_lint.engine.walk import asked_by, walk
from usdvol_lint.facts import Context, Facts
from usdvol_lint.facts.grids.known import KnownContents
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.volumefile import Grid
from usdvol_lint.volumefile.cache import VolumeFiles

SAME = stage(
    field("density", *DENSITY),
    field("smoke", 'token fieldName.timeSamples = { 1: "density" }', *DENSITY[1:]),
)
"""Two fields that claim the same at frame 1, each in a way of its own."""


def facts_of(known: KnownContents, file: Path, text: str) -> tuple[Facts, list[Any]]:
    """The facts of a new stage, and its fields."""
    file.write_text(text, encoding="utf-8")
    opened = Usd.Stage.Open(str(file))
    known.begin()
    facts = Facts(Context.of(opened, known=known), walk(opened, asked_by([]), PrimKinds()))
    return facts, opened.GetPrimAtPath("/cloud").GetChildren()


def claims(known: KnownContents, file: Path) -> list[Any]:
    facts, fields = facts_of(known, file, SAME)
    return [facts.grids.claims(each).at(1.0) for each in fields]


def grids_of(known: KnownContents, file: Path) -> set[str]:
    """The grids in the one file of a stage, which lies beside it."""
    facts, [only] = facts_of(known, file, stage(density(f"./{file.stem}.vdb")))
    [(content_class, _)] = facts.grids.contents(only).timeline.classes
    return set(content_class.content.grid_names)


def test_equal_claims_are_one_on_all_stages(tmp_path: Path) -> None:
    known = KnownContents()
    [one] = {each for name in "ab" for each in claims(known, tmp_path / f"{name}.usda")}
    assert one.name == "density"


def test_too_many_are_forgotten_between_two_stages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And within one, equal claims are the same also where there are too many."""
    monkeypatch.setattr(known_module, "_MOST", 1)
    known = KnownContents()
    [first] = set(claims(known, tmp_path / "a.usda"))
    kept = len(known.claims)
    [second] = set(claims(known, tmp_path / "b.usda"))
    assert first is not second
    assert len(known.claims) == kept > 1


def test_too_much_is_forgotten_between_two_stages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What was in one file is not taken for what is in the next."""
    for name in ("a", "b"):
        (tmp_path / f"{name}.vdb").write_bytes(w.vdb(grid(name)))
    for most, kept in ((1 << 20, 2), (0, 1)):
        monkeypatch.setattr(known_module, "_MOST_BYTES", most)
        known = KnownContents()
        assert grids_of(known, tmp_path / "a.usda") == {"a"}
        size = known.files.size
        assert grids_of(known, tmp_path / "b.usda") == {"b"}
        assert (known.files.size, len(known.classes)) == (kept * size, kept)


def test_the_size_of_readings_is_known(tmp_path: Path) -> None:
    """That of names too, which may be as long as the file is."""
    files = VolumeFiles()
    sizes = []
    for names in (["a"], ["a", "b"], ["n" * 60_000]):
        path = tmp_path / f"{len(sizes)}.vdb"
        path.write_bytes(w.vdb(*map(grid, names)))
        before = files.size
        assert files.read(str(path)).file
        sizes.append(files.size - before)
        assert files.read(str(path)).file
        assert files.size == before + sizes[-1]
    assert sizes[0] < sizes[1] < 5_000 < 60_000 < sizes[2]
    files.forget()
    assert files.size == 0


def test_too_many_boxes_are_forgotten_between_two_stages(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are of grids, which they keep alive."""
    known = KnownContents()
    known.boxes[1, None] = Grid("density", "density", "float", "Tree_float_5_4_3"), None
    known.begin()
    assert known.boxes
    monkeypatch.setattr(known_module, "_MOST", 0)
    known.begin()
    assert not known.boxes
