"""Which spec is to blame: of one opinion, and where several contradict one another."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from pxr import Usd

from usdvol_lint.engine.blame import Blaming
from usdvol_lint.engine.parts import parts_of
from usdvol_lint.engine.site import cover_of
from usdvol_lint.facts.usd.values import Value, Values
from usdvol_lint.model import Cover, Severity
from usdvol_lint.rule import APIS, NAME, TYPE, NotChecked, Problem

Open = Callable[..., Usd.Stage]

ASSET = """
def Volume "tank" (
    prepend apiSchemas = ["MotionAPI"]
)
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </tank/density>
    def OpenVDBAsset "density" (
        kind = "component"
    )
    {
        asset filePath (
            doc = "words"
        )
        asset filePath = @./a.vdb@
        token fieldName
    }
}
"""
REFERS = "references = @./asset.usda@</tank>"


@pytest.fixture
def opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Open:
    monkeypatch.chdir(tmp_path)

    def call(**layers: str) -> Usd.Stage:
        for name, text in layers.items():
            Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
        return Usd.Stage.Open(f"{next(iter(layers))}.usda")

    return call


def blame(stage: Usd.Stage, path: str, **problem: Any) -> tuple[str, str, str | None, str]:
    """Layer, path of the spec, property and subject."""
    at = stage.GetObjectAtPath(path) if path != "/" else stage.GetPseudoRoot()
    against = [
        stage.GetObjectAtPath(each) if isinstance(each, str) else each
        for each in problem.pop("against", ())
    ]
    found = Blaming().blame(Problem("", at=at, against=against, **problem))
    assert found.spec
    name = found.spec.layer.GetDisplayName()
    return name.removesuffix(".usda"), str(found.spec.path), found.property, found.subject


def shot(inside: str = "", meta: str = "", kind: str = "def", more: str = "") -> str:
    return f'{kind} "tank" (\n{meta}\n{REFERS}\n)\n{{\n{inside}\n}}\n{more}'


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
            ("shot", "/tank", None, "MotionAPI"),
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


# --- times ---

ANIMATED = """
def OpenVDBAsset "density"
{
    asset filePath = @./a.vdb@
    asset filePath.timeSamples = {
        1: @./1.vdb@,
        2: @./2.vdb@,
        4: @./4.vdb@,
    }
}
"""
MOVED = "(\n    subLayers = [@./base.usda@ (offset = 100; scale = 2)]\n)\n"
LEVEL = Severity.WARNING


class Some(NamedTuple):
    """Some of the values of an attribute, of `total` time samples."""

    attribute: Any
    times: tuple[float, ...]
    at_default: bool = False
    asset: str | None = None
    total: int = 3
    share: float | None = None
    sizes: tuple[int, ...] | None = None


@pytest.mark.parametrize(
    ("some", "cover", "time"),
    [
        ({"times": (104.0,)}, Cover(LEVEL, (2.0,)), 2.0),
        ({"times": (108.0, 104.0)}, Cover(LEVEL, (2.0, 4.0)), 4.0),
        ({"times": (102.0, 104.0, 108.0)}, Cover(LEVEL, None), 1.0),
        ({"times": (104.0,), "at_default": True}, Cover(LEVEL, (2.0,), True), None),
        ({"times": (), "at_default": True}, Cover(LEVEL, None, True), None),
        ({"times": (104.0,), "total": 1}, Cover(LEVEL, None), 2.0),
        ({"times": (104.0,), "total": 0}, Cover(LEVEL, (2.0,)), 2.0),
        (
            {"times": (104.0,), "share": 0.5, "sizes": (7, 9)},
            Cover(LEVEL, (2.0,), False, 0.5, 8),
            2.0,
        ),
        (
            {"times": (), "share": 0.5, "sizes": (7, 9)},
            Cover(LEVEL, None, False, 0.5, 8),
            None,
        ),
    ],
)
def test_a_cover_is_in_the_time_of_the_layer(
    some: dict[str, Any], cover: Cover, time: float | None, opened: Open
) -> None:
    stage = opened(shot=MOVED, base=ANIMATED)
    at = stage.GetObjectAtPath("/density.filePath")
    problem = Problem("", at=Some(at, **some))
    found = Blaming().blame(problem)
    assert (cover_of(problem, found, LEVEL), found.time) == (cover, time)


def test_the_cover_of_a_bare_attribute_counts_its_samples(opened: Open) -> None:
    stage = opened(shot=MOVED, base=ANIMATED)
    at = stage.GetObjectAtPath("/density.filePath")
    for times, frames in (((102.0, 104.0), (1.0, 2.0)), ((102.0, 104.0, 108.0), None)):
        problem = NotChecked("", at=at, times=times)
        assert cover_of(problem, Blaming().blame(problem), LEVEL) == Cover(LEVEL, frames)
    problem = NotChecked("", at=at.GetPrim(), times=(5.0,))
    assert cover_of(problem, Blaming().blame(problem), LEVEL) == Cover(LEVEL, (5.0,))


def test_what_is_stronger_than_all_that_contradicts_keeps_its_time(opened: Open) -> None:
    text = ANIMATED.replace("asset filePath = ", 'token fieldName = "x"\n    asset filePath = ')
    stage = opened(shot=MOVED, base=text)
    at = stage.GetObjectAtPath("/density.filePath")
    name = stage.GetObjectAtPath("/density.fieldName")
    found = Blaming().blame(Problem("", at=at, times=[104, 108], against=[name]))
    assert (found.property, found.time) == ("filePath", 2.0)


# --- two opinions are two problems ---

OVERRIDE = (
    "(\n    subLayers = [@./base.usda@]\n)\n"
    'over "density"\n{\n    asset filePath.timeSamples = {\n        1: @./x.vdb@,\n    }\n}\n'
)


def parts(problem: Problem) -> list[tuple[tuple[float, ...], bool, str]]:
    return [
        (part.times, part.at_default, Blaming().blame(part).spec.layer.GetDisplayName())
        for part in parts_of(problem)
    ]


def test_a_default_and_samples_of_two_layers_are_two(opened: Open) -> None:
    stage = opened(shot=OVERRIDE, base=ANIMATED)
    at = stage.GetObjectAtPath("/density.filePath")
    problem = Problem("", at=at, times=[1], at_default=True)
    assert parts(problem) == [((), True, "base.usda"), ((1.0,), False, "shot.usda")]
    whole = opened(base=ANIMATED)
    values = Values(at, (Value(None, "a"), Value(1.0, "b")), 1)
    samples = [part.cover.samples for part in parts_of(Problem("", at=values))]
    assert samples == [values.samples[:1], values.samples[1:]]
    one = whole.GetObjectAtPath("/density.filePath")
    problem = Problem("", at=one, times=[1], at_default=True)
    assert parts(problem) == [((1.0,), True, "base.usda")]
    spec = at.GetPropertyStack()[0]
    problem = Problem("", at=at, times=[1], at_default=True, spec=spec)
    assert parts(problem) == [((1.0,), True, "shot.usda")]
    problem = Problem("", at=at.GetPrim(), times=[1], at_default=True)
    assert parts(problem) == [((1.0,), True, "base.usda")]


def test_a_relationship_that_another_forwards_to_is_an_opinion(opened: Open) -> None:
    asset = ASSET.replace("rel field:density = </tank/density>", "rel field:density = </tank.to>")
    asset = asset.replace("rel field", "rel to = </tank/density>\n    rel field")
    stage = opened(shot=shot("rel to = </tank/gone>"), asset=asset)
    assert blame(stage, "/tank.field:density") == ("shot", "/tank.to", "to", "")


def test_an_api_that_is_taken_away_is_an_opinion_on_it(opened: Open) -> None:
    stage = opened(shot=shot(meta='delete apiSchemas = ["MotionAPI"]'), asset=ASSET)
    assert blame(stage, "/tank", of=(APIS, "MotionAPI"))[:2] == ("shot", "/tank")
