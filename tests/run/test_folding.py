"""What stages show is folded into causes, in the order in which it is told."""

from __future__ import annotations

from typing import Any

import pytest

from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.model import Cover, Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.results import Cause, StageResult, State
from usdvol_lint.run.causes import MAX_PLACES, Causes, versions_in

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO
ASSET = Source("/lib/assets/tank.usda", "/tank", "filePath")


def found(
    prim: str,
    source: Source = ASSET,
    severity: Severity = ERROR,
    frames: tuple[float, ...] | None = None,
    code: str = "AST002",
    **more: Any,
) -> Finding:
    cover = Cover(ERROR, frames)
    return Finding(code, code, severity, prim, Site("a.usda", prim), source, cover, **more)


def folded(causes: Causes, stages: int) -> tuple[tuple[Cause, ...], list[StageResult]]:
    every = causes.result()
    reports = [StageReport(f"s{number}.usda", Status.CHECKED) for number in range(stages)]
    results = [causes.stage(number, each) for number, each in enumerate(reports)]
    return every, [each.judged(every) for each in results]


def places(cause: Cause) -> list[tuple[int, str | None]]:
    return [(place.stage, place.finding.site.prim) for place in cause.places]


def test_one_thing_to_mend_is_one_cause() -> None:
    causes = Causes("/lib")
    other = ASSET._replace(path="/other")
    causes.add(0, "s0.usda", [found("/a"), found("/b", severity=WARNING)])
    causes.add(1, "s1.usda", [found("/c", other), found("/d"), found("/d", code="X")])
    every, stages = folded(causes, 3)
    named = ASSET._replace(layer="assets/tank.usda")
    assert [(each.code, each.source, each.severity, each.count) for each in every] == [
        ("AST002", named, ERROR, 3),
        ("AST002", named._replace(path="/other"), ERROR, 1),
        ("X", named, ERROR, 1),
    ]
    assert [each.fingerprint for each in every] == [
        fingerprint(each.code, each.source) for each in every
    ]
    assert [(stage.causes, stage.worst, dict(stage.levels)) for stage in stages] == [
        ((0,), (ERROR,), {ERROR: 1}),
        ((0, 1, 2), (ERROR, ERROR, ERROR), {ERROR: 3}),
        ((), (), {}),
    ]


def test_a_cause_is_as_bad_as_its_worst_place_and_a_stage_as_its_own() -> None:
    causes = Causes("/lib")
    causes.add(0, "s0.usda", [found("/a", severity=INFO), found("/b", severity=WARNING)])
    causes.add(1, "s1.usda", [found("/a", severity=ERROR), found("/b", severity=INFO)])
    [cause], stages = folded(causes, 2)
    assert (cause.severity, [stage.worst for stage in stages]) == (ERROR, [(WARNING,), (ERROR,)])


def test_causes_and_places_are_in_the_order_in_which_they_were_added() -> None:
    """What is told last has the last number, whatever stage it shows in first."""
    causes = Causes("/lib", most=3)
    other, absent = (ASSET._replace(path=path) for path in ("/other", "/absent"))
    causes.add(0, "s0.usda", [found("/a"), found("/b")])
    causes.add(1, "s1.usda", [found("/c", other), found("/d")])
    causes.add(0, "s0.usda", [found("/e", absent), found("/f")])
    every, stages = folded(causes, 2)
    assert [each.source.path for each in every] == ["/tank", "/other", "/absent"]
    assert (places(every[0]), every[0].count) == ([(0, "/a"), (0, "/b"), (1, "/d")], 4)
    assert [stage.causes for stage in stages] == [(0, 2), (0, 1)]


def test_twenty_places_are_kept() -> None:
    causes = Causes("/lib")
    causes.add(0, "s0.usda", [found(f"/{number}") for number in range(30)])
    [cause], _ = folded(causes, 1)
    assert (len(cause.places), MAX_PLACES, cause.count) == (20, 20, 30)


