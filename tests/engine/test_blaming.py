"""Which spec is to blame: of one opinion, and where several contradict one another."""

from __future__ import annotations

from typing import Any

import pytest
from blamings import ASSET, Open, blame, shot
from pxr import Usd

from usdvol_lint.engine.blame import Blaming
from usdvol_lint.rule import APIS, NAME, TYPE, Problem

FIELD = 'over "density"\n{\n%s\n}'
WHOLE = ("asset", "/tank", None, "")
PATH = ("asset", "/tank/density.filePath", "filePath", "")


@pytest.mark.parametrize(
    ("text", "path", "problem", "expected"),
    [
        (shot(), "/tank", {}, WHOLE),
        (shot(kind="def Volume"), "/tank", {}, WHOLE),
        (shot(kind="def Xform"), "/tank", {}, ("shot", "/tank", None, "")),
        (shot(), "/", {}, ("shot", "/", None, "")),
        (shot(), "/tank/density.filePath", {}, PATH),
        (shot(FIELD % 'asset filePath (doc = "x")'), "/tank/density.filePath", {}, PATH),
        (
            shot(FIELD % "asset filePath = @./b.vdb@"),
            "/tank/density.filePath",
            {},
            ("shot", "/tank/density.filePath", "filePath", ""),
        ),
        (
            shot(),
            "/tank/density.fieldName",
            {},
            ("asset", "/tank/density.fieldName", "fieldName", ""),
        ),
        (shot(), "/tank/density.fieldClass", {}, ("asset", "/tank/density", "fieldClass", "")),
        (
            shot("rel field:density"),
            "/tank.field:density",
            {},
            ("asset", "/tank.field:density", "field:density", ""),
        ),
        (
            shot("rel field:heat"),
            "/tank.field:heat",
            {},
            ("shot", "/tank.field:heat", "field:heat", ""),
        ),
        # what `of` asks for
        (shot(kind="def Volume"), "/tank", {"of": TYPE}, WHOLE),
        (shot(kind="def Xform"), "/tank", {"of": TYPE}, ("shot", "/tank", None, "")),
        (shot(), "/tank", {"of": (APIS, "MotionAPI")}, ("asset", "/tank", None, "MotionAPI")),
        (
            shot(meta='prepend apiSchemas = ["MotionAPI"]'),
            "/tank",
            {"of": (APIS, "MotionAPI")},
            ("asset", "/tank", None, "MotionAPI"),
        ),
        (
            shot(meta='prepend apiSchemas = ["GeomModelAPI"]'),
            "/tank",
            {"of": (APIS, "MotionAPI"), "subject": "x"},
            ("asset", "/tank", None, "x"),
        ),
        (shot(), "/tank/density", {"of": "kind"}, ("asset", "/tank/density", None, "")),
        (shot(), "/tank", {"of": "kind"}, WHOLE),
        (
            shot(FIELD % "asset filePath = @./b.vdb@"),
            "/tank/density.filePath",
            {"of": "documentation"},
            PATH,
        ),
        (
            shot(FIELD % "asset filePath = @./b.vdb@"),
            "/tank/density.filePath",
            {"of": "elementSize"},
            ("shot", "/tank/density.filePath", "filePath", ""),
        ),
        (shot(FIELD % "asset filePath = @./b.vdb@"), "/tank/density.filePath", {"of": NAME}, PATH),
        (
            shot(),
            "/tank/density.fieldClass",
            {"of": NAME},
            ("asset", "/tank/density", "fieldClass", ""),
        ),
    ],
)
def test_one_opinion(
    text: str,
    path: str,
    problem: dict[str, Any],
    expected: tuple[str, ...],
    opened: Open,
) -> None:
    assert blame(opened(shot=text, asset=ASSET), path, **problem) == expected


def test_the_session_layer_is_never_to_blame(opened: Open) -> None:
    stage = opened(shot=shot(), asset=ASSET)
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        stage.GetPrimAtPath("/tank").SetTypeName("Xform")
    assert blame(stage, "/tank", of=TYPE) == WHOLE


def test_a_spec_that_the_rule_names(opened: Open) -> None:
    """The top of a layer says which property it is about, as the layer sees it."""
    stage = opened(shot=shot(), asset=ASSET)
    asset = stage.GetPrimAtPath("/tank").GetPrimStack()[-1].layer
    spec = asset.GetPrimAtPath("/tank")
    assert blame(stage, "/tank/density.filePath", spec=spec) == ("asset", "/tank", "filePath", "")
    assert blame(stage, "/tank", spec=spec, subject="x") == ("asset", "/tank", None, "x")
    top = asset.pseudoRoot
    expected = ("asset", "/", "filePath", "/tank/density.filePath")
    assert blame(stage, "/tank/density.filePath", spec=top) == expected
    assert blame(stage, "/tank/density", spec=top) == ("asset", "/", None, "")
    assert blame(stage, "/tank", spec=top, subject="x") == ("asset", "/", None, "x")
    stage = opened(other=shot().replace("tank", "a", 1), asset=ASSET)
    top = stage.GetPrimAtPath("/a").GetPrimStack()[-1].layer.pseudoRoot
    assert blame(stage, "/a/density.filePath", spec=top) == expected


