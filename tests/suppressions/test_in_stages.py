"""What stands in a stage: on prims and in layers, inherited, composed and taken back."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from zipfile import ZipFile

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

from usdvol_lint.model import Finding

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
    text = on_layer(*reversed_range, STG007="why") + field()
    assert found(lint({"stage.usda": text})) == [
        ("STG007", None, "why"),
        ("AST002", "/density", None),
    ]


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