def test_the_cover_is_that_of_all_places() -> None:
    """Also of those that are not kept."""
    causes = Causes("/lib", most=1)
    for stage, frames in enumerate([(1.0,), (3.0, 4.0), (1.0,)]):
        causes.add(stage, "s.usda", [found("/a", frames=frames)])
    [cause], _ = folded(causes, 3)
    assert cause.cover == Cover(ERROR, (1.0, 3.0, 4.0))


def test_what_the_machine_lacks_has_no_layer() -> None:
    causes = Causes("/lib")
    source = Source(None, subject="usd-core")
    for stage in range(2):
        causes.add(stage, "s.usda", [found("/a", source, code="LNT004")])
    [cause], _ = folded(causes, 2)
    assert (cause.source, cause.count) == (source, 2)


# --- suppressions ---


def test_a_suppression_takes_away_places() -> None:
    """What is left makes the number, the level, the cover and what stages show."""
    causes = Causes("/lib")
    ignored = found("/a", frames=(9.0,), ignored="late")
    causes.add(0, "s0.usda", [ignored, found("/b", severity=WARNING, frames=(1.0,))])
    causes.add(1, "s1.usda", [ignored])
    [cause], stages = folded(causes, 2)
    assert (cause.state, cause.reason, cause.severity, cause.count) == (State.NEW, None, WARNING, 1)
    assert (places(cause), cause.cover.frames) == ([(0, "/b")], (1.0,))
    assert [(stage.causes, stage.worst) for stage in stages] == [
        ((0,), (WARNING,)),
        ((0,), (None,)),
    ]


def test_a_cause_is_suppressed_where_no_place_is_left() -> None:
    reasons = {"s0.usda": "late", "s1.usda": "old"}
    causes = Causes("/lib", reason_for=lambda path, finding, source: reasons.get(path))
    causes.add(0, "s0.usda", [found("/a")])
    causes.add(1, "s1.usda", [found("/b")])
    [cause], stages = folded(causes, 2)
    assert (cause.state, cause.reason, cause.count) == (State.SUPPRESSED, "late", 2)
    assert [place.finding.ignored for place in cause.places] == ["late", "old"]
    assert [(stage.worst, dict(stage.levels)) for stage in stages] == [((None,), {})] * 2
    causes.add(2, "s2.usda", [found("/c")])
    [cause], _ = folded(causes, 3)
    assert (cause.state, cause.reason, places(cause)) == (State.NEW, None, [(2, "/c")])


def test_the_configuration_is_asked_with_the_layer_as_it_is_named() -> None:
    asked: list[tuple[str, str | None, str | None]] = []

    def reason_for(path: str, finding: Finding, source: Source) -> str | None:
        asked.append((path, finding.site.prim, source.layer))
        return None

    causes = Causes("/lib", versions_in(r"v\d+"), reason_for=reason_for)
    causes.add(0, "s0.usda", [found("/a", Source("/lib/v1/a.usda"))])
    causes.add(0, "s0.usda", [found("/b", ignored="in the stage")])
    assert asked == [("s0.usda", "/a", "*/a.usda")]


# --- names of layers ---


@pytest.mark.parametrize(
    ("layer", "named"),
    [
        ("/lib/tank/v001/tank.usda", "tank/*/tank.usda"),
        ("/lib/tank_v1.v2.usda", "tank_*.*.usda"),
        ("/lib/v12/rev12/dev1/v2ray.usda", "*/rev12/dev1/v2ray.usda"),
        ("/lib/v1-v2/äv3.usda", "*-*/äv3.usda"),
        ("/elsewhere/v1/a.usda", "/elsewhere/*/a.usda"),
    ],
)
def test_versions_are_folded_between_separators(layer: str, named: str) -> None:
    for pattern, expected in ((r"v\d+", named), (r"v\d|v\d+", named), (None, None)):
        causes = Causes("/lib", versions_in(pattern))
        causes.add(0, "s.usda", [found("/a", Source(layer))])
        [cause], _ = folded(causes, 1)
        assert cause.source.layer == (expected or layer.removeprefix("/lib/"))


def test_without_a_root_layers_go_by_their_absolute_paths() -> None:
    causes = Causes()
    causes.add(0, "s.usda", [found("/a")])
    [cause], _ = folded(causes, 1)
    assert cause.source == ASSET
