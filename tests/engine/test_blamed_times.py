"""What is to blame at which times of its layer, and where two layers hold the values."""

from __future__ import annotations

from typing import Any, NamedTuple

import pytest
from blamings import ANIMATED, MOVED, Open

from usdvol_lint.engine.blame import Blaming
from usdvol_lint.engine.parts import parts_of
from usdvol_lint.engine.site import cover_of
from usdvol_lint.facts.usd.values import Value, Values
from usdvol_lint.model import Cover, Severity
from usdvol_lint.rule import NotChecked, Problem

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
