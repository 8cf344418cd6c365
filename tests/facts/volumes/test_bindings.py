"""What a page cannot say of field relationships: payloads not loaded, layers that do not open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Usd

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.engine.walk import asked_by, walk
from usdvol_lint.facts import Context, Facts
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

FIELD = """def OpenVDBAsset "{name}" {{
    asset filePath = @./cloud.vdb@
    token fieldName = "density"
}}
"""
TARGET = "target a field that is there, or remove it"
Lint = Callable[..., list[tuple[str, str, str | None]]]


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    monkeypatch.chdir(tmp_path)

    def run(text: str, load: str = "all", **files: str) -> list[tuple[str, str, str | None]]:
        for name, content in {**files, "stage": text}.items():
            Path(f"{name}.usda").write_text("#usda 1.0\n" + content, encoding="utf-8")
        active = activate(Config(select=("VOL", "LNT"), ignore=("VOL011",)), catalog)
        report: StageReport = Engine(catalog.rules, active, Depth(load=load)).lint("stage.usda")
        return [(finding.code, finding.message, finding.suggestion) for finding in report.findings]

    return run


PAYLOAD = f"""
def Xform "fields" (payload = @./lib.usda@</fields>) {{
}}
def Volume "cloud" {{
    rel field:density = </fields/density>
}}
def Xform "spare" {{
{FIELD.format(name="spare")}
}}
"""
FIELDS = f'def Xform "fields" {{\n{FIELD.format(name="density")}}}\n'


def test_target_in_a_payload_that_was_not_loaded(lint: Lint) -> None:
    assert lint(PAYLOAD, load="none", lib=FIELDS)[-1:] == [
        (
            "LNT005",
            "'field:density' targets </fields/density>, "
            "which lies in a payload that was not loaded",
            None,
        )
    ]
    assert lint(PAYLOAD, lib=FIELDS) == [
        (
            "VOL012",
            "no Volume of this stage targets the field 'spare'",
            "bind it with 'rel field:spare' on a Volume, or remove it",
        )
    ]


@pytest.mark.parametrize("arc", ["references", "payload"])
@pytest.mark.parametrize("instanceable", ["", "instanceable = true"])
def test_target_below_a_layer_that_does_not_open(lint: Lint, arc: str, instanceable: str) -> None:
    text = f"""
def Volume "cloud" {{
    rel field:density = </cloud/density>
    rel field:heat = </cloud/fields/heat>
    rel field:fuel = </cloud/fields/deep/fuel>
    def "density" ({arc} = @./gone.usda@</density>) {{
    }}
    def Scope "fields" ({arc} = @./gone.usda@</fields>
        {instanceable}) {{
        over "heat" {{
        }}
    }}
}}
def Scope "elsewhere" {{
{FIELD.format(name="spare")}
}}
"""
    assert lint(text) == []
    again = f'def "a" (references = @./asset.usda@</cloud>\n{instanceable}) {{\n}}\n'
    assert lint(again + again.replace('"a"', '"b"'), asset=text) == []


def test_sublayer_that_does_not_open(lint: Lint) -> None:
    text = """(
    subLayers = [@./gone.usda@]
)
def Volume "cloud" {
    rel field:density = </fields/density>
}
"""
    assert lint(text) == []


def test_missing_field_in_a_nested_prototype_has_a_path_of_the_stage(lint: Lint) -> None:
    inner = """
def Scope "inner" {
    def Volume "cloud" {
        rel field:density = </inner/density>
    }
}
"""
    outer = """
def Scope "outer" {
    def "one" (references = @./inner.usda@</inner>
        instanceable = true) {
    }
    def "two" (references = @./inner.usda@</inner>
        instanceable = true) {
    }
}
"""
    stage = """
def "a" (references = @./outer.usda@</outer>
    instanceable = true) {
}
def "b" (references = @./outer.usda@</outer>
    instanceable = true) {
}
"""
    assert lint(stage, inner=inner, outer=outer) == [
        (
            "VOL001",
            "'field:density' targets </a/one/density>, and there is no such prim "
            "(shown by 4 instances)",
            TARGET,
        )
    ]


def test_two_fields_that_are_equally_near_are_no_suggestion(lint: Lint) -> None:
    text = f"""
def Volume "cloud" {{
    rel field:density = </gone/density>
}}
def Volume "one" {{
    rel field:density = </one/density>
    {FIELD.format(name="density")}
}}
def Volume "two" {{
    rel field:density = </two/density>
    {FIELD.format(name="density")}
}}
"""
    assert lint(text) == [
        ("VOL001", "'field:density' targets </gone/density>, and there is no such prim", TARGET)
    ]


@pytest.mark.parametrize(
    ("target", "code", "message", "suggestion"),
    [
        (
            "/cloud.one",
            "VOL003",
            "'field:density' forwards to </cloud.one>, which leads round in a circle",
            "target a field",
        ),
        (
            "/cloud/density.filePath",
            "VOL001",
            "'field:density' targets </cloud/density.filePath>, and there is no such prim",
            TARGET,
        ),
        (
            "/other/density.filePath",
            "VOL005",
            "'field:density' targets the property </other/density.filePath>, not a field prim",
            "target the prim </other/density>",
        ),
    ],
)
def test_targets_that_lead_astray(
    target: str, code: str, message: str, suggestion: str | None, lint: Lint
) -> None:
    """A field of the same name below another Volume is that Volume's, and no suggestion."""
    text = f"""
def Volume "cloud" {{
    rel field:density = <{target}>
    rel one = </cloud.two>
    rel two = </cloud.one>
}}
def Volume "other" {{
    rel field:density = </other/density>
    {FIELD.format(name="density")}
}}
"""
    assert lint(text) == [(code, message, suggestion)]


def test_two_relationships_of_one_volume_share_no_field(tmp_path: Path) -> None:
    text = f"""#usda 1.0
def Volume "cloud" {{
    rel field:a = </cloud/density>
    rel field:b = </cloud/density>
    {FIELD.format(name="density")}
}}
"""
    stage = Usd.Stage.Open(write(tmp_path / "stage.usda", text))
    walked = walk(stage, asked_by([]), PrimKinds())
    facts = Facts(Context.of(stage), walked)
    cloud, density = stage.GetPrimAtPath("/cloud"), stage.GetPrimAtPath("/cloud/density")
    assert not facts.volumes.is_shared(cloud, density)


def write(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_a_relationship_over_an_attribute_of_the_same_name(lint: Lint) -> None:
    text = """
class "_old" {
    custom string field:density = "density"
}
def Volume "cloud" (inherits = </_old>) {
    rel field:density
}
"""
    assert lint(text) == [("VOL003", "'field:density' has no target", "name a field, or remove it")]
