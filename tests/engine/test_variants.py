"""Variant selections besides the authored ones: composed in turn, each finding once."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from process import Ran, run
from pxr import Sdf, Tf

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.engine.variants import OtherSelections
from usdvol_lint.model import Severity, StageReport
from usdvol_lint.packs.activation import ActiveRules, activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.rule import Facts, Prim, Problem, Problems, Rule

RULES = ("AST002", "VOL001", "VOL012", "STG", "LNT")
LIMIT = 100
Lint = Callable[..., StageReport]


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    """Lints the first of the layers, with so many other selections composed at most."""
    monkeypatch.chdir(tmp_path)

    def call(selections: int = LIMIT, load: str = "all", **layers: str) -> StageReport:
        write(layers)
        active = activate(Config(select=RULES), catalog)
        engine = Engine(catalog.rules, active, Depth(load=load, selections=selections))
        report = engine.lint(f"{next(iter(layers))}.usda")
        assert report.status == "checked"
        return report

    return call


def write(layers: Mapping[str, str]) -> None:
    """Layers by name, with files that are there."""
    for name, text in layers.items():
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    for file in ("1.vdb", "2.vdb"):
        Path(file).write_bytes(b"not empty")


def found(report: StageReport) -> list[tuple[str, str | None, str | None]]:
    """What a report says: code, prim and variant."""
    return [(each.code, each.site.prim, each.site.variant) for each in report.findings]


def field(path: str, name: str = "d") -> str:
    return f'def OpenVDBAsset "{name}"\n{{\n    asset filePath = @./{path}.vdb@\n}}\n'


def volume(path: str, name: str = "v") -> str:
    """A Volume above the field that it lacks a relationship to: relative paths end in variants."""
    return f'def Volume "{name}"\n{{\n{field(path)}}}\n'


def variant_set(name: str, **variants: str) -> str:
    """A variant set; what begins with `(` is metadata of the variant."""
    inside = "".join(
        f'"{variant}" {text}\n' if text.startswith("(") else f'"{variant}" {{\n{text}}}\n'
        for variant, text in variants.items()
    )
    return f'variantSet "{name}" = {{\n{inside}}}\n'


def prim(name: str, *sets: str, inside: str = "", meta: str = "", **selected: str) -> str:
    names = ", ".join(f'"{text.split(chr(34))[1]}"' for text in sets)
    chosen = "".join(f'    string {key} = "{value}"\n' for key, value in selected.items())
    return (
        f'def Xform "{name}" (\n{meta}\nvariants = {{\n{chosen}}}\n'
        f"prepend variantSets = [{names}]\n)\n{{\n{''.join(sets)}{inside}}}\n"
    )


def instance(name: str, of: str = "model") -> str:
    meta = f"instanceable = true\n    references = @./lib.usda@</{of}>"
    return f'def "{name}" (\n    {meta}\n)\n{{\n}}\n'


LOOKS = prim("model", variant_set("look", thick=volume("1"), thin=volume("9")), look="thick")


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
    assert len({each.fingerprint for each in every.findings}) == 4


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


INNER = prim("inner", variant_set("look", a="", b=volume("9")), look="a")
LIBRARY = LOOKS + f'def "outer"\n{{\n{INNER}}}\n'


def test_instances(lint: Lint) -> None:
    """What the others show is no other finding because one of them is switched."""
    text = "".join(map(instance, "abc"))
    report = lint(stage=text, lib=LIBRARY.replace("./1.vdb", "./7.vdb"))
    assert found(report) == [
        ("AST002", "/a/v/d", "look=thick"),
        ("AST002", "/a/v/d", "/a{look=thin}"),
    ]
    assert [" (shown by 3 instances)" in each.message for each in report.findings] == [True, False]
    assert report.stats["variant_selections"] == 3


def test_variant_sets_inside_instances_are_said(lint: Lint) -> None:
    text = "".join(instance(name, "outer") for name in "ba")
    report = lint(stage=text, lib=LIBRARY)
    (finding,) = report.findings
    assert found(report) == [("LNT005", None, None)]
    assert finding.message == (
        "variant sets inside instances can't be selected from the stage, so only the authored "
        "selections were checked: /a/inner"
    )
    assert report.stats["variant_selections"] == 0
    plain = text.replace("instanceable = true", "")
    assert found(lint(stage=plain, lib=LIBRARY)) == [
        ("AST002", "/a/inner/v/d", "/a/inner{look=b}"),
        ("AST002", "/b/inner/v/d", "/b/inner{look=b}"),
    ]


def test_an_inherited_variant_set(lint: Lint) -> None:
    text = prim("_base", variant_set("look", a=volume("1"), b=volume("9")), look="a").replace(
        "def Xform", "class Xform"
    )
    text += 'def Xform "model" (\n    inherits = </_base>\n)\n{\n}\n'
    assert found(lint(stage=text)) == [("AST002", "/model/v/d", "/model{look=b}")]


def test_the_limit_is_said(lint: Lint) -> None:
    looks = {f"l{number}": volume(f"9{number}") for number in range(5)}
    text = prim("model", variant_set("look", l9="", **looks), look="l9")
    report = lint(2, stage=text)
    assert found(report) == [
        ("LNT005", None, None),
        ("AST002", "/model/v/d", "/model{look=l0}"),
        ("AST002", "/model/v/d", "/model{look=l1}"),
    ]
    assert report.findings[0].message == (
        "3 other variant selections were not composed: the limit is 2"
    )
    assert report.stats["variant_selections"] == 2
    one = lint(4, stage=text).findings[0]
    assert one.message == "1 other variant selection was not composed: the limit is 4"
    assert len(lint(5, stage=text).findings) == 5


def test_under_the_limit_what_holds_ours_comes_first_then_what_is_new(lint: Lint) -> None:
    lib = prim("model", variant_set("look", a=volume("1"), b=volume("9")), look="a")
    arc = "(\n    references = </mesh>\n) {\n}"
    text = prim("crowd", variant_set("lod", a="", b=arc, c=arc), lod="a")
    text += 'def Mesh "mesh"\n{\n}\n'
    for name in ("one", "two", "three"):
        text += f'def "{name}" (\n    references = @./lib.usda@</model>\n)\n{{\n}}\n'
    text += prim("own", variant_set("look", a=volume("1"), b=volume("8")), look="a")
    report = lint(2, stage=text, lib=lib)
    assert found(report)[1:] == [
        ("AST002", "/one/v/d", "/one{look=b}"),
        ("AST002", "/own/v/d", "/own{look=b}"),
    ]
    assert report.findings[0].message.startswith("4 other variant selections")
    assert [path for _, path, _ in found(lint(4, stage=text, lib=lib))] == [
        *(None, "/one/v/d", "/own/v/d", "/three/v/d", "/two/v/d"),
    ]


@pytest.mark.parametrize(
    ("variant", "composed"),
    [
        ("", 0),
        ("float x = 3\n", 0),
        ('over "mesh"\n{\n    float x = 3\n}\n', 0),
        ('def Mesh "mesh"\n{\n}\n', 0),
        ('def "group"\n{\n}\n', 1),
        ('def Mystery "thing"\n{\n}\n', 1),
        ('def Mesh "mesh"\n{\n    def Volume "v"\n    {\n    }\n}\n', 1),
        ('over "mesh" (\n    active = true\n)\n{\n}\n', 1),
        ('over "mesh" (\n    references = </mesh>\n)\n{\n}\n', 1),
        ('over "mesh" (\n    prepend apiSchemas = ["MaterialBindingAPI"]\n)\n{\n}\n', 1),
        (variant_set("inner", x='def Volume "v"\n{\n}\n'), 1),
    ],
)
def test_what_can_not_show_ours_is_not_composed(variant: str, composed: int, lint: Lint) -> None:
    text = prim("model", variant_set("look", a="", b=variant), look="a", inside=field("1", "mesh"))
    text = text.replace("def OpenVDBAsset", "def Mesh") + 'def Mesh "mesh"\n{\n}\n'
    assert lint(stage=text).stats["variant_selections"] == composed


@pytest.mark.parametrize("selected", [volume("1"), ""])
@pytest.mark.parametrize(
    ("target", "is_drawn"), [("/library/model", True), ("/library/more", True), ("/library", False)]
)
def test_variants_of_what_an_instancer_draws_below_an_over(
    target: str, is_drawn: bool, selected: str, lint: Lint
) -> None:
    model = prim("model", variant_set("look", thick=selected, thin=volume("9")), look="thick")
    instancer = 'def PointInstancer "{}"\n{{\n    rel prototypes = <{}>\n}}\n'
    library = f'over "library"\n{{\n{model}{instancer.format("more", "/library/model")}}}\n'
    report = lint(stage=instancer.format("all", target) + library)
    of_variant = ("AST002", "/library/model/v/d", "/library/model{look=thin}")
    assert [each for each in found(report) if each[0] != "STG005"] == [of_variant] * is_drawn


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


# --- the command ----------------------------------------------------------------------------------


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write({"stage": LOOKS})

    def tool(*arguments: str) -> Ran:
        return run("stage.usda", "--select", "AST002", *arguments, cwd=tmp_path)

    assert tool("--quiet") == tool("--quiet", "--variants", "selected") == Ran(0, "", "")
    ran = tool("--variants", "all")
    assert ran.code == 1
    assert "at filePath, variant /model{look=thin}" in ran.out
    report: Any = tool("--variants", "all", "--output-format", "json").json
    (finding,) = report["stages"][0]["findings"]
    assert finding["variant"] == "/model{look=thin}"
    assert (report["settings"]["variants"], report["settings"]["variant_limit"]) == ("all", 100)
    (tmp_path / "usdvol-lint.toml").write_text(
        'variants = "all"\nvariant-limit = 3\n', encoding="utf-8"
    )
    assert tool().code == 1
    assert tool("--variants", "selected").code == 0
    settings = json.loads(tool("--show-settings").out)
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
