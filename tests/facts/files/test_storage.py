"""Files that are elsewhere on this machine, or that it does not have."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from fieldtexts import sampled, write
from pxr import Ar
from stages import volume

from usdvol_lint.config import Config, Depth, Storage
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.files.storage import Whereabouts, mapped
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

Lint = Callable[[Storage, str], StageReport]


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    """What is found of a field with a path, where files are so stored."""
    monkeypatch.chdir(tmp_path)

    def call(storage: Storage, path: str) -> StageReport:
        text = volume(f"asset filePath = @{path}@")
        (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
        active = activate(Config(ignore=("VOL", "GRD", "AST007")), catalog)
        return Engine(catalog.rules, active, Depth(storage=storage)).lint("stage.usda")

    return call


def codes(report: StageReport) -> list[str]:
    return [f"{each.code} {each.severity.label}" for each in report.findings]


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("P:/show/a.vdb", "/mnt/show/a.vdb"),
        ("p:\\show\\a.vdb", "/mnt/show/a.vdb"),
        ("P:/show", "/mnt/show/"),
        ("P:/shows/a.vdb", "/p/shows/a.vdb"),
        ("/srv/a.vdb", "/mnt/srv/a.vdb"),
        ("/srvs/a.vdb", None),
        ("/srv/../other/a.vdb", None),
        ("P:/shows/../show/a.vdb", "/mnt/show/a.vdb"),
        ("./P:/a.vdb", None),
    ],
)
def test_the_longest_beginning_counts(path: str, expected: str | None) -> None:
    by_start = {"P:/": "/p", "P:/show": "/mnt/show/", "/srv": "/mnt/srv"}
    assert mapped(path, by_start) == expected


@pytest.mark.parametrize(
    ("pattern", "path", "is_meant"),
    [
        ("/mnt/show/**", "/mnt/show/a/b.vdb", True),
        ("/mnt/show/**", "/srv/mnt/show/b.vdb", False),
        ("P:/**", "P:/a.vdb", True),
        ("P:/**", "p:\\a.vdb", True),
        ("//server/share/**", "\\\\server\\share\\a.vdb", True),
        ("*.vdb", "/a/b.vdb", True),
        ("*.nvdb", "/a/b.vdb", False),
        ("/mnt/show/**", "/mnt/show/../other/b.vdb", False),
        ("/mnt/show/**", "/mnt/other/../show/./b.vdb", True),
        ("P:/show/**", "P:\\show\\..\\other\\b.vdb", False),
        ("P:/other/**", "P:\\show\\..\\other\\b.vdb", True),
        ("asset://show/**", "asset://show/a/../b.vdb", True),
    ],
)
def test_patterns_of_files_that_are_assumed(pattern: str, path: str, is_meant: bool) -> None:
    whereabouts = Whereabouts(Storage(assume_present=(pattern,)))
    assert whereabouts.is_assumed(path, path) is is_meant
    assert len(whereabouts.assumed) == is_meant


@pytest.mark.parametrize("path", ["P:/x/cloud.vdb", "/mnt/show/cloud.vdb"])
def test_what_is_assumed_is_counted_and_not_missing(path: str, lint: Lint) -> None:
    assert codes(lint(Storage(), path))[-1].endswith("error")
    report = lint(Storage(assume_present=("/mnt/show/**", "P:/**")), path)
    assert (codes(report), report.stats["files_assumed"]) == ([], 1)
    assert report.stats["files_checked"] == 0


def test_what_is_assumed_is_not_opened_either(lint: Lint, tmp_path: Path) -> None:
    (tmp_path / "cloud.vdb").touch()
    assert codes(lint(Storage(), "./cloud.vdb")) == ["AST005 error"]
    here = f"{tmp_path.as_posix()}/**"
    assert codes(lint(Storage(assume_present=(here,)), "./cloud.vdb")) == []


def test_where_a_path_really_is(lint: Lint, tmp_path: Path) -> None:
    write(tmp_path, "share/cloud.vdb")
    storage = Storage(path_map={"P:/": str(tmp_path / "share")})
    report = lint(storage, "P:/cloud.vdb")
    assert (codes(report), report.stats["files_checked"]) == ([], 1)
    assert "files_assumed" not in report.stats


@pytest.mark.parametrize("start", ["P:/x/", "/mnt/show/", "asset://show/"])
def test_what_is_missing_is_told_of_where_it_was_looked_for(
    start: str, lint: Lint, tmp_path: Path
) -> None:
    write(tmp_path, "seq/s.1003.vdb", "seq/cloud.vdb")
    seq = (tmp_path / "seq").as_posix()
    storage = Storage(path_map={start: f"{seq}/"})
    (finding,) = lint(storage, f"{start}s.1004.vdb").findings
    assert (finding.code, finding.message) == (
        "AST002",
        f"no file at '{start}s.1004.vdb' in '{seq}'",
    )
    single = Storage(path_map={f"{start}fog.vdb": f"{seq}/mist.vdb"})
    (finding,) = lint(single, f"{start}fog.vdb").findings
    assert finding.message == f"no file at '{start}fog.vdb', which is '{seq}/mist.vdb' here"
    (finding,) = lint(storage, f"{start}fx/s.1004.vdb").findings
    assert finding.message == f"no file at '{start}fx/s.1004.vdb': no folder '{seq}/fx'"
    (finding,) = lint(storage, f"{start}clod.vdb").findings
    assert finding.suggestion == f"did you mean '{start}cloud.vdb'?"
    (finding,) = lint(storage, f"{start}s.####.vdb").findings
    assert finding.code == "AST003"
    (finding,) = lint(storage, f"{start}Cloud.vdb").findings
    assert (finding.code, finding.suggestion) == ("AST009", f"write it as '{start}cloud.vdb'")


def test_what_is_mapped_may_be_assumed(lint: Lint) -> None:
    storage = Storage(path_map={"P:/": "/mnt/show"}, assume_present=("/mnt/show/**",))
    report = lint(storage, "P:/x/cloud.vdb")
    assert (codes(report), report.stats["files_assumed"]) == ([], 1)


def test_what_is_relative_is_assumed_where_it_leads(lint: Lint, tmp_path: Path) -> None:
    def assumed(pattern: str, path: str) -> int:
        return lint(Storage(assume_present=(pattern,)), path).stats.get("files_assumed", 0)

    here = tmp_path.as_posix()
    assert assumed(f"{here}/b/**", "./a/../b/cloud.vdb") == 1
    assert assumed(f"{here}/a/**", "./a/../b/cloud.vdb") == 0
    assert assumed("/b/**", "b/cloud.vdb") == 0


def test_where_usd_searches(lint: Lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, "library/sub/cloud.vdb", "more/sub/fog.vdb")
    monkeypatch.setenv("PXR_AR_DEFAULT_SEARCH_PATH", str(tmp_path / "more"))
    try:
        storage = Storage(search_path=("library",))
        assert codes(lint(Storage(), "sub/cloud.vdb")) == ["AST002 error"]
        assert codes(lint(storage, "sub/cloud.vdb")) == []
        assert codes(lint(storage, "sub/fog.vdb")) == []
    finally:
        Ar.DefaultResolver.SetDefaultSearchPath([])


def test_frames_that_are_missing_elsewhere(
    catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether a file is there is asked where it is, or not at all."""
    monkeypatch.chdir(tmp_path)
    write(tmp_path, *(f"share/a.{number:04}.vdb" for number in range(1, 9)))
    there = [1, 2, 3, 4, 6, 7, 8]
    text = sampled((number, f"P:/a.{number:04}.vdb") for number in there)
    (tmp_path / "stage.usda").write_text(text, encoding="utf-8")

    def advice(storage: Storage) -> list[str | None]:
        active = activate(Config(select=("AST011",)), catalog)
        report = Engine(catalog.rules, active, Depth(storage=storage)).lint("stage.usda")
        return [each.suggestion for each in report.findings]

    mapped_there = Storage(path_map={"P:/": str(tmp_path / "share")})
    assert advice(mapped_there) == ["add 5: @P:/a.0005.vdb@ (the file is there)"]
    assumed = Storage(assume_present=("P:/**",))
    assert advice(assumed) == ["add the samples, or write the frames that are missing"]


def test_a_layer_that_is_assumed_was_not_checked(
    catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = '#usda 1.0\ndef Volume "smoke" (references = @/mnt/show/smoke.usda@) {\n}\n'
    (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
    active = activate(Config(select=("STG", "LNT")), catalog)
    depth = Depth(storage=Storage(assume_present=("/mnt/show/**",)))
    report = Engine(catalog.rules, active, depth).lint("stage.usda")
    (finding,) = (each for each in report.findings if "smoke.usda" in each.message)
    assert (finding.code, finding.severity.label) == ("LNT005", "info")
    assert finding.message == (
        "the reference '/mnt/show/smoke.usda' is assumed present; what it holds was not checked"
    )
    assert report.stats["files_assumed"] == 1
