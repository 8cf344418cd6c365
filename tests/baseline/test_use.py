"""A run beside a baseline: what is known, worse, new and gone, and what is written then."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from runs import INFO, WARNING, cause, held, report, states, using, written

from usdvol_lint.baseline.use import Use, prepare
from usdvol_lint.model import Severity, Status, UsageError
from usdvol_lint.results import BaselineUse, Report, State

A, B, C = (f"AST002 assets/a.usda </{name}.filePath>" for name in "ABC")


def compared(file: Path, *causes: Any, **run: Any) -> Report:
    return using(file).apply(report(file.parent, *causes, **run)).report


def test_states(tmp_path: Path) -> None:
    file = written(
        tmp_path,
        cause(prim="/Known", frames=(3.0,)),
        cause(prim="/Worse", frames=(3.0,)),
        cause(prim="/Mended", frames=(3.0,)),
        cause(prim="/Later"),
    )
    made = compared(
        file,
        cause(prim="/Known", frames=(3.0,)),
        cause(prim="/Worse", frames=(3.0, 7.0)),
        cause(prim="/New", severity=WARNING),
        cause(prim="/Later", state=State.SUPPRESSED),
    )
    assert states(made) == ["known", "worse", "new", "suppressed"]
    assert [each.was and each.was.frames for each in made.causes] == [None, (3.0,), None, None]
    assert made.stages[0].levels == {Severity.ERROR: 1, WARNING: 1}
    assert made.baseline == BaselineUse(
        path=str(file),
        entries=4,
        gone=(
            "AST002 assets/a.usda </Later.filePath>",
            "AST002 assets/a.usda </Mended.filePath>",
        ),
    )
    assert made.baseline.is_unpruned


def test_one_mended_and_another_broken_is_new(tmp_path: Path) -> None:
    file = written(tmp_path, cause(prim="/A"), cause(prim="/B"))
    assert states(compared(file, cause(prim="/A"), cause(prim="/C"))) == ["known", "new"]


def test_a_severity_of_the_configuration_makes_nothing_worse(tmp_path: Path) -> None:
    file = written(tmp_path, cause(severity=WARNING))
    assert states(compared(file, cause(severity=Severity.ERROR, level=WARNING))) == ["known"]
    assert states(compared(file, cause(severity=INFO, level=WARNING))) == ["known"]


def test_what_is_all_frames_stays_so(tmp_path: Path) -> None:
    file = written(tmp_path, cause(frames=None))
    assert states(compared(file, cause(frames=tuple(map(float, range(900)))))) == ["known"]


# --- what a run covers ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("was", "now", "lacking"),
    [
        ({"arguments": ["shots"]}, {"arguments": ["."]}, ""),
        ({"arguments": ["shots"]}, {"arguments": ["assets", "shots"]}, ""),
        ({"arguments": ["shots/a.usda"]}, {"arguments": ["shots"]}, ""),
        ({"arguments": ["shots/a.usda"]}, {"arguments": ["shots/b.usda"]}, ""),  # a.usda is gone
        ({"arguments": ["."]}, {"arguments": ["shots"]}, "not checked: ."),
        ({"arguments": ["shots", "assets"]}, {"arguments": ["shots"]}, "not checked: assets"),
        ({"arguments": ["shots2"]}, {"arguments": ["shots"]}, "not checked: shots2"),
        ({"arguments": [".cache/x"]}, {"arguments": ["."]}, "not checked: .cache/x"),
        ({"arguments": [".cache/x"]}, {"arguments": [".cache"]}, ""),
        ({}, {"rules": {"AST001": "error"}}, "not in force: AST002, LNT001, LNT002"),
        ({}, {"rules": {f"AST00{n}": "info" for n in range(1, 8)}}, "not in force: LNT001, LNT002"),
        ({"rules": {}}, {}, ""),
        ({}, {"load": "none"}, "--load none instead of all"),
        ({"load": "none"}, {}, ""),
        ({"content": "first"}, {"content": "off"}, "--content off instead of first"),
        ({"content": "off"}, {"content": "first"}, ""),
        ({"variants": "all"}, {}, "--variants selected instead of all"),
        ({}, {"variants": "all"}, ""),
        (
            {"variants": "all"},
            {"variants": "all", "variant_limit": 9},
            "variant-limit = 9 instead of 100",
        ),
        ({}, {"variant_limit": 9}, ""),
        ({}, {"times": "ends"}, "--times ends instead of all"),
        ({"times": "first"}, {"times": "ends"}, ""),
        ({"times": "first"}, {"times": 1}, ""),
        ({"times": "ends"}, {"times": 2}, ""),
        ({"times": "ends"}, {"times": 1}, "--times 1 instead of ends"),
        ({"times": "ends"}, {"times": "first"}, "--times first instead of ends"),
        ({"times": 5}, {"times": 7}, "--times 7 instead of 5"),
        ({"times": 5}, {"times": 5}, ""),
        ({"times": 5}, {"times": "all"}, ""),
        ({}, {"exclude": ["old"]}, "exclude = ['old']"),
        ({"exclude": ["old"]}, {"exclude": ["old"]}, ""),
        ({"exclude": ["old"], "stages": ["*"]}, {}, ""),
        ({"stages": ["a"]}, {"stages": ["b"]}, "stages = ['b']"),
        (
            {"content": "all", "arguments": ["assets", "shots", "shots2", ".cache/x"]},
            {"content": "off", "arguments": []},
            "not checked: .cache/x, assets, shots and 1 more; --content off instead of all",
        ),
        (
            {},
            {"statuses": [Status.CHECKED, Status.TIMED_OUT, Status.UNREADABLE]},
            "not read: s1.usda, s2.usda",
        ),
    ],
)
def test_what_a_run_lacks(
    was: dict[str, Any], now: dict[str, Any], lacking: str, tmp_path: Path
) -> None:
    """Only a run that covers all that the baseline has tells what is gone, or prunes."""
    for name in ("shots", "shots2", "assets", ".cache/x"):
        (tmp_path / name).mkdir(parents=True)
    file = written(tmp_path, cause(prim="/A"), cause(prim="/B"), **was)
    before = file.read_bytes()
    use = compared(file, cause(prim="/A"), **now).baseline
    assert use
    assert use.partial == lacking
    assert use.gone == (None if lacking else (B,))

    applied = using(file, prune=True).apply(report(tmp_path, cause(prim="/A"), **now))
    assert states(applied.report) == ["known"]
    if lacking:
        said = f"--prune-baseline: this run sees less than {file} has: {lacking}"
        assert applied.failure == said
        assert file.read_bytes() == before
    else:
        assert applied.failure == ""
        assert held(file) == [A]


def test_a_rule_that_failed_covers_nothing(tmp_path: Path) -> None:
    file = written(tmp_path, cause(prim="/A"))
    use = compared(file, cause(None, None, code="LNT002", name=None)).baseline
    assert use
    assert (use.gone, use.partial) == (None, "a rule failed on s0.usda")


# --- what is written ------------------------------------------------------------------------------


def test_pruned_is_what_is_gone_and_nothing_else(tmp_path: Path) -> None:
    file = written(
        tmp_path,
        cause(prim="/A", frames=(3.0, 4.0)),
        cause(prim="/B", frames=(3.0,)),
        cause(prim="/C"),
        arguments=["shots"],
    )
    now = report(
        tmp_path,
        cause(prim="/A", frames=(3.0,)),
        cause(prim="/B", frames=(3.0, 4.0)),
        cause(prim="/New"),
    )
    applied = using(file, prune=True).apply(now)
    assert (applied.failure, states(applied.report)) == ("", ["known", "worse", "new"])
    assert applied.report.baseline == BaselineUse(str(file), 2, gone=(C,), written=True)
    assert not applied.report.baseline.is_unpruned
    assert held(file) == [A, B]
    assert '"arguments":["shots"]' in file.read_text("utf-8")

    again = using(file).apply(now).report
    assert states(again) == ["known", "worse", "new"], "nothing new or worse is taken in"
    lost = report(tmp_path, cause(prim="/A", frames=(4.0,)))
    assert states(using(file).apply(lost).report) == ["worse"], "what is mended stays so"


def test_a_baseline_that_is_written_makes_all_known(tmp_path: Path) -> None:
    made = report(tmp_path, cause(prim="/A"), cause(prim="/I", severity=INFO))
    applied = prepare(Use(write=str(tmp_path / "b.jsonl"))).apply(made)
    assert states(applied.report) == ["known", "new"]
    assert applied.report.stages[0].levels == {INFO: 1}
    assert applied.report.baseline == BaselineUse(str(tmp_path / "b.jsonl"), 1, (), written=True)


def test_brought_up_to_date_by_a_run_that_covers_it(tmp_path: Path) -> None:
    file = written(tmp_path, cause(prim="/A", frames=(3.0,)), cause(prim="/B"), content="off")
    now = report(tmp_path, cause(prim="/A", frames=(7.0,)), cause(prim="/C"))
    applied = using(file, write=str(file)).apply(now)
    assert (applied.failure, states(applied.report)) == ("", ["known", "known"])
    assert applied.report.baseline == BaselineUse(str(file), 2, gone=(B,), written=True)
    assert held(file) == [A, C]
    assert '"content":"all"' in file.read_text("utf-8")
    both = report(tmp_path, cause(prim="/A", frames=(3.0, 7.0)))
    assert states(using(file).apply(both).report) == ["worse"]


def test_brought_up_to_date_by_a_run_that_sees_less(tmp_path: Path) -> None:
    (tmp_path / "shots").mkdir()
    file = written(
        tmp_path,
        cause(prim="/A", frames=(3.0,)),
        cause(prim="/B"),
        arguments=["shots"],
        times="ends",
    )
    now = report(
        tmp_path,
        cause(prim="/A", frames=(7.0,)),
        cause(prim="/C"),
        arguments=["new.usda"],
        content="off",
        times=5,
        variants="all",
    )
    applied = using(file, write=str(file)).apply(now)
    assert (applied.failure, states(applied.report)) == ("", ["known", "known"])
    assert held(file) == [A, B, C]
    both = report(tmp_path, cause(prim="/A", frames=(3.0, 7.0)))
    assert states(using(file).apply(both).report) == ["known"]
    scope = using(file).baseline.scope  # type: ignore[union-attr]
    assert scope.arguments == ("new.usda", "shots")
    assert (scope.content, scope.times, scope.variants) == ("all", 5, "all")


def test_brought_up_to_date_in_another_file(tmp_path: Path) -> None:
    file = written(tmp_path, cause(prim="/A"))
    before = file.read_bytes()
    (tmp_path / "x").mkdir()
    copy = tmp_path / "x" / "copy.jsonl"
    using(file, write=str(copy)).apply(report(tmp_path, cause(prim="/B")))
    assert (file.read_bytes(), held(copy)) == (before, [B])
    assert using(copy).root == using(file).root


def test_pruning_while_writing_needs_a_run_that_covers_all(tmp_path: Path) -> None:
    file = written(tmp_path, cause(prim="/A"))
    now = report(tmp_path, cause(prim="/B"), content="off")
    applied = using(file, write=str(file), prune=True).apply(now)
    assert "sees less" in applied.failure
    assert held(file) == [A]


def test_a_configured_baseline_is_written_for_the_first_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    prepared = prepare(Use(read=str(tmp_path / "b.jsonl"), write="b.jsonl"))
    assert states(prepared.apply(report(tmp_path, cause())).report) == ["known"]
    assert held(tmp_path / "b.jsonl") == [A]
    with pytest.raises(UsageError):
        prepare(Use(read="gone.jsonl", write="other.jsonl"))


def test_a_baseline_moves_with_its_library(tmp_path: Path) -> None:
    """From another checkout, or another folder of it, nothing is new."""
    one, other = tmp_path / "one", tmp_path / "other"
    one.mkdir()
    written(one, cause())
    one.rename(other)
    prepared = using(other / "b.jsonl")
    assert prepared.root == other.resolve().as_posix()
    assert states(prepared.apply(report(other, cause())).report) == ["known"]
