"""Reports count causes, and each stage by the level that a cause has there."""

from __future__ import annotations

import pickle

import pytest

from usdvol_lint.model import Cover, Finding, Severity, Site, Source, Status
from usdvol_lint.results import (
    BaselineUse,
    Cause,
    Place,
    Report,
    RunInfo,
    StageResult,
    State,
    Summary,
)

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO


def cause(code: str, severity: Severity, stage: int = 0, state: State = State.NEW) -> Cause:
    source, cover = Source("a.usda", "/a"), Cover(severity)
    finding = Finding(code, code.lower(), severity, "words", Site("a.usda", "/a"), source, cover)
    return Cause("f" * 16, severity, source, cover, (Place(stage, finding),), 1, state)


CAUSES = (
    cause("AST002", ERROR),
    cause("LNT005", INFO),
    cause("LNT001", ERROR, 1),
    cause("SCH007", WARNING, 0),
)


def report(*causes: Cause) -> Report:
    """The first shows three, one of them suppressed there; the second one is unreadable."""
    stages = (
        StageResult(
            *("a.usda", Status.CHECKED, {"prims": 2}),
            causes=(0, 1, 3),
            worst=(WARNING, INFO, None),
        ),
        StageResult("b.usda", Status.UNREADABLE, causes=(0, 2, 3), worst=(ERROR, ERROR, WARNING)),
        StageResult("c.usda", Status.CHECKED, {"prims": 3, "volumes": 1}),
    )
    made = Report("1", "26.11", {}, "/lib", stages, (), RunInfo())
    return made.with_causes(causes)


def test_a_summary_counts_causes() -> None:
    made = report(*CAUSES)
    assert made.summary == Summary(
        stages=3,
        errors=2,
        warnings=1,
        infos=1,
        by_code={"AST002": 1, "LNT001": 1, "LNT005": 1, "SCH007": 1},
        by_state={"new": 4},
        by_status={"checked": 2, "unreadable": 1},
        stats={"prims": 5, "volumes": 1},
        stages_with_findings=2,
    )
    assert made.summary.findings == 4
    assert pickle.loads(pickle.dumps(made)) == made


def test_a_stage_has_the_levels_that_causes_have_there() -> None:
    """Where a suppression takes one out of a stage, it is not in the levels of that."""
    assert [dict(stage.levels) for stage in report(*CAUSES).stages] == [
        {INFO: 1, WARNING: 1},
        {WARNING: 1, ERROR: 2},
        {},
    ]


@pytest.mark.parametrize(
    ("state", "counts"),
    [(State.NEW, True), (State.WORSE, True), (State.KNOWN, False), (State.SUPPRESSED, False)],
)
def test_what_is_known_or_suppressed_is_counted_apart(state: State, counts: bool) -> None:
    first, *others = CAUSES
    made = report(first._replace(state=state), *others)
    summary = made.summary
    assert (summary.errors, summary.by_code.get("AST002", 0)) == ((2, 1) if counts else (1, 0))
    by_state = {"new": 4} if state is State.NEW else {"new": 3, str(state): 1}
    assert summary.by_state == dict(sorted(by_state.items()))
    assert [stage.levels.get(ERROR, 0) for stage in made.stages] == [0, 2 if counts else 1, 0]
    assert made.stages[0].levels.get(WARNING, 0) == int(counts)


def test_what_is_known_alone_leaves_a_stage_without_findings() -> None:
    known = [each._replace(state=State.KNOWN) for each in CAUSES]
    assert report(*known).summary.stages_with_findings == 0


@pytest.mark.parametrize(
    ("gone", "written", "is_unpruned"),
    [(None, False, False), ((), False, False), (("x",), False, True), (("x",), True, False)],
)
def test_a_baseline_is_unpruned_while_gone_entries_are_in_it(
    gone: tuple[str, ...] | None, written: bool, is_unpruned: bool
) -> None:
    assert BaselineUse("b.jsonl", 3, gone, written=written).is_unpruned == is_unpruned
