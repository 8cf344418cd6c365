"""Baselines as files: what stands in them, and how they are written."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from runs import INFO, WARNING, cause, held, report, states, using, written

from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.baseline.reading import read_baseline
from usdvol_lint.baseline.use import Use, prepare
from usdvol_lint.model import Source, UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE
from usdvol_lint.results import State


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
