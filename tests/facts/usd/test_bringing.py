"""Arcs between layer stacks, and the nodes that specs are in."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest
from pxr import Sdf, Usd

from usdvol_lint.engine.strength import Opinion, decisive, path_beside
from usdvol_lint.facts.usd.bringing import (
    arc_losing,
    crossings,
    from_root,
    meeting_spec,
    node_above,
    node_of,
)
from usdvol_lint.facts.usd.nodes import nodes_of

LAYERS = {
    "shot": '(\n    subLayers = [@./sub.usda@]\n)\ndef "a"\n{\n    def "child" (\n'
    "        references = @./asset.usda@</top>\n    )\n    {\n    }\n}\n",
    "sub": 'over "a"\n{\n    over "child" (\n        kind = "group"\n    )\n    {\n    }\n}\n',
    "asset": 'def "top" (\n    inherits = </_class>\n    payload = @./heavy.usda@</heavy>\n'
    '    variants = {\n        string look = "x"\n    }\n    prepend variantSets = "look"\n)\n{\n'
    '    variantSet "look" = {\n        "x" {\n            def "v"\n            {\n            }\n'
    '        }\n    }\n}\nclass "_class"\n{\n    def "c"\n    {\n    }\n}\n',
    "heavy": 'def "heavy"\n{\n    def "p"\n    {\n        int x = 1\n    }\n}\n',
}


@pytest.fixture
def stage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Usd.Stage:
    monkeypatch.chdir(tmp_path)
    for name, text in LAYERS.items():
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    return Usd.Stage.Open("shot.usda")


@pytest.mark.parametrize(
    ("path", "arcs"),
    [
        ("/a", []),
        ("/a/child/v", ["shot.usda /a/child"]),
        ("/a/child/c", ["shot.usda /a/child"]),
        ("/a/child/p", ["shot.usda /a/child", "asset.usda /top"]),
    ],
)
def test_crossings_are_the_arcs_into_other_layer_stacks(
    path: str, arcs: list[str], stage: Usd.Stage
) -> None:
    """Inherits and variants stay in their layer stack."""
    prim = stage.GetPrimAtPath(path)
    spec = prim.GetPrimStack()[-1]
    node = node_of(prim, spec)
    found = crossings(node)
    specs = [each.spec for each in found]
    assert [f"{each.layer.GetDisplayName()} {each.path}" for each in specs] == arcs
    assert len({each.key for each in found}) == len(arcs)
    steps = from_root(node)
    assert all(one.parent == other for other, one in pairwise(steps))


def test_a_layer_meets_another_where_an_arc_or_a_sublayer_brings_it_there(
    stage: Usd.Stage,
) -> None:
    prim = stage.GetPrimAtPath("/a/child/p")
    heavy = prim.GetPrimStack()[-1].layer

    def met(*names: str) -> tuple[str, str]:
        spec = meeting_spec(prim, heavy, lambda layer: layer.GetDisplayName() in names)
        return spec.layer.GetDisplayName(), str(spec.path)

    assert met("asset.usda", "shot.usda") == ("asset.usda", "/top")
    assert met("shot.usda") == ("shot.usda", "/a/child")
    assert met() == met("heavy.usda") == met("sub.usda") == ("shot.usda", "/")
    sub = stage.GetPrimAtPath("/a/child").GetPrimStack()[1].layer
    top = meeting_spec(stage.GetPrimAtPath("/a/child"), sub, lambda layer: layer != sub)
    assert (top.layer, str(top.path)) == (stage.GetRootLayer(), "/")


def test_an_arc_in_a_sublayer_meets_the_layer_above_it(stage: Usd.Stage) -> None:
    Path("above.usda").write_text("#usda 1.0\n(\n    subLayers = [@./shot.usda@]\n)\n")
    Path("top.usda").write_text("#usda 1.0\n(\n    subLayers = [@./above.usda@]\n)\n")
    top = Usd.Stage.Open("top.usda")
    prim = top.GetPrimAtPath("/a/child/p")
    heavy = prim.GetPrimStack()[-1].layer
    for names, expected in (
        (["top.usda", "above.usda"], ("above.usda", "/")),
        (["top.usda", "shot.usda"], ("shot.usda", "/a/child")),
        ([], ("top.usda", "/")),
    ):
        found = meeting_spec(prim, heavy, lambda layer: layer.GetDisplayName() in names)  # noqa: B023
        assert (found.layer.GetDisplayName(), str(found.path)) == expected


def test_the_arc_that_loses_a_path_is_the_first_beyond_which_it_has_no_name(
    stage: Usd.Stage,
) -> None:
    """Its name is another one beyond each arc, as `</heavy/p>` is `</top/p>` in the asset."""
    Path("piece.usda").write_text(
        '#usda 1.0\ndef "b" (\n    references = @./asset.usda@</top/p>\n)\n{\n}\n'
    )
    other = Usd.Stage.Open("piece.usda")
    piece = other.GetPrimAtPath("/b")
    whole = stage.GetPrimAtPath("/a/child/p")
    for prim, path, expected in (
        (whole, "/heavy/p", None),
        (whole, "/heavy/q", None),
        (whole, "../q", None),
        (whole, "/outside", ("asset.usda", "/top")),
        (piece, "/heavy/p/q", None),
        (piece, "/heavy/q", ("piece.usda", "/b")),
    ):
        arc = arc_losing(prim, prim.GetPrimStack()[-1], Sdf.Path(path))
        found = arc and (arc.layer.GetDisplayName(), str(arc.path))
        assert found == expected, path


def test_the_node_of_a_spec(stage: Usd.Stage) -> None:
    prim = stage.GetPrimAtPath("/a/child/v")
    (spec,) = prim.GetPrimStack()
    node = node_of(prim, spec)
    assert node
    assert str(node.path) == "/top{look=x}v"
    assert node_of(stage.GetPrimAtPath("/a"), spec) is None
    attribute = stage.GetPrimAtPath("/a/child/p").GetAttribute("x")
    of_property = node_of(attribute.GetPrim(), attribute.GetPropertyStack()[0])
    assert of_property
    assert str(of_property.path) == "/heavy/p"


def test_a_spec_that_is_not_composed_lies_below_a_node(stage: Usd.Stage) -> None:
    child = stage.GetPrimAtPath("/a/child")
    spec = stage.GetPrimAtPath("/a/child/p").GetPrimStack()[0]
    node = node_above(child, spec)
    assert node
    assert str(node.path) == "/heavy"
    shot = stage.GetRootLayer().GetPrimAtPath("/a")
    assert node_above(child, shot) is None


def test_a_path_as_a_layer_sees_it(stage: Usd.Stage) -> None:
    prim = stage.GetPrimAtPath("/a/child/v")
    top = stage.GetPrimAtPath("/a/child").GetPrimStack()
    layers = {spec.layer.GetDisplayName(): spec for spec in top}
    assert path_beside(prim, layers["shot.usda"]) == "/a/child/v"
    assert path_beside(prim, layers["sub.usda"]) == "/a/child/v"
    assert path_beside(prim, layers["asset.usda"]) == "/top/v"
    assert path_beside(stage.GetPrimAtPath("/a"), layers["asset.usda"]) == ""


def test_the_strongest_of_one_layer_stack_decides(stage: Usd.Stage) -> None:
    prim = stage.GetPrimAtPath("/a/child")
    shot, sub, *others = prim.GetPrimStack()
    for specs, expected in (
        ([shot, sub], shot),
        ([sub, shot], shot),
        ([others[-1], sub], sub),
        (others, others[0]),
        (others[::-1], others[0]),
        ([sub], sub),
    ):
        assert decisive([Opinion(prim, spec) for spec in specs]).spec == expected


def test_the_arc_that_brings_opinions_together_decides(stage: Usd.Stage) -> None:
    """Neither of two layers holds both."""
    prim = stage.GetPrimAtPath("/a/child/p")
    heavy = prim.GetPrimStack()[0]
    c = stage.GetPrimAtPath("/a/child/c")
    [of_class] = c.GetPrimStack()
    assert decisive([Opinion(prim, heavy), Opinion(c, of_class)]).spec == of_class


def test_nodes_are_in_the_order_of_strength(stage: Usd.Stage) -> None:
    prim = stage.GetPrimAtPath("/a/child")
    paths = [str(node.path) for node in nodes_of(prim.GetPrimIndex())]
    assert paths == ["/a/child", "/_class", "/top", "/_class", "/top{look=x}", "/heavy"]


def test_what_is_specialized_across_layers_comes_by_the_arc_that_is_authored(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """USD puts it below the root too, as the weakest of all, where no spec has an arc."""
    monkeypatch.chdir(tmp_path)
    head = "#usda 1.0\n"
    Path("far.usda").write_text(head + 'def "far"\n{\n    def "c"\n    {\n    }\n}\n')
    Path("lib.usda").write_text(
        head + 'def "lib" (\n    specializes = </base>\n)\n{\n}\n'
        'class "base" (\n    references = @./far.usda@</far>\n)\n{\n}\n'
    )
    Path("top.usda").write_text(head + 'def "a" (\n    references = @./lib.usda@</lib>\n)\n{\n}\n')
    stage = Usd.Stage.Open("top.usda")
    prim = stage.GetPrimAtPath("/a/c")
    [spec] = prim.GetPrimStack()
    arcs = [each.spec for each in crossings(node_of(prim, spec))]
    assert [(arc.layer.GetDisplayName(), str(arc.path)) for arc in arcs if arc] == [
        ("top.usda", "/a"),
        ("lib.usda", "/base"),
    ]
    assert None not in arcs
