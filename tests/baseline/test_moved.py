"""Layers that moved: how they are found, and how a baseline follows them."""

from __future__ import annotations

from pathlib import Path

import pytest
from runs import INFO, WARNING, cause, held, report, states, using, written

from usdvol_lint.model import UsageError
from usdvol_lint.results import Cause


def moved(folder: Path, was: list[Cause], now: list[Cause]) -> tuple[tuple[str, str], ...]:
    use = using(written(folder, *was)).apply(report(folder, *now)).report.baseline
    assert use
    return use.moved


def layers(*names: str) -> list[Cause]:
    """The same two causes in each of some layers."""
    return [cause(name, prim) for name in names for prim in ("/A", "/B")]


@pytest.mark.parametrize(
    ("was", "now", "expected"),
    [
        (["a/x.usda"], ["b/x.usda"], [("a", "b")]),
        (["a/x.usda"], ["a/y.usda"], [("a/x.usda", "a/y.usda")]),
        (["x.usda"], ["b/x.usda"], [("x.usda", "b/x.usda")]),
        (["a/x.usda", "a/c/y.usda"], ["b/x.usda", "b/c/y.usda"], [("a", "b")]),
        (
            ["a/x.usda", "a/y.usda"],
            ["b/x.usda", "b/z.usda"],
            [("a", "b"), ("a/y.usda", "b/z.usda")],
        ),
        (["a/x.usda", "a/y.usda"], ["b/p.usda", "b/q.usda"], []),
        (["p.usdz[c/x.usda]"], ["q.usdz[c/x.usda]"], [("p.usdz", "q.usdz")]),
        (["p.usdz"], ["lib/p.usdz"], [("p.usdz", "lib/p.usdz")]),
        (["a/x.usda"], ["a/x.usda", "b/x.usda"], []),
        (["a/x.usda"], [], []),
    ],
)
def test_what_moved(
    was: list[str], now: list[str], expected: list[tuple[str, str]], tmp_path: Path
) -> None:
    """As many entries are gone in one place as are new in another, and --moved makes them known."""
    assert list(moved(tmp_path, layers(*was), layers(*now))) == expected
    made = report(tmp_path, *layers(*now))
    applied = using(tmp_path / "b.jsonl", moved=tuple(expected)).apply(made)
    if expected:
        assert set(states(applied.report)) == {"known"}
        assert applied.report.baseline
        assert applied.report.baseline.gone == ()


def test_what_has_other_causes_did_not_move(tmp_path: Path) -> None:
    was = [cause("a/x.usda", "/A"), cause("a/x.usda", "/B")]
    assert moved(tmp_path, was, [cause("b/x.usda", "/A")]) == ()
    assert moved(tmp_path, was, [cause("b/x.usda", "/A"), cause("b/x.usda", "/C")]) == ()
    assert moved(tmp_path, [cause(None, None)], [cause("x", None)]) == ()


def of_levels(layer: str) -> list[Cause]:
    levels = {"/A": WARNING, "/B": INFO}
    return [cause(layer, prim, severity=level) for prim, level in levels.items()]


@pytest.mark.parametrize("was", ["error", "info"])
@pytest.mark.parametrize("now", ["error", "info"])
def test_a_layer_moved_with_its_infos(was: str, now: str, tmp_path: Path) -> None:
    """A baseline has infos only where they count, and a run has them in any case."""
    file = written(tmp_path, *of_levels("a/x.usda"), fail_on=was)
    assert len(held(file)) == (2 if was == "info" else 1)
    made = report(tmp_path, *of_levels("b/x.usda"), fail_on=now)
    use = using(file).apply(made).report.baseline
    assert use
    assert use.moved == (("a", "b"),)


def test_infos_alone_did_not_move(tmp_path: Path) -> None:
    was = [cause("a/x.usda", "/A"), cause("a/x.usda", "/B")]
    now = [cause("b/x.usda", "/A"), cause("b/x.usda", "/B", severity=INFO)]
    assert moved(tmp_path, was, now) == (("a", "b"),), "a severity of the configuration"
    assert moved(tmp_path, was[:1], now[1:]) == ()


def test_a_run_that_sees_less_knows_of_no_moves(tmp_path: Path) -> None:
    file = written(tmp_path, *layers("a/x.usda"))
    use = using(file).apply(report(tmp_path, *layers("b/x.usda"), content="off")).report.baseline
    assert use
    assert use.moved == ()


def test_moves_are_kept_by_what_writes(tmp_path: Path) -> None:
    file = written(tmp_path, *layers("a/x.usda", "ab/x.usda"))
    made = report(tmp_path, *layers("lib/a/x.usda", "ab/x.usda"))
    using(file, moved=(("a", "lib/a"),), prune=True).apply(made)
    names = ["ab/x.usda </A", "ab/x.usda </B", "lib/a/x.usda </A", "lib/a/x.usda </B"]
    assert held(file) == [f"AST002 {name}.filePath>" for name in names]
    assert states(using(file).apply(made).report) == ["known"] * 4


def test_entries_that_meet_are_joined(tmp_path: Path) -> None:
    file = written(tmp_path, cause("a.usda", frames=(1.0,)), cause("b.usda", frames=(2.0,)))
    made = report(tmp_path, cause("b.usda", frames=(1.0, 2.0)))
    assert states(using(file, moved=(("a.usda", "b.usda"),)).apply(made).report) == ["known"]


def test_what_was_checked_moves_too(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    file = written(tmp_path, cause("a/x.usda"), arguments=["a", "shots"])

    def lacking(*arguments: str, to: str = "b") -> str:
        made = report(tmp_path, cause("b/x.usda"), arguments=arguments)
        use = using(file, moved=(("a", to),)).apply(made).report.baseline
        assert use
        return use.partial

    (tmp_path / "b").mkdir()
    assert lacking("b") == ""
    assert lacking("shots") == "not checked: b"

    file = written(tmp_path, cause("a/x.usda"), arguments=["."])
    (tmp_path.parent / "elsewhere").mkdir(exist_ok=True)
    outside = (tmp_path.parent / "elsewhere").as_posix()
    assert lacking(".", to=outside) == f"not checked: {outside}"


@pytest.mark.parametrize(("old", "new"), [("a/x.usda", "b"), ("a", "b/x.usda")])
def test_a_layer_is_no_folder(old: str, new: str, tmp_path: Path) -> None:
    file = written(tmp_path, cause("a/x.usda"))
    with pytest.raises(UsageError, match="one of them is a layer and the other a folder"):
        using(file, moved=((old, new),))


@pytest.mark.parametrize("old", ["assets/b", "assets/a", "asset", "a.usda"])
def test_nothing_is_there(old: str, tmp_path: Path) -> None:
    file = written(tmp_path, cause("assets/a.usda"))
    with pytest.raises(UsageError) as caught:
        using(file, moved=((old, "x.usda"),))
    assert str(caught.value) == (
        f"--moved {old}=x.usda: {file} has no entry of a layer there, "
        "write OLD as the baseline has it"
    )
