"""Files that are read as baselines: what merges and editors leave, and all that are none."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from runs import ANEW, cause, held, report, said, states, using, written

from usdvol_lint.model import UsageError


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
    "a root that is no path": (
        replaced('"root":"."', '"root":"a\\u0000b"', 0),
        "b.jsonl:1: its root is 'a\\x00b', which is no path",
    ),
    "a root that is half a character": (
        replaced('"root":"."', '"root":"\\ud800"', 0),
        "b.jsonl:1: its root is '\\ud800', which is no path",
    ),
    "a number of thousands of digits": (
        edited(lambda lines: lines.append('{"a":' + "9" * 5000 + "}")),
        "b.jsonl:4: no JSON, as a baseline is: a number of too many digits",
    ),
    "frames without end": (
        replaced('"frames":"all"', f'"frames":"{"0-999990," * 3000}"'),
        "b.jsonl:2: cover: 'frames' must be ranges such as '3, 7-9', or 'all', "
        f"not '{('0-999990,' * 7)[:59]}…",
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


def test_a_file_that_is_too_large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One of a stranger may be any file; and none is written that can't be read."""
    file = written(tmp_path, cause())
    size = file.stat().st_size
    monkeypatch.setattr("usdvol_lint.baseline.reading.MOST_BYTES", size)
    monkeypatch.setattr("usdvol_lint.baseline.file.MOST_BYTES", size)
    assert len(held(file)) == 1
    applied = using(file, write=str(file)).apply(report(tmp_path, cause(), cause(prim="/B")))
    most = f"has more than {size:,} bytes"
    assert applied.failure.endswith(f": no baseline {most}; what was there is as it was")
    assert file.stat().st_size == size
    file.write_bytes(file.read_bytes() + b"\n")
    assert said(file) == f"b.jsonl: no baseline: none {most}"


def test_many_frames_in_all_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("usdvol_lint.baseline.entry._MOST_FRAMES", 9)
    causes = [cause(prim=f"/A{last}", frames=tuple(map(float, range(last)))) for last in (4, 5, 6)]
    shared = [cause(prim=f"/B{number}", frames=(1.0, 2.0, 3.0)) for number in range(9)]
    assert len(held(written(tmp_path, *shared))) == 9
    assert said(written(tmp_path, *causes)) == (f"b.jsonl: more than 9 frames in all: {ANEW}")
