"""What is completed at one place, or under one selection, is not so at another."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from partlayers import BOUND, FILE, NAME, ROOT_PRIM, field, layer, over, told, volume, write

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.run.parts import completed_by

Tell = Callable[..., list[str]]


@pytest.fixture
def tell(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Tell:
    """As `judge`, under all selections."""
    monkeypatch.chdir(tmp_path)

    def call(**layers: str) -> list[str]:
        write(tmp_path, layers)
        engine = Engine(catalog.rules, activate(Config(), catalog), Depth(selections=9))
        stages = [engine.lint(f"{name}.usda") for name in sorted(layers)]
        return told(stages, completed_by(stages))

    return call


TWO_OF_A_CLASS = layer(
    over(
        "_kind",
        volume(BOUND.replace("<density>", "</_kind/smoke/density>") + field(NAME)),
        what="class",
    )
    + over("one", "", "(inherits = </_kind>)", "def Xform")
    + over("two", "", "(inherits = </_kind>)", "def Xform"),
)


def shot(*fields: str) -> str:
    """A shot that brings the files of fields below these prims."""
    inside = "".join(over(each, over("smoke", over("density", FILE))) for each in fields)
    return layer(inside, "subLayers = [@./asset.usda@]")


def test_of_two_prims_of_a_class_each_has_to_be_completed(tell: Tell) -> None:
    assert tell(asset=TWO_OF_A_CLASS, shot=shot("one")) == [
        "asset AST001 error",
        "shot AST001 error",
    ]
    assert tell(asset=TWO_OF_A_CLASS, shot=shot("one", "two")) == []
    assert tell(asset=TWO_OF_A_CLASS, shot=shot("_kind")) == []


CHOICE = layer(
    volume(
        BOUND
        + 'variantSet "look" = {\n"thick" {\n'
        + field(f"{NAME}\n{FILE}")
        + '}\n"thin" {\n'
        + field(NAME)
        + '}\n"none" {\n}\n}\n',
        meta='(variants = { string look = "thick" }\nprepend variantSets = "look")',
    ),
    ROOT_PRIM,
)


def choosing(look: str, inside: str = "") -> str:
    meta = f'(references = @./asset.usda@\nvariants = {{ string look = "{look}" }})'
    return layer(over("smoke", inside, meta, "def"))


def test_what_a_selection_lacks_only_the_same_selection_completes(tell: Tell) -> None:
    lacking = ["asset VOL001 error", "asset AST001 error"]
    assert tell(asset=CHOICE) == lacking
    thick = tell(asset=CHOICE, shot=choosing("thick"))
    assert [each for each in thick if each.startswith("asset")] == lacking
    thin = tell(asset=CHOICE, shot=choosing("thin", over("density", FILE)))
    assert [each for each in thin if each.startswith("asset")] == ["asset VOL001 error"]
    own = field(f"{NAME}\n{FILE}")
    both = tell(
        asset=CHOICE,
        none=choosing("none", own),
        shot=choosing("thin", over("density", FILE)),
    )
    assert [each for each in both if each.startswith("asset")] == []
