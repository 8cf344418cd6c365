"""Instances of one prototype that ignore the same, something else, or nothing."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from stagetexts import (
    ASSET,
    DEFAULT,
    GONE,
    INSTANCE,
    field,
    inherited,
    messages,
    on_layer,
    on_prim,
    prim,
    smoke,
)

from usdvol_lint.engine import shares
from usdvol_lint.model import Finding

Lint = Callable[..., tuple[Finding, ...]]


def test_an_instance_takes_away_its_own_place_alone(lint: Lint) -> None:
    shot = "".join(
        prim(name, INSTANCE, *([on_prim(AST002=why)] if why else []))
        for name, why in [("A", "one"), ("B", ""), ("C", "one"), ("D", "other"), ("E", "")]
    )
    assert messages(lint({"shot.usda": shot, "asset.usda": ASSET})) == [
        ("/A/density", "one", f"{GONE} (shown by 2 instances)"),
        ("/B/density", None, f"{GONE} (shown by 2 instances)"),
        ("/D/density", "other", GONE),
    ]


def test_a_prim_above_instances_and_one_in_the_prototype(lint: Lint) -> None:
    both = prim("A", INSTANCE) + prim("B", INSTANCE)
    shot = prim("World", on_prim(AST002="shot"), inside=both) + prim("C", INSTANCE)
    assert messages(lint({"shot.usda": shot, "asset.usda": ASSET})) == [
        ("/C/density", None, GONE),
        ("/World/A/density", "shot", f"{GONE} (shown by 2 instances)"),
    ]
    asset = f"({DEFAULT})\n{smoke(inside=field(on_prim(AST002='asset')))}"
    assert messages(lint({"shot.usda": shot, "asset.usda": asset})) == [
        ("/C/density", "asset", f"{GONE} (shown by 3 instances)"),
    ]


def test_instances_in_instances(lint: Lint) -> None:
    inner = ASSET
    outer = '(defaultPrim = "Rig")\n' + prim(
        "Rig", inside=prim("L", INSTANCE, on_prim(AST002="left")) + prim("R", INSTANCE)
    )
    rig = "references = @./rig.usda@\ninstanceable = true"
    shot = prim("A", rig) + prim("B", rig, on_prim(AST002="b")) + prim("C", rig)
    assert messages(lint({"shot.usda": shot, "rig.usda": outer, "asset.usda": inner})) == [
        ("/A/L/density", "left", f"{GONE} (shown by 3 instances)"),
        ("/A/R/density", None, f"{GONE} (shown by 2 instances)"),
        ("/B/R/density", "b", GONE),
    ]


def test_an_instance_takes_back_what_the_asset_ignores(lint: Lint) -> None:
    asset = f"({DEFAULT})\n{smoke(on_prim(AST002='asset'))}"
    shot = prim("A", INSTANCE, on_prim(AST002="")) + prim("B", INSTANCE)
    assert messages(lint({"shot.usda": shot, "asset.usda": asset})) == [
        ("/A/density", None, GONE),
        ("/B/density", "asset", GONE),
    ]


def test_a_prim_in_a_prototype_takes_back_what_instances_ignore(lint: Lint) -> None:
    asset = f"({DEFAULT})\n{smoke(inside=field(on_prim(AST002='')))}"
    shot = prim("A", INSTANCE, on_prim(AST002="a")) + prim("B", INSTANCE)
    assert messages(lint({"shot.usda": shot, "asset.usda": asset})) == [
        ("/A/density", None, f"{GONE} (shown by 2 instances)"),
    ]


def test_a_prim_in_a_prototype_is_nearer_than_an_instance(lint: Lint) -> None:
    asset = f"({DEFAULT})\n{smoke(inside=field(on_prim(AST002='asset')))}"
    shot = prim("A", INSTANCE, on_prim(AST002="a")) + prim("B", INSTANCE)
    layers = {"shot.usda": shot, "asset.usda": asset}
    together = [("/A/density", "asset", f"{GONE} (shown by 2 instances)")]
    apart = [("/A/density", "asset", GONE), ("/B/density", "asset", GONE)]
    assert messages(lint(layers)) == together
    assert messages(lint(layers, prims=(("/A",),))) == apart


def test_what_is_taken_back_in_a_prototype_no_layer_ignores(lint: Lint) -> None:
    text = on_layer(AST002="layer") + inherited(field(on_prim(AST002="")) + field(name="e"))
    assert messages(lint({"stage.usda": text})) == [
        ("/A/density", None, f"{GONE} (shown by 2 instances)"),
        ("/A/e", "layer", f"{GONE} (shown by 2 instances)"),
    ]


def test_very_many_instances_are_not_told_apart_by_patterns(
    lint: Lint, monkeypatch: pytest.MonkeyPatch
) -> None:
    layers = {"shot.usda": prim("A", INSTANCE) + prim("B", INSTANCE), "asset.usda": ASSET}
    monkeypatch.setattr(shares, "_MOST_PATHS", 2)
    assert len(lint(layers, prims=(("/A",),))) == 2
    monkeypatch.setattr(shares, "_MOST_PATHS", 1)
    assert len(lint(layers, prims=(("/A",),))) == 1


def test_instances_are_told_apart_by_patterns_of_a_configuration(lint: Lint) -> None:
    shot = "".join(prim(name, INSTANCE) for name in "ABC")
    layers = {"shot.usda": shot, "asset.usda": ASSET}
    assert messages(lint(layers, prims=(("/B/**", "/C/**"),))) == [
        ("/A/density", None, GONE),
        ("/B/density", None, f"{GONE} (shown by 2 instances)"),
    ]
    assert messages(lint(layers, prims=(("/**",),))) == [
        ("/A/density", None, f"{GONE} (shown by 3 instances)")
    ]
