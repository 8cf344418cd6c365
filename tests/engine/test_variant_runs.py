"""What is said once of all variant selections, and what fails under one of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from process import Ran, run
from pxr import Sdf, Tf
from varianttexts import LIMIT, LOOKS, Lint, field, found, prim, variant_set, volume, write

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.engine.variants import OtherSelections
from usdvol_lint.model import Severity
from usdvol_lint.packs.activation import ActiveRules, activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.rule import Facts, Prim, Problem, Problems, Rule


def test_a_field_that_some_selection_uses_is_not_unused(lint: Lint) -> None:
    fields = field("1", "density") + field("1", "heat")
    both = 'over "v"\n{\n    rel field:heat = </model/heat>\n}\n'
    inside = f'def Volume "v"\n{{\n    rel field:density = </model/density>\n}}\n{fields}'
    look = variant_set("look", full=both, lean="", more=field("1", "idle"))
    report = lint(stage=prim("model", look, inside=inside, look="full"))
    assert found(report) == [("VOL012", "/model/idle", "/model{look=more}")]


def test_a_rule_that_fails_under_every_selection_is_one_finding(lint: Lint, tmp_path: Path) -> None:
    def breaks(prim: Prim, facts: Facts) -> Problems:
        if prim.GetName() == "v":
            raise KeyError("v")
        yield Problem("seen", at=prim)

    rule = Rule("SEE001", "seen", ("Volume",), Severity.INFO, "1", breaks, {})
    active = ActiveRules({"SEE001": Severity.INFO}, {})
    engine = Engine({"SEE001": rule}, active, Depth(selections=LIMIT))
    looks = variant_set("look", a="", b=volume("1"), c=volume("2") + volume("2", "w"))
    write({"stage": prim("model", looks, look="a")})
    assert found(engine.lint("stage.usda")) == [
        ("LNT002", "/model/v", "/model{look=b}"),
        ("SEE001", "/model/w", "/model{look=c}"),
    ]


def test_usd_fails_under_a_selection(lint: Lint, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was found before stands."""

    def fail(others: OtherSelections, selection: Any) -> None:
        Tf.RaiseRuntimeError("not a good layer")

    monkeypatch.setattr(OtherSelections, "_compose", fail)
    looks = variant_set("look", a=volume("9"), b="", c="")
    report = lint(stage=prim("model", looks, look="a"))
    assert found(report) == [
        ("LNT001", None, "/model{look=b}"),
        ("AST002", "/model/v/d", "look=a"),
    ]
    assert "not a good layer" in report.findings[0].message


def test_variants_that_can_not_be_read(lint: Lint, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the authored selections show stands."""

    def fail(others: OtherSelections, selection: Any) -> None:
        Tf.RaiseRuntimeError("not a good layer")

    monkeypatch.setattr(OtherSelections, "_explore", fail)
    looks = variant_set("look", a=volume("9"), b="", c="")
    assert found(lint(stage=prim("model", looks, look="a"))) == [
        ("LNT001", None, None),
        ("AST002", "/model/v/d", "look=a"),
    ]


@pytest.mark.parametrize("selections", [0, LIMIT])
def test_a_field_that_another_variant_uses_is_not_unused(selections: int, lint: Lint) -> None:
    """Whichever of them is selected; and one that none uses is said once."""
    fields = "".join(field("1", name) for name in ("thin", "thick", "none"))
    bind = {name: f"rel field:density = </cloud/{name}>\n" for name in ("thin", "thick")}
    cloud = prim("cloud", variant_set("look", **bind), inside=fields, look="thin")
    report = lint(selections, stage=cloud.replace("def Xform", "def Volume"))
    unused = ["/cloud/none"] if selections else ["/cloud/none", "/cloud/thick"]
    assert [each.site.prim for each in report.findings if each.code == "VOL012"] == unused


def test_what_sums_up_a_stage_is_not_said_again_for_each_selection(lint: Lint) -> None:
    """The same missing layer, now on two prims and now on one."""
    lib = prim(
        "model", variant_set("look", a="(\n    references = @./no.usda@\n) {\n}", b=""), look="a"
    )
    text = "".join(
        f'def "{name}" (\n    references = @./lib.usda@</model>\n)\n{{\n}}\n' for name in "ab"
    )
    report = lint(stage=text + volume("1"), lib=lib.replace('"b" {', '"b" {\n' + volume("1")))
    assert report.stats["variant_selections"] == 2
    assert found(report) == [("STG001", "/a", "look=a")]


def test_the_layers_keep_their_own_selections(lint: Lint) -> None:
    """Composing the others changes nothing in the layers themselves."""
    lint(stage=LOOKS)
    layer = Sdf.Layer.FindOrOpen("stage.usda")
    assert not layer.dirty
    assert dict(layer.GetPrimAtPath("/model").variantSelections) == {"look": "thick"}


def test_pages_say_the_same_in_both_modes(
    catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As authored, a session layer changes nothing."""
    monkeypatch.chdir(tmp_path)
    active = activate(Config(select=("ALL",)), catalog)
    selected = Engine(catalog.rules, active)
    every = Engine(catalog.rules, active, Depth(selections=LIMIT))
    for code in catalog.rules:
        page = catalog.page(code)
        for number, example in enumerate(page.examples() if page else ()):
            folder = tmp_path / f"{code}_{number}"
            for name, text in {"stage.usda": example.text, **example.files}.items():
                file = folder / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            one, other = (engine.lint(str(folder / "stage.usda")) for engine in (selected, every))
            assert [
                each._replace(detail=None)
                for each in other.findings
                if not (each.site.variant or "").startswith("/")
            ] == [each._replace(detail=None) for each in one.findings]


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write({"stage": LOOKS})

    def tool(*arguments: str) -> Ran:
        return run("stage.usda", "--select", "AST002", *arguments, cwd=tmp_path)

    assert tool("--quiet") == tool("--quiet", "--variants", "selected") == Ran(0, "", "")
    ran = tool("--variants", "all")
    assert ran.code == 1
    assert "at filePath, variant /model{look=thin}" in ran.out
    ran = tool("--variants", "all", "--output-format", "json")
    report: Any = ran.json
    (finding,) = ran.stages[0]["findings"]
    assert finding["variant"] == "/model{look=thin}"
    assert (report["settings"]["variants"], report["settings"]["variant_limit"]) == ("all", 100)
    (tmp_path / "usdvol-lint.toml").write_text(
        'variants = "all"\nvariant-limit = 3\n', encoding="utf-8"
    )
    assert tool().code == 1
    assert tool("--variants", "selected").code == 0
    settings = json.loads(tool("--show-settings", "--output-format", "json").out)
    assert (settings["variants"], settings["variant_limit"]) == ("all", 3)


def test_a_variant_with_an_unreadable_clip_keeps_no_other_back(lint: Lint) -> None:
    clips = (
        '( clips = { dictionary default = { string primPath = "/b"\n'
        "asset[] assetPaths = [@./cut.usda@]\n"
        "double2[] active = [(0, 0)]\ndouble2[] times = [(0, 0)] } } ) {\n}"
    )
    library = f'class Volume "library" {clips}\n'
    sets = variant_set("look", a="", b=clips, c=field("gone", "e"), d=library + field("2", "e"))
    stage = prim("b", sets, inside=volume("1"), look="a")
    report = lint(stage=stage, cut="def (")
    assert sorted(found(report)) == [
        ("AST002", "/b/e", "/b{look=c}"),
        ("STG001", "/b", "/b{look=b}"),
        ("VOL012", "/b/e", "/b{look=c}"),
        ("VOL012", "/b/e", "/b{look=d}"),
    ]