def test_a_layer_names_the_sublayer_with_the_value(opened: Open) -> None:
    subs = "(\n    subLayers = [@./other.usda@, @./asset.usda@]\n)\n"
    stage = opened(shot=subs, asset=ASSET, other=ASSET.replace("tank", "other"))
    top = stage.GetRootLayer().pseudoRoot
    for path, asset in (("/tank/density.filePath", "./asset.usda"), ("/tank/density", None)):
        found = Blaming().blame(Problem("", at=stage.GetObjectAtPath(path), spec=top))
        assert found.asset == asset
    at = stage.GetObjectAtPath("/other/density.filePath")
    assert Blaming().blame(Problem("", at=at, spec=top)).asset == "./other.usda"
    assert Blaming().blame(Problem("", at=at, spec=at.GetPropertyStack()[0])).asset is None


OVER = ("shot", "/tank/density.fieldName", "fieldName", "")
ACTIVE = 'over "density" (\nactive = true\n)\n{\n}'


@pytest.mark.parametrize(
    ("text", "path", "problem", "expected"),
    [
        # The stronger of the two.
        (shot(), "/tank/density.filePath", {"against": ["/tank/density.fieldName"]}, PATH),
        (
            shot(FIELD % 'token fieldName = "x"'),
            "/tank/density.filePath",
            {"against": ["/tank/density.fieldName"]},
            OVER,
        ),
        (
            shot(FIELD % 'token fieldName = "x"'),
            "/tank/density.fieldName",
            {"against": ["/tank/density.filePath"]},
            OVER,
        ),
        # Of another prim: what it is about stands in the subject.
        (
            shot(FIELD % 'token fieldName = "x"'),
            "/tank.field:density",
            {"against": ["/tank/density.fieldName"]},
            ("shot", "/tank/density.fieldName", "fieldName", "/tank.field:density"),
        ),
        (
            shot(FIELD % 'token fieldName = "x"'),
            "/tank.field:density",
            {"against": ["/tank/density.fieldName"], "subject": "x"},
            ("shot", "/tank/density.fieldName", "fieldName", "x"),
        ),
        (
            shot(ACTIVE),
            "/tank.field:density",
            {"against": [("/tank/density", "active")]},
            ("shot", "/tank/density", None, "/tank.field:density"),
        ),
        (
            shot(ACTIVE),
            "/tank",
            {"against": [("/tank/density", "active")]},
            ("shot", "/tank/density", None, "/tank"),
        ),
        # Of the same prim, the property stays.
        (
            shot(meta='kind = "group"'),
            "/tank.extent",
            {"against": [("/tank", "kind")]},
            ("shot", "/tank", "extent", ""),
        ),
        # What nobody says contradicts nothing.
        (shot(), "/tank/density.filePath", {"against": [("/tank/density", "active")]}, PATH),
        (shot(), "/tank/density.filePath", {"against": ["/tank/density.fieldClass"]}, PATH),
        (shot(), "/tank/density.filePath", {"against": ["/tank"]}, PATH),
        # The arc that brings them together, where these are of different layers.
        (
            shot(more='over "none" {}\n').replace("def", "def Scope", 1)
            + 'def "both" (\nreferences = @./asset.usda@</tank>\n)\n{\n'
            'def "inner" (\nreferences = @./other.usda@</other>\n)\n{\n}\n}\n',
            "/both/inner",
            {"against": ["/both"]},
            ("shot", "/both/inner", None, ""),
        ),
    ],
)
def test_opinions_that_contradict(
    text: str,
    path: str,
    problem: dict[str, Any],
    expected: tuple[str, ...],
    opened: Open,
) -> None:
    stage = opened(shot=text, asset=ASSET, other=ASSET.replace("tank", "other"))
    problem["against"] = [
        (stage.GetPrimAtPath(each[0]), each[1]) if isinstance(each, tuple) else each
        for each in problem["against"]
    ]
    assert blame(stage, path, **problem) == expected


def test_a_relationship_that_another_forwards_to_is_an_opinion(opened: Open) -> None:
    asset = ASSET.replace("rel field:density = </tank/density>", "rel field:density = </tank.to>")
    asset = asset.replace("rel field", "rel to = </tank/density>\n    rel field")
    stage = opened(shot=shot("rel to = </tank/gone>"), asset=asset)
    assert blame(stage, "/tank.field:density") == ("shot", "/tank.to", "to", "")


def test_an_api_that_is_taken_away_is_an_opinion_on_it(opened: Open) -> None:
    stage = opened(shot=shot(meta='delete apiSchemas = ["MotionAPI"]'), asset=ASSET)
    assert blame(stage, "/tank", of=(APIS, "MotionAPI"))[:2] == ("shot", "/tank")
