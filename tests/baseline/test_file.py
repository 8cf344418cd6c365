"""Baselines as files: what stands in them, and every way in which one is none."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from runs import INFO, WARNING, cause, held, report, states, using, written

from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.baseline.reading import read_baseline
from usdvol_lint.baseline.use import Use, prepare
from usdvol_lint.model import Source, UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE
from usdvol_lint.results import State

HERE = Path(__file__).parent


def said(file: Path, call: Callable[[Path], object] = using) -> str:
    """What is said of a file that can't be used, without the folder that it is in."""
    with pytest.raises(UsageError) as caught:
        call(file)
    words = str(caught.value)
    for folder in (str(file.parent), file.parent.resolve().as_posix()):
        words = words.replace(f"{folder}{os.sep}", "").replace(f"{folder}/", "")
    assert "\n" not in words
    return words


def test_fingerprints_stay() -> None:
    """Another way to make them would make every baseline worthless."""
    source = Source("assets/a.usda", "/A{look=thin}B", "filePath", "density")
    assert fingerprint("AST002", source) == "35c027f76e2fea5f"
    assert fingerprint("LNT004", Source(None)) == fingerprint(
        "LNT004", Source(None, None, None, "")
    )
    assert fingerprint("AST002", Source("\udcff")) != fingerprint("AST002", Source("\udcfe"))
    fields = [source._replace(**{name: "x"}) for name in source._fields]
    marks = {fingerprint("AST002", each) for each in (source, *fields)}
    assert len(marks | {fingerprint("AST001", source)}) == 6


def test_a_baseline_is_readable_and_sorted(tmp_path: Path) -> None:
    shots = tmp_path / "shots"
    shots.mkdir()
    (tmp_path / "lint").mkdir()
    causes = [
        cause("assets/a.usda", "/A", frames=(3.0, 7.0, 8.0), share=0.3, elements=10),
        cause("assets/Wölkchen.usda", "/W", name=None, subject="a\u202eb\U000e0001"),
        cause("bad\udcff.usda", "/W", name=None, at_default=True, severity=WARNING),
        cause(None, None, code="LNT004", name=None, severity=WARNING),
    ]
    file = written(tmp_path, *causes, name="lint/b.jsonl", arguments=["shots", "shots/s1", "a"])
    data = file.read_bytes()
    assert data.endswith(b"}\n")
    assert b"\r" not in data
    first, *entries = data.decode("utf-8").splitlines()
    assert [line[:16] for line in entries] == ['{"fingerprint":"'] * 4
    assert entries == sorted(entries)
    assert json.loads(first) == {
        "usdvol_lint_baseline": 1,
        "fingerprint_version": 1,
        "tool": json.loads(first)["tool"],
        "root": "..",
        "arguments": ["a", "shots"],
        "settings": {
            "rules": {"AST001": "error", "AST002": "error", "LNT001": "error", "LNT002": "error"},
            "load": "all",
            "content": "all",
            "times": "all",
            "variants": "selected",
            "variant_limit": 100,
        },
    }
    by_layer = {json.loads(line)["layer"]: line for line in entries}
    assert by_layer["assets/a.usda"].partition(",")[2] == (
        '"code":"AST002","layer":"assets/a.usda","path":"/A","property":"filePath",'
        '"cover":{"frames":"3, 7-8","default":false,"share":"half","level":"error"}}'
    )
    assert '"assets/Wölkchen.usda"' in data.decode("utf-8")
    assert '"subject":"a\\u202eb\\udb40\\udc01"' in data.decode("utf-8")
    assert '"bad\\udcff.usda"' in data.decode("utf-8")
    assert '"layer":null,"path":null,"cover"' in by_layer[None]

    again = written(tmp_path, *reversed(causes), name="lint/b.jsonl", arguments=["a", "shots"])
    assert again.read_bytes() == data
    baseline = read_baseline(str(file))
    assert baseline.root == tmp_path.resolve().as_posix()
    assert {entry.source for entry in baseline.entries.values()} == {each.source for each in causes}


def test_what_a_baseline_holds(tmp_path: Path) -> None:
    causes = [
        cause(prim="/Error"),
        cause(prim="/Warning", severity=WARNING),
        cause(prim="/Info", severity=INFO),
        cause(prim="/Ignored", state=State.SUPPRESSED),
        cause("anon:0x7f:x.usda", "/Anonymous"),
    ]
    shown = ["AST002 assets/a.usda </Error.filePath>", "AST002 assets/a.usda </Warning.filePath>"]
    assert held(written(tmp_path, *causes)) == shown
    info = "AST002 assets/a.usda </Info.filePath>"
    assert held(written(tmp_path, *causes, fail_on="info")) == sorted([*shown, info])
    assert {"LNT001", "LNT002"} == NOT_IGNORABLE


