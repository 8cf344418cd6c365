"""Reports as baselines, and those that are none."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from runs import ANEW, INFO, cause, held, report, said, states, using

from usdvol_lint.results import State


def json_report(file: Path, **changes: Any) -> Path:
    """A report as `--output-format json` writes it, of one cause of each kind."""
    covered = {"frames": "3", "default": False, "share": None, "level": "error"}
    causes = [
        {
            "fingerprint": each.fingerprint,
            "code": each.code,
            "severity": each.severity.label,
            "state": str(each.state),
            "cover": covered,
            "source": {**each.source._asdict(), "line": None},
            "places": [],
        }
        for each in (
            cause(),
            cause(prim="/B", state=State.KNOWN),
            cause(prim="/C", severity=INFO),
            cause(prim="/D", state=State.SUPPRESSED),
            cause(prim=None, name=None, code="LNT001"),
        )
    ]
    made = report(file.parent)
    value = {
        "schema_version": "2.7",
        "fingerprint_version": 1,
        "root": "/elsewhere",
        "arguments": ["."],
        "settings": dict(made.settings),
        "causes": causes,
    }
    file.write_text(json.dumps(value | changes, indent=2), encoding="utf-8")
    return file


def test_a_report_is_a_baseline(tmp_path: Path) -> None:
    file = json_report(tmp_path / "r.json")
    assert held(file) == [
        "AST002 assets/a.usda </A.filePath>",
        "AST002 assets/a.usda </B.filePath>",
    ]
    assert using(file).root is None
    causes = [cause(frames=(3.0,)), cause(prim="/B", frames=(3.0, 4.0)), cause(prim="/C")]
    applied = using(file).apply(report(tmp_path, *causes))
    assert states(applied.report) == ["known", "worse", "new"]

    file.write_text(json.dumps(json.loads(file.read_text("utf-8"))), encoding="utf-8")
    assert len(held(file)) == 2, "in one line"
    assert said(file, lambda file: using(file, prune=True)) == (
        "--prune-baseline: r.json is a report: --write-baseline FILE makes a baseline of it"
    )
    copy = tmp_path / "b.jsonl"
    using(file, write=str(copy)).apply(report(tmp_path, cause(frames=(3.0,))))
    assert held(copy) == ["AST002 assets/a.usda </A.filePath>"]


def test_a_report_without_arguments_covers_nobody_knows_what(tmp_path: Path) -> None:
    file = json_report(tmp_path / "r.json")
    value = json.loads(file.read_text("utf-8"))
    del value["arguments"]
    file.write_text(json.dumps(value), encoding="utf-8")
    use = using(file).apply(report(tmp_path)).report.baseline
    assert use
    assert (use.gone, use.partial) == (None, "nothing says what the baseline was made of")


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        (
            {"schema_version": "1.0"},
            "r.json: a report of schema 2.x is a baseline too, not '1.0': write it anew",
        ),
        (
            {"schema_version": 2},
            "r.json: a report of schema 2.x is a baseline too, not 2: write it anew",
        ),
        (
            {"fingerprint_version": 7},
            f"r.json: fingerprints of version 7, this version reads 1: {ANEW}",
        ),
        ({"causes": {}}, "r.json: 'causes' must be a list, not {}"),
        ({"causes": [3]}, "r.json: causes[0] must be an object"),
        ({"settings": None}, "r.json: 'settings' must be an object, not None"),
        ({"root": []}, "r.json: 'root' must be text, not []"),
    ],
)
def test_a_report_that_is_none(changes: dict[str, Any], expected: str, tmp_path: Path) -> None:
    assert said(json_report(tmp_path / "r.json", **changes)) == expected


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("state", "odd", "r.json: causes[0]: 'state' or 'severity' is none that there is"),
        (
            "code",
            "AST003",
            "r.json: causes[0]: the fingerprint is not that of this code, layer, path, property "
            "and subject; --moved OLD=NEW renames layers",
        ),
        ("severity", "odd", "r.json: causes[0]: 'state' or 'severity' is none that there is"),
        ("source", 3, "r.json: causes[0]: 'source' must be an object, not 3"),
        (
            "cover",
            {},
            "r.json: causes[0]: cover: 'level' must be one of info, warning, error, not None",
        ),
    ],
)
def test_a_cause_that_is_none(key: str, value: Any, expected: str, tmp_path: Path) -> None:
    file = json_report(tmp_path / "r.json")
    causes = json.loads(file.read_text("utf-8"))["causes"]
    causes[0][key] = value
    assert said(json_report(file, causes=causes)) == expected


def test_a_report_that_is_cut_off(tmp_path: Path) -> None:
    file = json_report(tmp_path / "r.json")
    file.write_bytes(file.read_bytes()[:-100])
    words = said(file)
    assert words.startswith("r.json: no JSON: ")
    assert words.endswith("; is it cut off?")


def test_a_report_with_a_root_and_a_run_without(tmp_path: Path) -> None:
    file = json_report(tmp_path / "r.json")
    assert said(file, lambda file: using(file).check_root(None)) == (
        "r.json: was written with a root, this run has none"
    )
    json_report(file, root=None)
    assert said(file, lambda file: using(file).check_root("/x")) == (
        "r.json: was written with no root, this run has one"
    )
    using(file).check_root(None)
