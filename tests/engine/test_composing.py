"""How much USD composes of a layer, counted without composing all of it."""

from __future__ import annotations

from typing import Any

import pytest
from pxr import Sdf, Usd

from usdvol_lint.engine.composing import size_of
from usdvol_lint.facts.usd.nodes import nodes_of

LEAF = """
class "leaf" (
    variants = { string v = "one" }
    variantSets = "v"
)
{
    variantSet "v" = {
        "one" { def Volume "d" {
            }
        }
        "two" { def "e" {
            }
            def "f" {
            }
        }
    }
}
class "base" { def "brought" {
    }
}
class "group" (inherits = </base>)
{
    def "plain" (references = </leaf>) {
    }
    def "shared" (
        instanceable = true
        references = </leaf>
    ) {
    }
    def "other" (
        instanceable = true
        references = </leaf>
        variants = { string v = "two" }
    ) {
    }
}
def "off" (
    active = false
    references = </group>
) {
}
def "loaded" (payload = </group>) {
    over "plain" (variants = { string v = "two" }) {
    }
}
"""
"""What multiplies, and what does not: instances, what is not active, and variants."""


def doubled(levels: int) -> str:
    """Each level refers to the one below twice: two to the power of their number in all."""
    layer = 'class "l0" {\n}\n'
    for level in range(1, levels):
        two = (f'def "{name}" (references = </l{level - 1}>) {{}}\n' for name in "ab")
        layer += f'class "l{level}" {{\n{"".join(two)}}}\n'
    return layer


def layer_of(text: str) -> Any:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(f"#usda 1.0\n{text}")
    return layer


@pytest.mark.parametrize("loads", [True, False])
@pytest.mark.parametrize("is_shared", [True, False])
def test_it_is_what_usd_composes(is_shared: bool, loads: bool) -> None:
    shared = "instanceable = true\n" if is_shared else ""
    many = (f'def "n{n}" (\n{shared}references = </group>\n) {{\n}}\n' for n in range(9))
    layer = layer_of(f"{LEAF}{''.join(many)}{doubled(6)}")
    stage = Usd.Stage.Open(layer, Usd.Stage.LoadAll if loads else Usd.Stage.LoadNone)
    roots = [stage.GetPseudoRoot(), *stage.GetPrototypes()]
    there = [
        prim
        for root in roots
        for prim in Usd.PrimRange.AllPrims(root)
        if prim.GetParent() and not prim.IsPrototype()
    ]
    assert size_of(layer, None, loads).prims == len(there)


def test_so_are_the_places_that_prims_are_composed_of() -> None:
    layer = layer_of(doubled(8))
    stage = Usd.Stage.Open(layer)
    there = Usd.PrimRange.AllPrims(stage.GetPseudoRoot())
    sites = sum(len(list(nodes_of(prim.GetPrimIndex()))) for prim in there)
    assert size_of(layer, None, loads=True).sites == sites - 1  # that of the root


def test_what_multiplies_is_counted_at_once() -> None:
    found = size_of(layer_of(doubled(61)), None, loads=True)
    assert 2**60 < found.prims < 2**63
    assert found.different < 5_000


def test_it_ends_where_nobody_waits() -> None:
    answers = iter([True] * 10 + [False] * 10_000)
    found = size_of(layer_of(doubled(61)), None, True, lambda: next(answers))
    assert found.prims <= 10
