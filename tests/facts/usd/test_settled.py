"""Values that hang on one another, what is below instances, and where forwarding ends."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

import pytest
from pxr import Sdf, Usd

from usdvol_lint.facts.usd import forwarding
from usdvol_lint.facts.usd.below import each_below
from usdvol_lint.facts.usd.forwarding import Forwarding
from usdvol_lint.facts.usd.settled import settle

LONG = 20_000


def test_a_long_chain_is_found_once() -> None:
    asked: list[int] = []
    known: dict[int, int] = {}

    def find(number: int) -> Generator[int, None, int]:
        asked.append(number)
        for needed in (number - 1, number - 2):
            if number and needed >= 0 and needed not in known:
                yield needed
        return known.get(number - 1, 0) + 1

    assert settle(LONG, find, known) == LONG + 1
    assert settle(LONG, find, known) == LONG + 1
    assert sorted(asked) == list(range(LONG + 1))


def test_what_is_in_a_prototype_is_met_once() -> None:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    inner = 'def "{0}" (\ninstanceable = true\nreferences = <{1}>\n)\n{{\n}}\n'
    layer.ImportFromString(
        '#usda 1.0\nclass "one"\n{\ndef "leaf"\n{\n}\n}\nclass "two"\n{\n'
        + inner.format("x", "/one")
        + inner.format("y", "/one")
        + '}\ndef "w"\n{\n'
        + inner.format("a", "/two")
        + inner.format("b", "/two")
        + "}\n"
    )
    stage = Usd.Stage.Open(layer)
    below = [str(prim.GetPath()) for prim in each_below(stage.GetPrimAtPath("/w"))]
    assert below == ["/w", "/w/a", "/w/a/x", "/w/a/x/leaf", "/w/a/y", "/w/b"]


@pytest.mark.parametrize(
    "text",
    [
        "rel a = </w.b>\nrel b = </w.c>\nrel c = </w/x>",
        "rel a = </w.b>\nrel b = [</w/x>, </w.c>]\nrel c = [</w/y>, </w/x>]",
        "rel a = </w.b>\nrel b = </w.a>\nrel c = </w.c>",
        "rel a = </w.b>\nrel b = </w.c>\nrel c = [</w.b>, </w/x>]",
        "rel a = </w.b>\nrel b = </w.size>\nrel c = </w.none>\nfloat size",
        "rel a\nrel b = </w.a>\nrel c = [</w.a>, </w.b>, </w/x>]",
    ],
)
@pytest.mark.parametrize("order", ["abc", "cba"])
def test_forwarding_ends_where_usd_says(text: str, order: str) -> None:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(f'#usda 1.0\ndef "w"\n{{\n{text}\n}}\n')
    stage = Usd.Stage.Open(layer)
    followed = Forwarding()
    for name in order:
        relationship = stage.GetRelationshipAtPath(f"/w.{name}")
        assert followed.targets(relationship) == relationship.GetForwardedTargets()


def test_what_a_ring_forwards_to_is_asked_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    get_targets = forwarding.get_targets
    monkeypatch.setattr(
        forwarding, "get_targets", lambda end: asked.append(end) or get_targets(end)
    )
    layer = Sdf.Layer.CreateAnonymous(".usda")
    links = "\n".join(f"rel n{number} = </w.n{(number + 1) % 9}>" for number in range(9))
    layer.ImportFromString(f'#usda 1.0\ndef "w"\n{{\n{links}\n}}\n')
    stage = Usd.Stage.Open(layer)
    followed = Forwarding()
    for number in range(9):
        assert followed.targets(stage.GetRelationshipAtPath(f"/w.n{number}")) == []
    assert len(asked) == 1
