"""The lists of applied APIs that USD drops, where layers say different things of one prim."""

from __future__ import annotations

from pathlib import Path

import pytest
from pxr import Usd

from usdvol_lint.facts.usd.dropped import dropped_lists
from usdvol_lint.layertext.source import LayerTexts

TWICE = 'prepend apiSchemas = ["A", "B", "A"]'


@pytest.mark.parametrize(
    ("strong", "weak", "dropped"),
    [
        ("", TWICE, [("weak", ("A", "B"))]),
        (TWICE, "", [("strong", ("A", "B"))]),
        (TWICE, 'append apiSchemas = ["C", "C"]', [("strong", ("A", "B")), ("weak", ("C",))]),
        ('apiSchemas = ["A"]', TWICE, []),
        ('delete apiSchemas = ["A", "B"]', TWICE, []),
        ('delete apiSchemas = ["A"]', TWICE, [("weak", ("A", "B"))]),
        (TWICE, 'delete apiSchemas = ["A", "B"]', [("strong", ("A", "B"))]),
        ('append apiSchemas = ["A", "B"]', TWICE, []),
        ('delete apiSchemas = ["A", "A"]', 'prepend apiSchemas = ["A"]', []),
        ('reorder apiSchemas = ["A", "A"]', "", []),
    ],
)
def test_lists_that_would_bring_something(
    strong: str, weak: str, dropped: list[tuple[str, tuple[str, ...]]], tmp_path: Path
) -> None:
    head = "#usda 1.0\n(\n    subLayers = [@weak.usda@]\n)\n"
    write(tmp_path / "strong.usda", head, strong)
    write(tmp_path / "weak.usda", "#usda 1.0\n", weak)
    stage = Usd.Stage.Open(str(tmp_path / "strong.usda"))
    found = dropped_lists(stage.GetPrimAtPath("/prim"), (), LayerTexts())
    assert [(Path(one.spec.layer.realPath).stem, one.names) for one in found] == dropped


def test_what_is_built_in_is_not_lost(tmp_path: Path) -> None:
    write(tmp_path / "one.usda", "#usda 1.0\n", TWICE)
    stage = Usd.Stage.Open(str(tmp_path / "one.usda"))
    assert dropped_lists(stage.GetPrimAtPath("/prim"), ("A", "B"), LayerTexts()) == ()


def test_a_text_in_memory_is_not_known() -> None:
    stage = Usd.Stage.CreateInMemory()
    assert dropped_lists(stage.DefinePrim("/prim"), (), LayerTexts()) == ()


def write(path: Path, head: str, metadata: str) -> None:
    path.write_text(f'{head}def "prim" (\n    {metadata}\n)\n{{\n}}\n', encoding="utf-8")
