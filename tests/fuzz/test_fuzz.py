"""A slice of the hostile inputs, and that what is not as it should be is seen."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from fuzz.layers import BUILDERS
from fuzz.making import WEIGHTS, Maker
from fuzz.model import Input, Role
from fuzz.running import Done, Outcome, judged, outcomes, run_faults

SEED = 6
COUNT = 45
"""Among them is none that USD does not end to compose, which would take the whole time limit."""
FINDING = {"code": "AST002", "message": "x"}


def maker(seed: int = SEED) -> Maker:
    return Maker(seed, b'{"root":"."}\n{"fingerprint":"0"}\n', b'{"schema_version":"2.0"}')


def test_hostile_inputs_end_in_a_report_or_a_clear_error(tmp_path: Path) -> None:
    inputs = {number: maker().make(number) for number in range(COUNT)}
    found, peak = outcomes(inputs, tmp_path)
    wrong = {
        f"{SEED}:{number}": (each.wrong, each.detail)
        for number, each in found.items()
        if each.wrong
    }
    assert not wrong
    assert found.keys() == inputs.keys()
    layers = [number for number, made in inputs.items() if made.is_layer]
    assert 2 * sum(bool(found[number].opened) for number in layers) >= len(layers)
    assert peak < 2000


def test_a_seed_makes_the_same_inputs_again() -> None:
    assert [maker().make(number) for number in range(60)] == list(map(maker().make, range(60)))
    assert maker(1).make(3) != maker(2).make(3)


def test_every_kind_has_its_turn() -> None:
    assert sum(WEIGHTS.values()) == 100
    roles = {maker().make(number).role for number in range(100)}
    assert roles == set(Role)
    assert len(BUILDERS) > 20


def report(*stages: dict[str, Any], failure: str | None = None, **cause: str) -> str:
    told = {"causes": [FINDING | cause], "stages": stages, "failure": failure}
    return json.dumps(told)


def stage(path: str, status: str = "checked") -> dict[str, Any]:
    return {"path": path, "status": status, "causes": [0]}


ONE = report(stage("n0/s"))
FAULTS = {
    "did not end": Done(None, "", "", 0),
    "exit code 3": Done(3, ONE, "", 0),
    "exit code -11": Done(-11, ONE, "", 0),
    "a traceback": Done(1, ONE, "Traceback (most recent call last)", 0),
    "neither a report": Done(2, "", "", 0),
    "no report": Done(1, "{", "", 0),
    "2 stages are told of 1": Done(1, report(stage("n0/s"), stage("n0/s")), "", 0),
    "0 stages are told of 1": Done(1, report(), "", 0),
}


@pytest.mark.parametrize(("fault", "done"), FAULTS.items(), ids=FAULTS)
def test_a_run_that_is_not_as_it_should_be(fault: str, done: Done) -> None:
    assert fault in "; ".join(run_faults(done, 1, Role.STAGE))


@pytest.mark.parametrize(
    ("told", "outcome"),
    [
        (ONE, Outcome("findings", (), True, "AST002 x")),
        (report(stage("n0/other")), Outcome("wrong", ("it is not told",))),
        (
            report(stage("n0/s"), code="LNT002"),
            Outcome("wrong", ("a rule failed: x",), True, "LNT002 x"),
        ),
        (
            report(stage("n0/s", "crashed")),
            Outcome("wrong", ("crashed, and no LNT001",), False, "AST002 x"),
        ),
        (
            report(stage("n0/s", "crashed"), code="LNT001"),
            Outcome("crashed", (), False, "LNT001 x"),
        ),
    ],
)
def test_what_came_of_a_stage(told: str, outcome: Outcome) -> None:
    made = Input("usda", {}, "s")
    assert judged([0], Done(1, told, "", 0), {0: "n0/s"}, {0: made}) == {0: outcome}
