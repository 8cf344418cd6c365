"""Which variant sets are composed: those in instances, inherited ones, and how many."""

from __future__ import annotations

from typing import Any

import pytest
from varianttexts import LOOKS, Lint, field, found, prim, variant_set, volume

from usdvol_lint.engine import variant_sets


def instance(name: str, of: str = "model") -> str:
    meta = f"instanceable = true\n    references = @./lib.usda@</{of}>"
    return f'def "{name}" (\n    {meta}\n)\n{{\n}}\n'


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


def test_a_variant_is_looked_at_once_however_many_are_composed(
    lint: Lint, monkeypatch: pytest.MonkeyPatch
) -> None:
    """To look at all of 1,000 again for each that is composed would take minutes."""
    met: list[str] = []
    read: list[tuple[str, str]] = []
    variant, variants = variant_sets.VariantSet.variant, variant_sets._variants

    def count(of: variant_sets.VariantSet, name: str) -> variant_sets.Variant:
        met.append(name)
        return variant(of, name)

    def count_specs(spec: Any) -> Any:
        read.append((spec.layer.identifier, str(spec.path)))
        return variants(spec)

    monkeypatch.setattr(variant_sets.VariantSet, "variant", count)
    monkeypatch.setattr(variant_sets, "_variants", count_specs)
    names = [f"l{number}" for number in range(30)]
    sets = [variant_set(each, **dict.fromkeys(names, volume("1", each))) for each in ("a", "b")]
    composed = 10
    report = lint(composed, stage=prim("model", *sets, a="l0", b="l0"))
    assert [each.code for each in report.findings if each.code != "VOL001"] == ["LNT005"]
    selected = 2 * (1 + composed)
    assert len(met) == selected + 2 * (len(names) - 1)
    assert sorted(set(read)) == sorted(read)
