"""Stages of a few kilobytes that show billions of prims, or nest thousands, are checked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hostiles import FIELD, HEADER, TWO, VOLUME, chain, forwarding, instance, nested, tree, world

from usdvol_lint.engine import stamp
from usdvol_lint.engine.blame import Blaming
from usdvol_lint.engine.engine import Engine
from usdvol_lint.engine.site import Sites
from usdvol_lint.engine.suppressions import Suppressions
from usdvol_lint.model import Finding, StageReport
from usdvol_lint.suppressions import InStages

MANY = 40
"""Levels of two instances each: a million times more than can be walked."""
DEEP = 1_500
"""Deeper than Python recurses."""
SPHERE = 'def Sphere "s"\n{\n}\n'
MOVED = VOLUME.replace("</nowhere>", "</w/f>")
OVER = 'over "o"\n{\n' + TWO + "}\n"
INSTANCER = 'def PointInstancer "i"\n{\nrel prototypes = </o>\n}\n'
IGNORED = (
    'def Volume "v" (\ncustomData = {\ndictionary usdvolLint = {\ndictionary ignore = {\n'
    'string VOL001 = "known"\n}\n}\n}\n)\n{\nrel field:density = </nowhere>\n}\n'
)


@pytest.fixture
def lint(engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.chdir(tmp_path)

    def call(text: str, by: Engine = engine) -> StageReport:
        Path("hostile.usda").write_text(HEADER + text, encoding="utf-8")
        return by.lint("hostile.usda")

    return call


def of(report: StageReport, code: str) -> list[Finding]:
    assert report.status == "checked"
    assert not {each.code for each in report.findings} & {"LNT001", "LNT002"}
    return [each for each in report.findings if each.code == code]


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        (world(TWO) + tree(MANY, VOLUME), {"VOL001"}),
        (world(TWO) + tree(MANY, IGNORED), {"VOL001"}),
        (world(TWO, kind="Volume") + tree(MANY, SPHERE), {"SCH009"}),
        (world(TWO, kind="Volume") + tree(MANY, FIELD), {"VOL010"}),
        (world(TWO, FIELD) + tree(20, MOVED), {"AST002", "LNT005"}),
        (world() + OVER + tree(MANY, VOLUME), set()),
        (world() + OVER.replace("over", "class") + tree(MANY, VOLUME), set()),
        (world(INSTANCER) + OVER + tree(MANY, VOLUME), set()),
        (world(INSTANCER) + OVER.replace("over", "class") + tree(MANY, VOLUME), set()),
        (world(TWO) + chain(DEEP, VOLUME), {"VOL001"}),
        (nested(DEEP, VOLUME), {"VOL001"}),
        (nested(DEEP, VOLUME, 'over "w"\n{\n'), set()),
        (forwarding(DEEP), {"AST002"}),
    ],
)
def test_hostile_stages_are_checked(text: str, codes: set[str], lint: Any) -> None:
    for code in codes or {"VOL001"}:
        assert bool(of(lint(text), code)) is bool(codes), code


def test_more_instances_than_one_can_imagine(lint: Any) -> None:
    [found] = of(lint(world(TWO) + tree(MANY, VOLUME)), "VOL001")
    assert found.message.endswith("(shown by more than 1,000,000,000,000 instances)")
    [found] = of(lint(world(TWO) + tree(9, VOLUME)), "VOL001")
    assert found.message.endswith("(shown by 1,024 instances)")


def test_places_that_are_not_looked_at_are_said(lint: Any) -> None:
    [found] = of(lint(world(TWO, FIELD) + tree(20, MOVED)), "LNT005")
    assert found.message == (
        "where it is and when it is visible was looked at for the first 473 of the instances that "
        "show it (shown by 2,097,152 instances)"
    )
    assert not of(lint(world(TWO, FIELD) + tree(4, MOVED)), "LNT005")


def test_groups_of_clips_that_are_not_looked_at_are_said(lint: Any) -> None:
    """Each instance stands below clips of its own, none of which reach into what it shows."""

    def carrier(number: int) -> str:
        keys = 'string primPath = "/a"\nasset[] assetPaths = [@./c.usda@]\n'
        clips = f"clips = {{\ndictionary default = {{\n{keys}}}\n}}\n"
        return f'def Xform "c{number:03}" (\n{clips})\n{{\n{instance("i", "/_a")}}}\n'

    asset = f'class Xform "_a"\n{{\n{FIELD}}}\n'
    [found] = of(lint(world(*map(carrier, range(103))) + asset), "LNT005")
    assert found.message == (
        "whether value clips reach it was looked at below 100 of 103 groups of prims with clips "
        "that it stands below (shown by 103 instances)"
    )
    assert not of(lint(world(*map(carrier, range(100))) + asset), "LNT005")


@pytest.mark.parametrize("last", ["</nowhere>", "</w.r0>", "</w.r7>"])
def test_what_relationships_forward_to_is_asked_once(
    last: str, lint: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[Any] = []
    own = Blaming._own
    monkeypatch.setattr(Blaming, "_own", lambda self, at: asked.append(at) or own(self, at))
    links = 60
    text = forwarding(links).replace("</w/v/f>", last)
    told = {each.site.property for each in lint(text).findings}
    assert told >= {f"field:n{link}" for link in range(links)}
    assert len(asked) < 6 * links


def test_shares_of_instances_by_path(engine: Engine, catalog: Any, lint: Any) -> None:
    """With patterns for paths, each of few instances is told apart, and many are not."""
    from usdvol_lint.config import Config
    from usdvol_lint.packs.activation import activate

    asked = InStages(prims=(("/w/a/**",),))
    own = Engine(catalog.rules, activate(Config(), catalog), suppressions=asked)
    few = of(lint(world(TWO) + tree(2, VOLUME), own), "VOL001")
    assert [each.site.prim for each in few] == ["/w/a/a/a/v", "/w/b/a/a/v"]
    assert len(of(lint(world(TWO) + tree(MANY, VOLUME), own), "VOL001")) == 1


def test_long_names_and_lists_are_cut(lint: Any) -> None:
    long = "n" * 100_000
    targets = ", ".join(f"</w/t{number}>" for number in range(5_000))
    text = world(
        f'def Volume "v"\n{{\nrel field:density = [{targets}]\n}}\n',
        FIELD.replace("gone", long),
        FIELD.replace('"f"', '"g"').replace('"d"', f'"{long}"'),
    )
    report = lint(text)
    [several] = of(report, "VOL004")
    assert several.message.startswith("'field:density' has 5000 targets, </w/t0>, </w/t1>, ")
    assert " characters …" in several.message
    assert max(len(each.message) + len(each.suggestion or "") for each in report.findings) < 4_200


@pytest.mark.parametrize(
    ("where", "name", "what"),
    [
        (Sites, "_find", "the layer and line of findings"),
        (stamp, "cover_of", "how much findings cover"),
        (stamp, "absent_of", "what other stages may complete"),
        (Suppressions, "reason", "what suppresses findings"),
    ],
)
def test_what_was_found_stands_where_what_belongs_to_it_is_not(
    where: Any, name: str, what: str, lint: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is told at its prim, and once a stage that looking for that failed."""

    def fail(*asked: Any) -> None:
        raise LookupError("nowhere")

    text = world(VOLUME, VOLUME.replace('"v"', '"u"'))
    found = {(each.code, each.site.prim, each.message) for each in lint(text).findings}
    monkeypatch.setattr(where, name, fail)
    report = lint(text)
    [failed] = [each for each in report.findings if each.code == "LNT002"]
    assert {(each.code, each.site.prim, each.message) for each in report.findings} == found | {
        ("LNT002", failed.site.prim, failed.message)
    }
    assert failed.message == (
        f"{what} could not be found here, and on {len(found) - 1} more prims: LookupError: nowhere"
    )
    assert (failed.site.layer, failed.site.line is None) == ("hostile.usda", where is Sites)
    assert failed.detail
    assert "nowhere" in failed.detail


def test_what_a_stage_completes_may_fail(
    lint: Any, engine: Engine, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The findings stand, and that is told."""

    def fails(facts: object) -> None:
        raise RuntimeError("no such prim")

    monkeypatch.setattr("usdvol_lint.engine.engine._completion", fails)
    report = lint(world(VOLUME))
    codes = {each.code for each in report.findings}
    assert {"VOL001", "LNT002"} <= codes
    assert report.completes is None
