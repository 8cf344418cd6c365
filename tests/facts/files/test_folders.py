"""What is in folders: kept from stage to stage, and never for longer than it holds."""

from __future__ import annotations

import os
from pathlib import Path
from zipfile import ZipFile

import pytest
from stages import said, volume, write

import usdvol_lint.facts.files.folders as module
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.folders import Folders

LONG_AGO = 1_000_000_000


@pytest.fixture
def listed(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The folders that were listed."""
    found: list[str] = []
    names_listed = module.names_listed
    monkeypatch.setattr(
        module, "names_listed", lambda folder: found.append(folder) or names_listed(folder)
    )
    return found


def settle(path: Path, seconds: int = LONG_AGO) -> str:
    """Makes believe that a folder was last changed long ago."""
    os.utime(path, (seconds, seconds))
    return str(path)


def test_a_folder_is_listed_once_for_all_stages(tmp_path: Path, listed: list[str]) -> None:
    write(tmp_path, "a.vdb")
    folders, folder = Folders(), settle(tmp_path)
    for _ in range(3):
        assert Disk(folders).listing(folder).names == ("a.vdb",)
    assert listed == [folder]


def test_a_folder_that_has_changed_is_listed_again(tmp_path: Path, listed: list[str]) -> None:
    write(tmp_path, "a.vdb")
    folders, folder = Folders(), settle(tmp_path)
    disk = Disk(folders)
    assert disk.listing(folder).names == ("a.vdb",)
    write(tmp_path, "b.vdb")
    settle(tmp_path, LONG_AGO + 1)
    assert Disk(folders).listing(folder).names == ("a.vdb", "b.vdb")
    assert disk.listing(folder).names == ("a.vdb",)  # a stage has one answer
    assert len(listed) == 2


def test_a_folder_that_may_change_unseen_is_listed_again(tmp_path: Path) -> None:
    """Its time of change is that of now, and may be so once more."""
    folders = Folders()
    write(tmp_path, "a.vdb")
    now = os.stat(tmp_path)
    assert folders.listing(str(tmp_path)).names == ("a.vdb",)
    write(tmp_path, "b.vdb")
    os.utime(tmp_path, ns=(now.st_atime_ns, now.st_mtime_ns))
    assert folders.listing(str(tmp_path)).names == ("a.vdb", "b.vdb")


def test_a_folder_that_is_not_there_may_come(tmp_path: Path) -> None:
    folders = Folders()
    assert folders.listing(f"{tmp_path}/a").names == ()
    write(tmp_path, "a/b.vdb")
    settle(tmp_path / "a")
    assert folders.listing(f"{tmp_path}/a").names == ("b.vdb",)
    (tmp_path / "a" / "b.vdb").unlink()
    (tmp_path / "a").rmdir()
    assert folders.listing(f"{tmp_path}/a").names == ()


def test_a_package_that_is_replaced_is_read_again(tmp_path: Path) -> None:
    folders, package = Folders(), tmp_path / "shot.usdz"
    for name in ("a.vdb", "longer.vdb"):
        with ZipFile(package, "w") as archive:
            archive.writestr(name, b"")
        assert folders.listing(settle(package)).names == (name,)


def test_what_is_kept_has_an_end(
    tmp_path: Path, listed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_NAMES_KEPT", 5)
    write(tmp_path, *(f"{folder}/{number}" for folder in "abc" for number in (1, 2)))
    folders = Folders()
    a, b, c = (settle(tmp_path / folder) for folder in "abc")
    for folder in (a, b, c, c, b, a, c):
        assert folders.listing(folder).names == ("1", "2")
    assert listed == [a, b, c, a]


def test_a_search_is_made_once_for_all_stages(tmp_path: Path) -> None:
    write(tmp_path, "moved/0.vdb", "other/1.vdb")
    settle(tmp_path)
    folders = Folders()
    for _ in range(3):
        assert Disk(folders).siblings_with(f"{tmp_path}/a", "/0.vdb") == ["moved"]
    searched = folders.listing(str(tmp_path)).with_file["/0.vdb"]
    assert folders.with_file(str(tmp_path), "/0.vdb") is searched


def test_a_second_lint_sees_what_the_disk_holds_by_then(
    engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "stage.usda").write_text(volume("asset filePath = @./vdb/clod.vdb@"))
    write(tmp_path, "vdb/cloud.vdb")
    similar = "AST002 no file at './vdb/clod.vdb' -> did you mean './vdb/cloud.vdb'?"
    for second in (0, 1):
        settle(tmp_path / "vdb", LONG_AGO + second)
        assert said(engine.lint("stage.usda")) == [similar]
    (tmp_path / "vdb" / "cloud.vdb").rename(tmp_path / "vdb" / "smoke.vdb")
    assert said(engine.lint("stage.usda")) == [
        "AST002 no file at './vdb/clod.vdb' -> write or copy it there, or name a file that is there"
    ]
    write(tmp_path, "vdb/clod.vdb")
    assert said(engine.lint("stage.usda")) == []


@pytest.mark.parametrize(("flag", "names"), [(0, ("a.vdb", "\u0192.vdb")), (0x800, ())])
def test_a_package_with_a_name_that_is_no_text(
    flag: int, names: tuple[str, ...], tmp_path: Path
) -> None:
    """It is read as that of an old archive, unless that calls it UTF-8: then there are none."""
    with ZipFile(tmp_path / "shot.usdz", "w") as archive:
        archive.writestr("a.vdb", b"")
        archive.writestr("~.vdb", b"")
    content = (tmp_path / "shot.usdz").read_bytes().replace(b"~.vdb", b"\x9f.vdb")
    entry = content.rindex(b"PK\1\2")
    content = content[: entry + 8] + flag.to_bytes(2, "little") + content[entry + 10 :]
    (tmp_path / "shot.usdz").write_bytes(content)
    assert Folders().listing(str(tmp_path / "shot.usdz")).names == names
