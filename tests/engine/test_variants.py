"""Variant selections besides the authored ones: composed in turn, each finding once."""

from __future__ import annotations

from pathlib import Path

from varianttexts import LIMIT, LOOKS, Lint, field, found, prim, variant_set, volume, write

from usdvol_lint.config import Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Severity
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.rule import Facts, Prim, Problem, Problems, Rule


def test_both_modes_on_one_stage(lint: Lint) -> None:
    selected = lint(0, stage=LOOKS)
    assert (found(selected), set(selected.seconds)) == ([], {"open", "walk", "check"})
    every = lint(stage=LOOKS)
    (finding,) = every.findings
    assert found(every) == [("AST002", "/model/v/d", "/model{look=thin}")]
    lines = Path("stage.usda").read_text(encoding="utf-8").splitlines()
    assert finding.message.startswith("no file at './9.vdb'")
    assert "9.vdb" in lines[(finding.site.line or 0) - 1]
    assert (finding.site.layer, finding.site.property) == ("stage.usda", "filePath")
    assert list(every.seconds) == ["open", "walk", "check", "variants"]
    assert every.stats == {**selected.stats, "variant_selections": 1}


def test_a_missing_frame_in_one_look(lint: Lint) -> None:
    samples = "filePath.timeSamples = { 1: @./1.vdb@, 2: @./8.vdb@, 3: @./9.vdb@ }"
    samples = volume("1").replace("filePath = @./1.vdb@", samples)
    text = prim("model", variant_set("look", a=volume("1"), b=samples), look="a")
    assert lint(0, stage=text).findings == ()
    (finding,) = lint(stage=text).findings
    assert (finding.site.variant, finding.site.frames) == ("/model{look=b}", "2-3")


def test_what_is_found_as_authored_stays_as_it_is(lint: Lint) -> None:
    """Both looks lack a file of their own, and one outside; the selected look names it alike."""
    text = (
        prim("model", variant_set("look", a=volume("7"), b=volume("9")), look="a")
        + prim("other", variant_set("look", a="", b=""), inside=volume("8"), look="b")
        + volume("6", "apart")
    )
    selected = lint(0, stage=text)
    assert found(selected) == [
        ("AST002", "/apart/d", None),
        ("AST002", "/model/v/d", "look=a"),
        ("AST002", "/other/v/d", None),
    ]
    every = lint(stage=text)
    assert {each for each in every.findings if each.site.variant != "/model{look=b}"} == set(
        selected.findings
    )
    assert len(every.findings) == 4
    assert {(each.source.path, each.source.property) for each in every.findings} == {
        ("/apart/d", "filePath"),
        ("/model{look=a}v/d", "filePath"),
        ("/model{look=b}v/d", "filePath"),
        ("/other/v/d", "filePath"),
    }


def test_a_finding_of_several_selections_names_the_first(lint: Lint) -> None:
    late = prim("top", variant_set("look", a=field("1", "x"), b="", c=""), look="a")
    user = 'def Volume "user"\n{\n    rel field:density = </top/x>\n}\n'
    report = lint(stage=late + user)
    assert found(report) == [("VOL001", "/user", "/top{look=b}")]
    assert report.stats["variant_selections"] == 2


def test_no_selection_is_authored(lint: Lint) -> None:
    text = prim("model", variant_set("look", a=volume("9"), b=volume("1")))
    assert lint(0, stage=text).findings == ()
    assert found(lint(stage=text)) == [("AST002", "/model/v/d", "/model{look=a}")]


def test_two_sets_on_one_prim_are_switched_one_at_a_time(lint: Lint) -> None:
    text = prim(
        "model",
        variant_set("look", a=volume("1"), b=volume("9")),
        variant_set("time", day="", night=volume("8", "w"), noon=""),
        look="a",
        time="day",
    )
    report = lint(stage=text)
    assert found(report) == [
        ("AST002", "/model/v/d", "/model{look=b}"),
        ("AST002", "/model/w/d", "/model{time=night}"),
    ]
    assert report.stats["variant_selections"] == 3