def test_what_makes_a_run_fail_is_named_and_the_rest_is_written(tmp_path: Path) -> None:
    file = tmp_path / "b.jsonl"
    unread = cause("s0.usda", None, code="LNT001", name=None)
    applied = prepare(Use(write=str(file))).apply(report(tmp_path, cause(), unread))
    assert applied.failure.replace(str(file), "b.jsonl") == (
        "b.jsonl is written, but it can't hold s0.usda (LNT001): "
        "mend it, or check the others without it"
    )
    assert held(file) == ["AST002 assets/a.usda </A.filePath>"]
    assert states(applied.report) == ["known", "new"]


def test_a_full_disk_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = written(tmp_path, cause())
    before = file.read_bytes()

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    new = cause(prim="/B")
    applied = using(file, write=str(file)).apply(report(tmp_path, cause(), new))
    assert applied.failure.replace(str(file), "b.jsonl") == (
        "--write-baseline b.jsonl: No space left on device; what was there is as it was"
    )
    assert file.read_bytes() == before
    assert states(applied.report) == ["known", "new"]
    assert applied.report.baseline
    assert not applied.report.baseline.written
    assert [path.name for path in tmp_path.iterdir()] == ["b.jsonl"]


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_link_stays_one_and_the_root_is_that_of_its_target(tmp_path: Path) -> None:
    (tmp_path / "lint").mkdir()
    link = tmp_path / "lint" / "link.jsonl"
    link.symlink_to(tmp_path / "b.jsonl")
    written(tmp_path, cause(), name="lint/link.jsonl")
    assert link.is_symlink()
    assert '"root":"."' in (tmp_path / "b.jsonl").read_text("utf-8")
    assert using(link).root == tmp_path.resolve().as_posix()


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("gone/b.jsonl", "--write-baseline gone/b.jsonl: there is no folder gone"),
        (".", "--write-baseline .: this is no file, name one"),
    ],
)
def test_where_none_can_be_written(
    name: str, expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UsageError) as caught:
        prepare(Use(write=name))
    assert str(caught.value) == expected


def edited(change: Callable[[list[str]], object]) -> Callable[[Path], None]:
    """Changes the lines of a file."""

    def edit(file: Path) -> None:
        lines = file.read_text("utf-8").splitlines()
        change(lines)
        file.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8", newline="\n")

    return edit


def replaced(old: str, new: str, line: int = 1) -> Callable[[Path], None]:
    def change(lines: list[str]) -> None:
        assert old in lines[line]
        lines[line] = lines[line].replace(old, new)

    return edited(change)


def as_bytes(data: bytes) -> Callable[[Path], object]:
    return lambda file: file.write_bytes(data)


