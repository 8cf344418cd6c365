"""What stands in a stage: on prims, inherited, composed, taken back, on instances, in layers."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from process import environment
from pxr import Sdf
from stagetexts import (
    ASSET,
    DEFAULT,
    INSTANCE,
    REFERENCE,
    field,
    found,
    on_layer,
    on_prim,
    prim,
    smoke,
    told,
)

from usdvol_lint.engine import shares
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding, Severity
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.rule import Problem, Rule

Lint = Callable[..., tuple[Finding, ...]]


def test_a_prim_ignores_what_is_found_at_it_and_below_it(lint: Lint) -> None:
    text = (
        prim("A", on_prim(AST002="why"), inside=prim("Deep", inside=field()))
        + field(on_prim(AST002="here"), name="B")
        + field(on_prim(FLD002="of another rule"), name="C")
    )
    assert found(lint({"stage.usda": text})) == [
        ("AST002", "/A/Deep/density", "why"),
        ("AST002", "/B", "here"),
        ("AST002", "/C", None),
    ]


def test_the_nearest_reason_counts(lint: Lint) -> None:
    text = prim("A", on_prim(AST002="above"), inside=field(on_prim(AST002="near")))
    assert found(lint({"stage.usda": text})) == [("AST002", "/A/density", "near")]


def test_reasons_for_several_codes_come_from_several_prims(lint: Lint) -> None:
    bare = field(on_prim(FLD002="near")).replace('token fieldDataType = "float"', "")
    text = prim("A", on_prim(AST002="above"), inside=bare)
    assert found(lint({"stage.usda": text})) == [
        ("FLD002", "/A/density", "near"),
        ("AST002", "/A/density", "above"),
    ]


def test_a_prim_takes_back_what_one_above_it_ignores(lint: Lint) -> None:
    for empty in ("", "  "):
        text = prim("A", on_prim(AST002="above"), inside=field(on_prim(AST002=empty)))
        assert found(lint({"stage.usda": text})) == [("AST002", "/A/density", None)]


def test_keys_of_layers_merge(lint: Lint) -> None:
    """Of the asset's and the shot's reasons each holds, for the code that it stands at."""
    asset = on_layer(DEFAULT, VOL001="x") + smoke(on_prim(AST002="asset", FLD002="asset too"))
    shot = prim("Shot", REFERENCE, on_prim(VOL001="shot"))
    assert found(lint({"shot.usda": shot, "asset.usda": asset})) == [
        ("AST002", "/Shot/density", "asset")
    ]
    shot = prim("Shot", REFERENCE, on_prim(AST002="shot"))
    assert found(lint({"shot.usda": shot, "asset.usda": asset})) == [
        ("AST002", "/Shot/density", "shot")
    ]


def test_a_stronger_layer_takes_back_what_a_weaker_one_ignores(lint: Lint) -> None:
    taking = prim("Shot", REFERENCE, on_prim(AST002=""))
    for asset in (
        f"({DEFAULT})\n{smoke(on_prim(AST002='asset'))}",
        on_layer(DEFAULT, AST002="asset") + smoke(),
    ):
        assert found(lint({"shot.usda": taking, "asset.usda": asset})) == [
            ("AST002", "/Shot/density", None)
        ]


def test_where_there_is_nothing_to_take_back_a_reason_is_missing(lint: Lint) -> None:
    missing = (
        "AST002 is ignored here without a reason, and nothing else ignores it that this takes back"
    )
    for text in (
        field(on_prim(AST002="")),
        on_layer(AST002="") + field(),
        prim(
            "A",
            on_prim(AST002="why"),
            inside=prim("B", on_prim(AST002=""), inside=field(on_prim(AST002=""))),
        ),
    ):
        findings = lint({"stage.usda": text})
        assert told(findings) == [missing]
        assert [each.ignored for each in findings if each.code == "AST002"] == [None]


def test_a_layer_ignores_what_it_is_to_blame_for(lint: Lint) -> None:
    """The asset's own data is not on the stage of the shot, whose data is not the asset's."""
    asset = on_layer(DEFAULT, AST002="asset") + smoke()
    shot = prim("Shot", REFERENCE, inside=field(name="own"))
    assert found(lint({"shot.usda": shot, "asset.usda": asset})) == [
        ("AST002", "/Shot/density", "asset"),
        ("AST002", "/Shot/own", None),
    ]
    shot = on_layer(AST002="shot") + shot
    assert found(lint({"shot.usda": shot, "asset.usda": ASSET})) == [
        ("AST002", "/Shot/density", None),
        ("AST002", "/Shot/own", "shot"),
    ]


def test_a_layer_ignores_what_is_found_on_the_stage_as_such(lint: Lint) -> None:
    reversed_range = ("startTimeCode = 2", "endTimeCode = 1")
    text = on_layer(*reversed_range, STG007="why") + prim("A", kind="def Cube")
    assert found(lint({"stage.usda": text})) == [("STG007", None, "why")]


def test_a_layer_of_a_package_is_asked(lint: Lint, tmp_path: Path) -> None:
    asset = "#usda 1.0\n" + on_layer(DEFAULT, AST002="packed") + smoke()
    with ZipFile(tmp_path / "asset.usdz", "w") as package:
        package.writestr("root.usda", "#usda 1.0\n(\nsubLayers = [@./inner.usda@]\n)\n")
        package.writestr("inner.usda", asset)
    shot = prim("Shot", "references = @./asset.usdz@</Smoke>")
    assert found(lint({"shot.usda": shot})) == [("AST002", "/Shot/density", "packed")]


def test_a_crate_is_asked(lint: Lint, tmp_path: Path) -> None:
    text = "#usda 1.0\n" + on_layer(DEFAULT, AST002=3) + smoke(on_prim(AST002="asset", FLD002=3))
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    layer.Export(str(tmp_path / "asset.usdc"))
    shot = prim("Shot", "references = @./asset.usdc@")
    findings = lint({"shot.usda": shot})
    assert ("AST002", "/Shot/density", "asset") in found(findings)
    assert told(findings) == [
        "the reason why AST002 is ignored is a number, not a text",
        "the reason why FLD002 is ignored is a number, not a text",
    ]


def test_of_clips_the_layer_that_names_them_is_asked(lint: Lint) -> None:
    clip = field().replace(
        "asset filePath = @./gone.vdb@", "asset filePath.timeSamples = { 1: @./gone.vdb@ }"
    )
    clips = (
        "clips = {\ndictionary default = {\nasset[] assetPaths = [@./clip.usda@]\n"
        "double2[] active = [(1, 0)]\ndouble2[] times = [(1, 1)]\n"
        'asset manifestAssetPath = @./manifest.usda@\nstring primPath = "/density"\n}\n}'
    )
    manifest = 'def OpenVDBAsset "density"\n{\nasset filePath\n}\n'
    stage = field(clips).replace("asset filePath = @./gone.vdb@\n", "")
    layers = {"manifest.usda": manifest}
    of_stage = {"stage.usda": on_layer(AST002="with the clips") + stage, "clip.usda": clip}
    assert found(lint(of_stage | layers)) == [("AST002", "/density", "with the clips")]
    of_clip = {"stage.usda": stage, "clip.usda": on_layer(AST002="the clip") + clip}
    assert found(lint(of_clip | layers)) == [("AST002", "/density", None)]


# --- instances ------------------------------------------------------------------------------------


def messages(findings: Iterable[Finding]) -> list[tuple[str | None, str | None, str]]:
    return [(each.site.prim, each.ignored, each.message) for each in findings]


GONE = "no file at './gone.vdb'"


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


def inherited(inside: str) -> str:
    """Two instances of a class in the stage itself."""
    return prim("Rig", inside=inside, kind="class") + "".join(
        prim(name, "inherits = </Rig>\ninstanceable = true", kind="def") for name in "AB"
    )


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


# --- variants -------------------------------------------------------------------------------------


def test_a_variant_may_ignore_what_another_does_not(lint: Lint) -> None:
    variants = (
        f'variantSet "look" = {{\n"thick" (\n{on_prim(AST002="thick")})\n{{\n{field()}}}\n'
        f'"thin" {{\n{field()}}}\n}}\n'
    )
    chosen = 'variants = { string look = "thick" }\nprepend variantSets = ["look"]'
    findings = lint({"stage.usda": prim("Smoke", chosen, inside=variants)}, selections=9)
    assert [(each.site.variant, each.ignored) for each in findings] == [
        ("look=thick", "thick"),
        ("/Smoke{look=thin}", None),
    ]


def test_another_selection_may_bring_instances_that_differ(lint: Lint) -> None:
    both = prim("A", INSTANCE, on_prim(AST002="a")) + prim("B", INSTANCE)
    variants = f'variantSet "look" = {{\n"none" {{\n}}\n"both" {{\n{both}}}\n}}\n'
    chosen = 'variants = { string look = "none" }\nprepend variantSets = ["look"]'
    layers = {"stage.usda": prim("Rig", chosen, inside=variants), "asset.usda": ASSET}
    assert found(lint(layers, selections=9)) == [
        ("AST002", "/Rig/A/density", "a"),
        ("AST002", "/Rig/B/density", None),
    ]


# --- what is wrong --------------------------------------------------------------------------------


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


# --- what is not used -----------------------------------------------------------------------------


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


# --- rules that fail ------------------------------------------------------------------------------


def _fails(prim: Any, facts: Any) -> Iterator[Problem]:
    yield Problem("it is here", at=prim, holds=lambda: 1 // (prim.GetName() != "Unsure"))
    if prim.GetName() == "Rough":
        raise ValueError("rough")


def test_that_a_rule_failed_is_never_ignored(catalog: Catalog, tmp_path: Path) -> None:
    """Who says so is told, also where nothing else was found."""
    rule = Rule("ZZZ001", "rough", ("Xform",), Severity.ERROR, "0.1", _fails, {})
    levels = dict.fromkeys(("LNT002", "LNT003", "ZZZ001"), Severity.ERROR)
    engine = Engine({**catalog.rules, "ZZZ001": rule}, ActiveRules(levels, {}))
    why = on_prim(ZZZ001="why", LNT002="why")
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n{prim('Rough', why)}{prim('Unsure', why)}", encoding="utf-8")
    assert sorted(found(engine.lint(str(stage)).findings)) == sorted(
        (code, path, "why" if code == "ZZZ001" else None)
        for code in ("LNT002", "LNT003", "ZZZ001")
        for path in ("/Rough", "/Unsure")
    )


def _only_fails(prim: Any, facts: Any) -> Iterator[Problem]:
    raise ValueError("rough")
    yield


def test_where_only_a_rule_failed_prims_are_asked_too(catalog: Catalog, tmp_path: Path) -> None:
    rule = Rule("ZZZ001", "rough", ("Xform",), Severity.ERROR, "0.1", _only_fails, {})
    levels = dict.fromkeys(("LNT002", "LNT003", "ZZZ001"), Severity.ERROR)
    engine = Engine({**catalog.rules, "ZZZ001": rule}, ActiveRules(levels, {}))
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n{prim('Rough', on_prim(LNT002='why'))}", encoding="utf-8")
    assert found(engine.lint(str(stage)).findings) == [
        ("LNT002", "/Rough", None),
        ("LNT003", "/Rough", None),
    ]


# --- what the machine lacks -----------------------------------------------------------------------


def test_what_the_machine_lacks_no_layer_can_ignore(lint: Lint) -> None:
    """But a prim can: it is there that it shows."""
    text = field(file="gone").replace("@./gone.vdb@", "@studio://gone.vdb@")
    assert found(lint({"stage.usda": on_layer(AST010="layer") + text})) == [
        ("AST010", "/density", None)
    ]
    text = text.replace("(\n\n)", f"(\n{on_prim(AST010='prim')})")
    assert found(lint({"stage.usda": text})) == [("AST010", "/density", "prim")]


# --- what it costs --------------------------------------------------------------------------------

_PROGRAM = """
import sys
from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import load
catalog = load()
engine = Engine(catalog.rules, activate(Config(), catalog))
for name in ("healthy.usda", "other.usda"):
    findings = engine.lint(name).findings
    print(len(findings), "usdvol_lint.engine.suppressions" in sys.modules)
"""


def test_a_healthy_stage_pays_nothing(tmp_path: Path) -> None:
    """Nothing is asked on it, whatever it ignores, since what asks is not even imported."""
    ignored = on_layer(AST002="layer")
    healthy = ignored + prim("A", on_prim(AST002="why"), inside=prim("B", kind="def Cube"))
    (tmp_path / "healthy.usda").write_text(f"#usda 1.0\n{healthy}", encoding="utf-8")
    (tmp_path / "other.usda").write_text(f"#usda 1.0\n{ignored}{field()}", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-P", "-c", _PROGRAM],
        cwd=tmp_path,
        env=environment(),
        capture_output=True,
        text=True,
        check=True,
    )
    first, second = done.stdout.splitlines()
    assert first == "0 False"
    assert second.endswith("True")
