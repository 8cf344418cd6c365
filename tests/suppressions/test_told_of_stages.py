"""What a stage ignores wrongly, no longer or for nothing is told, once and where it stands."""

from __future__ import annotations

from collections.abc import Callable

from stagetexts import (
    ASSET,
    DEFAULT,
    INSTANCE,
    REFERENCE,
    field,
    found,
    inherited,
    messages,
    on_layer,
    on_prim,
    prim,
    smoke,
    told,
)

from usdvol_lint.model import Finding

Lint = Callable[..., tuple[Finding, ...]]


def test_what_is_wrong_is_blamed_on_the_spec_that_holds_it(lint: Lint) -> None:
    asset = f"({DEFAULT})\n{smoke(on_prim(AST002=3))}"
    layers = {"shot.usda": prim("A", REFERENCE) + prim("B", REFERENCE), "asset.usda": asset}
    wrong = [each for each in lint(layers) if each.code == "LNT003"]
    assert [each.site.prim for each in wrong] == ["/A", "/B"]
    assert {each.site.layer for each in wrong} == {"asset.usda"}
    assert {each.source._replace(layer=None) for each in wrong} == {
        wrong[0].source._replace(layer=None, path="/Smoke", property=None, subject="AST002")
    }


def test_what_nobody_asks_is_not_told(lint: Lint) -> None:
    """A healthy prim may hold nonsense: it is looked at with `--show unused` alone."""
    text = prim("Healthy", on_prim(AST002=3, NOPE="x")) + field()
    assert told(lint({"stage.usda": text})) == []
    assert told(lint({"stage.usda": text}, unused=True)) == [
        "the reason why AST002 is ignored is a number, not a text",
        "there is no rule 'NOPE' to ignore",
    ]


def test_what_is_wrong_is_told_once(lint: Lint) -> None:
    """Two findings below it, and other selections, ask the same prim."""
    variants = f'variantSet "look" = {{\n"a" {{\n{field()}}}\n"b" {{\n{field()}}}\n}}\n'
    chosen = 'variants = { string look = "a" }\nprepend variantSets = ["look"]'
    inside = variants + field(name="more")
    text = prim("A", on_prim(NOPE="x"), chosen, inside=inside)
    assert told(lint({"stage.usda": text}, selections=9)) == ["there is no rule 'NOPE' to ignore"]


def test_it_can_be_ignored_itself(lint: Lint) -> None:
    text = field(on_prim(NOPE="x", LNT003="a pack that is not here has it"))
    assert found(lint({"stage.usda": text})) == [
        ("LNT003", "/density", "a pack that is not here has it"),
        ("AST002", "/density", None),
    ]


def test_who_trusts_no_stage_asks_none(lint: Lint) -> None:
    text = on_layer(AST002="layer") + field(on_prim(AST002="why", NOPE="x"))
    assert found(lint({"stage.usda": text}, heeded=False)) == [("AST002", "/density", None)]
    assert found(lint({"stage.usda": text}, heeded=False, unused=True)) == [
        ("AST002", "/density", None)
    ]


def test_an_old_date_ignores_nothing(lint: Lint) -> None:
    text = field(on_prim(AST002="until 2026-12-31: the farm"))
    for day in ("2026-12-30", "2026-12-31"):
        assert found(lint({"stage.usda": text}, today=day)) == [
            ("AST002", "/density", "until 2026-12-31: the farm")
        ]
    findings = lint({"stage.usda": text}, today="2027-01-01")
    assert ("AST002", "/density", None) in found(findings)
    assert told(findings) == ["AST002 was ignored until 2026-12-31, which is over: 'the farm'"]


def unused(code: str, reason: str) -> str:
    return f"{code} is ignored here, and nothing is found that this suppresses: '{reason}'"


def test_what_matched_nothing_is_told_where_it_is_asked_for(lint: Lint) -> None:
    text = (
        on_layer(AST002="layer", FLD002="layer")
        + prim("A", on_prim(AST002="used"), inside=field())
        + prim("B", on_prim(AST002="idle", VOL001="of a rule that did not run"))
        + field(name="c")
    )
    findings = lint({"stage.usda": text}, unused=True)
    assert told(findings) == [unused("FLD002", "layer"), unused("AST002", "idle")]
    assert [each.site.prim for each in findings if each.code == "LNT003"] == [None, "/B"]
    assert told(lint({"stage.usda": text})) == []


def test_what_a_nearer_one_stands_before_is_not_used(lint: Lint) -> None:
    near = field(on_prim(AST002="near"))
    for text in (near, inherited(near)):
        text = on_layer(AST002="layer", VOL001="did not run") + text
        assert told(lint({"stage.usda": text}, unused=True)) == [unused("AST002", "layer")]


def test_what_is_taken_back_is_not_unused(lint: Lint) -> None:
    asset = f"({DEFAULT})\n{smoke(on_prim(AST002='asset'), inside=prim('Calm'))}"
    shot = prim("Shot", REFERENCE, on_prim(AST002=""))
    assert told(lint({"shot.usda": shot, "asset.usda": asset}, unused=True)) == []


def test_prototypes_are_looked_at(lint: Lint) -> None:
    text = inherited(prim("Calm", on_prim(AST002="idle")))
    findings = lint({"stage.usda": text}, unused=True)
    assert messages(findings) == [
        ("/A/Calm", None, f"{unused('AST002', 'idle')} (shown by 2 instances)")
    ]


def test_an_asset_may_need_elsewhere_what_matches_nothing_here(lint: Lint) -> None:
    asset = on_layer(DEFAULT, FLD002="layer") + smoke(on_prim(FLD002="asset"))
    own = prim("Shot", REFERENCE, on_prim(LNT005="shot"))
    layers = {"shot.usda": own, "asset.usda": asset}
    assert told(lint(layers, unused=True)) == [unused("LNT005", "shot")]
    sublayer = {"top.usda": "(\nsubLayers = [@./shot.usda@]\n)\n", **layers}
    assert told(lint(sublayer, unused=True)) == [unused("LNT005", "shot")]


def test_another_selection_may_use_it(lint: Lint) -> None:
    variants = f'variantSet "look" = {{\n"a" {{\n}}\n"b" {{\n{field()}}}\n}}\n'
    chosen = 'variants = { string look = "a" }\nprepend variantSets = ["look"]'
    text = prim("A", on_prim(AST002="b alone"), chosen, inside=variants)
    assert told(lint({"stage.usda": text}, unused=True)) == [unused("AST002", "b alone")]
    assert told(lint({"stage.usda": text}, unused=True, selections=9)) == []


def test_instances_use_it(lint: Lint) -> None:
    shot = prim("A", INSTANCE, on_prim(AST002="a")) + prim("B", INSTANCE, on_prim(FLD002="b"))
    layers = {"shot.usda": shot, "asset.usda": ASSET}
    assert told(lint(layers, unused=True)) == [unused("FLD002", "b")]