ANEW = "write the baseline anew"
BAD = {
    "not there": (
        Path.unlink,
        "b.jsonl: there is no such baseline; --write-baseline b.jsonl writes one",
    ),
    "empty": (as_bytes(b""), "b.jsonl:1: no baseline, there is nothing in it"),
    "a stage": (
        as_bytes(b"#usda 1.0\n"),
        "b.jsonl:1: no JSON, as a baseline is: Expecting value (column 1)",
    ),
    "a list": (as_bytes(b"[1]\n"), "b.jsonl:1: no entry of a baseline: it must be an object"),
    "UTF-16": (
        lambda file: file.write_bytes(file.read_text("utf-8").encode("utf-16")),
        "b.jsonl:1: no UTF-8 text",
    ),
    "Latin-1": (
        lambda file: file.write_bytes(file.read_bytes() + "ö".encode("latin-1")),
        "b.jsonl:4: no UTF-8 text",
    ),
    "nested": (
        as_bytes(b"[" * 100_000),
        "b.jsonl:1: no JSON, as a baseline is: nested too deep; "
        "cut off, as the last line is not whole",
    ),
    "cut off": (
        lambda file: file.write_bytes(file.read_bytes()[:-30]),
        "b.jsonl:3: no JSON, as a baseline is: Unterminated string starting at (column 149); "
        "cut off, as the last line is not whole",
    ),
    "no first line": (
        edited(lambda lines: lines.pop(0)),
        f"b.jsonl:1: no line above says what the run was: {ANEW}",
    ),
    "two first lines": (
        edited(lambda lines: lines.insert(1, lines[0].replace('"."', '".."'))),
        "b.jsonl:2: a second first line, which differs from the first: "
        "keep that of the run that looked at more",
    ),
    "a conflict": (
        edited(lambda lines: lines.insert(2, "<<<<<<< HEAD")),
        "b.jsonl:3: a conflict of a merge, '<<<<<<< HEAD': "
        "keep the entries of both sides, and one first line",
    ),
    "the end of a conflict": (
        edited(lambda lines: lines.append(">>>>>>> other")),
        "b.jsonl:4: a conflict of a merge, '>>>>>>> other': "
        "keep the entries of both sides, and one first line",
    ),
    "another format": (
        replaced('"usdvol_lint_baseline":1', '"usdvol_lint_baseline":2', 0),
        f"b.jsonl:1: a baseline of format 2, this version reads 1: {ANEW}",
    ),
    "a format that is no number": (
        replaced('"usdvol_lint_baseline":1', '"usdvol_lint_baseline":true', 0),
        f"b.jsonl:1: a baseline of format True, this version reads 1: {ANEW}",
    ),
    "other fingerprints": (
        replaced('"fingerprint_version":1', '"fingerprint_version":2', 0),
        f"b.jsonl:1: fingerprints of version 2, this version reads 1: {ANEW}",
    ),
    "a root that is none": (
        replaced('"root":"."', '"root":3', 0),
        "b.jsonl:1: 'root' must be text, not 3",
    ),
    "a root that is gone": (
        replaced('"root":"."', '"root":"gone"', 0),
        "b.jsonl:1: its root is 'gone', and there is no such folder",
    ),
    "arguments": (
        replaced('"arguments":["."]', '"arguments":[3]', 0),
        "b.jsonl:1: 'arguments' must be a list of texts",
    ),
    "no settings": (
        replaced('"settings":', '"sett":', 0),
        "b.jsonl:1: 'settings' must be an object, and is not there",
    ),
    "rules": (
        replaced('"AST001":"error"', '"AST001":3', 0),
        "b.jsonl:1: 'rules' must be levels by code, 'variant_limit' a number",
    ),
    "a setting": (
        replaced('"content":"all"', '"content":"some"', 0),
        "b.jsonl:1: 'content' must be one of all, first, off, not 'some'",
    ),
    "times": (
        replaced('"times":"all"', '"times":1.5', 0),
        "b.jsonl:1: 'times' must be text, not 1.5",
    ),
    "an entry without a code": (
        replaced('"code"', '"cod"'),
        "b.jsonl:2: 'code' must be text, and is not there",
    ),
    "a fingerprint that is none": (
        edited(lambda lines: lines.append('{"code":"AST002","fingerprint":3}')),
        "b.jsonl:4: 'fingerprint' must be text, not 3",
    ),
    "a layer that is none": (
        replaced('"assets/a.usda"', "[]"),
        "b.jsonl:2: 'layer' must be text, not []",
    ),
    "a cover that is none": (
        replaced('"frames":"all"', '"frames":"3-"'),
        "b.jsonl:2: cover: 'frames' must be ranges such as '3, 7-9', or 'all', not '3-'",
    ),
    "another layer": (
        replaced('"assets/a.usda"', '"lib/a.usda"', 2),
        "b.jsonl:3: the fingerprint is not that of this code, layer, path, property and subject; "
        "--moved OLD=NEW renames layers",
    ),
    "what can't be held": (
        replaced("AST002", "LNT001"),
        "b.jsonl:2: LNT001 can't be in a baseline: take the line out",
    ),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_file_that_is_no_baseline(kind: str, tmp_path: Path) -> None:
    spoil, expected = BAD[kind]
    file = written(tmp_path, cause(prim="/A"), cause(prim="/B"))
    spoil(file)  # type: ignore[operator]
    assert said(file) == expected


def test_a_folder_is_no_baseline(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=": no baseline: "):
        using(tmp_path)


def test_what_merges_and_editors_leave_is_read(tmp_path: Path) -> None:
    """A line twice, equal first lines, fields of later versions, a mark of the byte order."""
    file = written(tmp_path, cause(frames=(3.0,)), cause(prim="/B"))
    first, *entries = file.read_text("utf-8").splitlines()
    wider = written(tmp_path, cause(frames=(7.0, 8.0)), name="other").read_text("utf-8")
    lines = [first, *entries, first, "", *wider.splitlines()[1:], entries[0][:-1] + ',"new":[1]}']
    file.write_bytes(("\ufeff" + "\r\n".join(lines)).encode("utf-8"))
    assert len(held(file)) == 2
    now = report(tmp_path, cause(frames=(3.0, 7.0)), cause(frames=(3.0, 4.0), prim="/B"))
    assert states(using(file).apply(now).report) == ["known", "known"]


def test_another_root_is_named(tmp_path: Path) -> None:
    file = written(tmp_path, cause())
    prepared = using(file)
    prepared.check_root(tmp_path.resolve().as_posix())
    with pytest.raises(UsageError) as caught:
        prepared.check_root("/other")
    ours = tmp_path.resolve().as_posix()
    assert str(caught.value) == (
        f"{file}: its layers go by '{ours}', and the root of this run is '/other': "
        "leave out --root, or write it anew"
    )


def test_a_baseline_needs_a_root(tmp_path: Path) -> None:
    with pytest.raises(UsageError) as caught:
        prepare(Use(write=str(tmp_path / "b.jsonl"))).check_root(None)
    assert str(caught.value).partition(": ")[2] == (
        'there is no root that layers go by: set `root = "."` in a usdvol-lint.toml, '
        "or --root FOLDER"
    )


# --- reports --------------------------------------------------------------------------------------


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
