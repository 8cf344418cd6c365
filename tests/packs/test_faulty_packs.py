"""What a rule does wrong is a finding at its prim or an error at load, and nothing else is lost."""

from __future__ import annotations

from pathlib import Path

import pytest
from process import run, volume, write

from usdvol_lint.model import PackError
from usdvol_lint.packs.catalog import load

RULE = """
from usdvol_lint.rule import INFO, Problem, rule

@rule("FLT001", on="Volume", severity=INFO, since="1")
def faulty(volume, facts):
    yield Problem({problem})
"""


def findings(
    folder: Path, problem: str
) -> tuple[int, list[tuple[str, str, str, tuple[float, ...]]]]:
    """The exit code, and the findings of two stages under a pack with one rule."""
    pack = folder / "pack"
    pack.mkdir()
    (pack / "faulty.py").write_text(RULE.format(problem=problem), encoding="utf-8")
    write(folder / "stages", one=volume("a"), two=volume("b"))
    ran = run(
        "--isolated",
        "--pack",
        pack,
        "--select",
        "FLT",
        "--output-format",
        "json",
        "stages",
        cwd=folder,
    )
    return ran.code, [
        (each["code"], each["prim"], each["message"], tuple(each["times"]))
        for stage in ran.json["stages"]
        for each in stage["findings"]
    ]


def test_times_may_be_any_sequence(tmp_path: Path) -> None:
    assert findings(tmp_path, "'seen', at=volume.GetAttribute('extent'), times=[1, 2]") == (
        0,
        [("FLT001", "/a", "seen", (1, 2)), ("FLT001", "/b", "seen", (1, 2))],
    )


@pytest.mark.parametrize("problem", ["5, at=volume", "'seen', at=volume, suggestion=5"])
def test_what_is_no_text_is_a_fault_of_the_rule(problem: str, tmp_path: Path) -> None:
    said = (
        "rule FLT001 (faulty) failed here: TypeError: message and suggestion of a problem are text"
    )
    assert findings(tmp_path, problem) == (
        2,
        [("LNT002", "/a", said, ()), ("LNT002", "/b", said, ())],
    )


def test_a_problem_that_can_not_say_whether_it_holds_is_reported_and_so_is_that(
    tmp_path: Path,
) -> None:
    said = "rule FLT001 (faulty) failed here: ZeroDivisionError: division by zero"
    code, found = findings(tmp_path, "'seen', at=volume, holds=lambda: 1 / 0")
    assert (code, sorted(found)) == (
        2,
        [
            ("FLT001", "/a", "seen", ()),
            ("FLT001", "/b", "seen", ()),
            ("LNT002", "/a", said, ()),
            ("LNT002", "/b", said, ()),
        ],
    )


def test_a_precondition_that_is_none(tmp_path: Path) -> None:
    rule = RULE.format(problem="'seen', at=volume").replace(
        'on="Volume"', 'on="Volume", when="authored"'
    )
    (tmp_path / "faulty.py").write_text(rule, encoding="utf-8")
    with pytest.raises(PackError, match="FLT001: `when` takes a When, not 'authored'"):
        load([str(tmp_path)])
