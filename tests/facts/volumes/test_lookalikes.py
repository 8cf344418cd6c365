"""Prims that would be Volumes but for their type: what the pages can't show."""

from __future__ import annotations

from pathlib import Path

import pytest
from pxr import Usd

from usdvol_lint.engine.walk import asked_by, walk
from usdvol_lint.facts import Context, Facts
from usdvol_lint.facts.usd.kinds import PrimKinds

TEXT = """#usda 1.0
def "smoke" {
    rel field:density = </smoke/density>
    def OpenVDBAsset "density" {
    }
}
def "fire" {
    rel field:heat = </fields/heat>
}
def "fields" {
    def OpenVDBAsset "heat" {
    }
}
"""


def lookalikes(folder: Path) -> list[str]:
    path = folder / "stage.usda"
    path.write_text(TEXT, encoding="utf-8")
    stage = Usd.Stage.Open(str(path))
    facts = Facts(Context.of(stage), walk(stage, asked_by([]), PrimKinds()))
    return [str(each.prim.GetPath()) for each in facts.volumes.lookalikes]


def test_a_prim_above_its_field_is_found_wherever_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert lookalikes(tmp_path) == ["/fire", "/smoke"]
    monkeypatch.setattr("usdvol_lint.engine.walk._GROUPS", 0)
    assert lookalikes(tmp_path) == ["/smoke"]