def test_a_variant_in_a_variant(lint: Lint) -> None:
    """Sets that only another variant brings are switched below it, also where names repeat."""

    def inner(path: str) -> str:
        return variant_set("time", day="", night=volume(path))

    meta = '(\n    prepend variantSets = "time"\n    variants = {\n    string time = "day"\n}\n)'
    child = prim("c", inner("9"), time="day")
    text = prim("model", variant_set("look", a="", b=f"{meta} {{\n{inner('8')}{child}}}"), look="a")
    report = lint(stage=text)
    assert found(report) == [
        ("AST002", "/model/c/v/d", "/model{look=b}c{time=night}"),
        ("AST002", "/model/v/d", "/model{look=b}{time=night}"),
    ]
    assert report.stats["variant_selections"] == 3
    in_both = variant_set(
        "look",
        a=prim("c", inner("1"), time="day"),
        b=prim("c", inner("9"), time="day"),
    )
    report = lint(stage=prim("model", in_both, look="a"))
    assert found(report) == [("AST002", "/model/c/v/d", "/model{look=b}c{time=night}")]


def test_a_set_that_matters_under_another_variant_only(lint: Lint) -> None:
    """Without the Volume of one set, there is nothing that the other could change."""
    change = f'over "v"\n{{\n{field("9").replace("def OpenVDBAsset", "over")}}}\n'
    plain = volume("1").replace("asset filePath = @./1.vdb@", "")
    text = prim(
        "model",
        variant_set("look", none="", cloud=plain),
        variant_set("size", big=change, small=change.replace("9", "1")),
        look="none",
        size="small",
    )
    report = lint(stage=text)
    assert found(report) == [("AST002", "/model/v/d", "/model{look=cloud}{size=big}")]
    assert report.stats["variant_selections"] == 2


def test_a_payload_in_a_variant(lint: Lint) -> None:
    layers = {
        "stage": prim(
            "model",
            variant_set("look", a="", b="(\n    payload = @./far.usda@</far>\n) {\n}"),
            look="a",
        ),
        "far": f'def "far"\n{{\n{volume("9")}}}\n',
    }
    report = lint(**layers)
    assert found(report) == [("AST002", "/model/v/d", "/model{look=b}")]
    assert report.findings[0].site.layer == "far.usda"
    assert found(lint(load="none", **layers)) == [("LNT005", None, "/model{look=b}")]


def test_composition_errors_in_a_variant(lint: Lint) -> None:
    text = prim(
        "model",
        variant_set(
            "look",
            fine=volume("1"),
            gone="(\n    references = @./nope.usda@\n) {\n}",
            parse="(\n    references = @./broken.usda@\n) {\n}",
            prim="(\n    references = </nowhere>\n) {\n}",
        ),
        look="fine",
    )
    report = lint(stage=text, broken="def {\n")
    assert found(report) == [
        ("STG001", "/model", "/model{look=gone}"),
        ("STG001", "/model", "/model{look=parse}"),
        ("STG004", "/model", "/model{look=prim}"),
    ]
    assert all(each.site.layer == "stage.usda" and each.site.line for each in report.findings)
    assert not any("anon" in each.message for each in report.findings)


def test_a_broken_crate_in_a_variant(lint: Lint, tmp_path: Path) -> None:
    (tmp_path / "broken.usdc").write_bytes(b"PXR-USDC" + bytes(range(256)))
    look = variant_set("look", a=volume("9"), b="(\n    payload = @./broken.usdc@\n) {\n}")
    report = lint(stage=prim("model", look, look="a"))
    assert found(report) == [
        ("STG001", "/model", "/model{look=b}"),
        ("AST002", "/model/v/d", "look=a"),
    ]


def test_the_session_layer_is_never_blamed(lint: Lint, tmp_path: Path) -> None:
    """A prim without a type has its strongest spec blamed."""

    def counts(prim: Prim, facts: Facts) -> Problems:
        yield Problem(f"{len(prim.GetChildren())} below", at=prim)

    rule = Rule("SEE001", "seen", ("MaterialBindingAPI",), Severity.INFO, "1", counts, {})
    active = ActiveRules({"SEE001": Severity.INFO}, {})
    engine = Engine({"SEE001": rule}, active, Depth(selections=LIMIT))
    meta = 'prepend apiSchemas = ["MaterialBindingAPI"]'
    text = prim("model", variant_set("look", a="", b=volume("1")), meta=meta, look="a")
    write({"stage": text.replace("def Xform", "def")})
    report = engine.lint("stage.usda")
    assert found(report) == [("SEE001", "/model", None), ("SEE001", "/model", "/model{look=b}")]
    assert {(each.site.layer, each.site.line) for each in report.findings} == {("stage.usda", 2)}
