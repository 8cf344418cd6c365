"""What a path that leads to no file may have meant, and where that is looked for."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from zipfile import ZipFile

import pytest
from stages import findings, volume, write

from usdvol_lint.facts.files.corrections import Absence, find_absence, missing_folder
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.folders import Folders
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("./clod.vdb", Absence("", "./cloud.vdb")),
        ("clod.vdb", Absence("", "cloud.vdb")),
        ("./CLOUD.vdb", Absence("", "./cloud.vdb")),
        ("./nothing.vdb", Absence("", None)),
        ("./smok/smoke.0001.vdb", Absence(": no folder './smok'", "./smoke/smoke.0001.vdb")),
        ("./smok/smoke.0009.vdb", Absence(": no folder './smok'", "./smoke")),
        ("./smoke/v2/smoke.0001.vdb", Absence(": no folder './smoke/v2'", None)),
        ("./x/y/smoke.vdb", Absence(": no folder './x'", None)),
        ("./smoke/smoke.1.vdb", Absence("", "./smoke/smoke.0001.vdb")),
        ("./smoke/smok.0002.vdb", Absence("", "./smoke/smoke.0002.vdb")),
        ("./smoke/smoke.0004.vdb", Absence("", None)),
        ("./smoke/../clod.vdb", Absence("", "./smoke/../cloud.vdb")),
        ("./clod.vdb:SDF_FORMAT_ARGS:a=b", Absence("", "./cloud.vdb")),
    ],
)
def test_what_a_missing_path_may_have_meant(path: str, expected: Absence, tmp_path: Path) -> None:
    """Another frame is another file, never a misspelling."""
    write(tmp_path, "cloud.vdb", *(f"smoke/smoke.{frame:04}.vdb" for frame in (1, 2, 3)))
    absolute = os.path.normpath(tmp_path / path.partition(":")[0])
    assert find_absence(Disk(), absolute, path) == expected


@pytest.mark.parametrize(
    ("path", "similar"),
    [
        ("./cahce/cloud.vdb", "./cache/cloud.vdb"),
        ("./cahce/gone.vdb", "./cache"),
        ("./cache_v2/smoke.0001.vdb", "./cache_v1/smoke.0001.vdb"),
        ("./cache_v2/smoke.0002.vdb", None),
        ("./fx/sim/fire.vdb", "./effects/sim/fire.vdb"),
        ("./cache/fire.vdb", "./sparks/fire.vdb"),
        ("./cache/smoke.0001.vdb", None),
        ("./sparkl/fire.vdb", "./sparks/fire.vdb"),
        ("./effects/sin/fire.vdb", "./effects/sim/fire.vdb"),
        ("./cahce_v1/smoke.0001.vdb", "./cache_v1/smoke.0001.vdb"),
    ],
)
def test_a_file_that_lies_in_a_sibling_folder(
    path: str, similar: str | None, tmp_path: Path
) -> None:
    files = ("cache/cloud.vdb", "cache_v1/smoke.0001.vdb", "effects/sim/fire.vdb")
    write(
        tmp_path, *files, "sparks/fire.vdb", "sparks/both.vdb", "cache_v1/both.vdb", "sparkle/a.vdb"
    )
    found = find_absence(Disk(), os.path.normpath(tmp_path / path), path)
    assert (found.similar, found.elsewhere) == (similar, ())


@pytest.mark.parametrize(
    ("path", "elsewhere"),
    [
        (
            "./cache_v2/a.vdb",
            "'./cache_v10/a.vdb', './cache_v3/a.vdb', './cache_v1/a.vdb' and 1 more",
        ),
        (
            "./old/a.vdb",
            "'./old_caches_of_wednesday/a.vdb', './cache_v10/a.vdb', './cache_v3/a.vdb' and 1 more",
        ),
        ("./sparkle/b.vdb", "'./sparks/b.vdb', './cache_v10/b.vdb'"),
        ("./sparkk/b.vdb", "'./sparks/b.vdb', './cache_v10/b.vdb'"),
        (
            "./cache_v3/../cache_v2/b.vdb",
            "'./cache_v3/../cache_v10/b.vdb', './cache_v3/../sparks/b.vdb'",
        ),
        ("./gone/shot.usdz[c.vdb]", "'./cache_v3/shot.usdz[c.vdb]', './cache_v1/shot.usdz[c.vdb]'"),
    ],
)
def test_a_file_that_lies_in_several_sibling_folders(
    path: str, elsewhere: str, tmp_path: Path
) -> None:
    folders = ("cache_v1", "cache_v3", "cache_v10", "old_caches_of_wednesday")
    write(tmp_path, *(f"{folder}/a.vdb" for folder in folders))
    write(tmp_path, "sparks/b.vdb", "cache_v10/b.vdb", "sparkle/c.vdb")
    write(tmp_path, "cache_v1/shot.usdz", "cache_v3/shot.usdz")
    found = find_absence(Disk(), os.path.normpath(tmp_path / path), path)
    assert found.advice == f"there are files of that name at {elsewhere}"


@pytest.mark.parametrize("path", ["./gone.vdb", "./gone/a.vdb"])
def test_fields_below_one_missing_folder_are_told_in_one_line(
    path: str, lint_text: Lint, tmp_path: Path
) -> None:
    """A file that they name has to be written for each: these are told one by one."""
    one = volume(f"asset filePath = @{path}@")
    found = findings(lint_text(one + one.replace("cloud", "second")))
    fold = f"{tmp_path}/gone" if "/a" in path else None
    assert [(each.code, each.site.prim, each.fold) for each in found] == [
        ("AST002", "/cloud/density", fold),
        ("AST002", "/second/density", fold),
    ]


def test_a_field_whose_files_are_missing_in_two_folders_is_told_by_itself(
    lint_text: Lint, tmp_path: Path
) -> None:
    one = volume("asset filePath = @./gone/a.vdb@")
    two = volume("asset filePath.timeSamples = { 1: @./gone/a.vdb@, 2: @./lost/a.vdb@ }")
    found = findings(lint_text(one + two.replace("cloud", "second")))
    assert [each.code for each in found] == ["AST002", "AST002"]
    assert (found[0].fold, found[1].fold == found[0].fold) == (f"{tmp_path}/gone", False)


def test_what_lies_beside_the_folder_of_a_layer_is_another_asset(tmp_path: Path) -> None:
    write(tmp_path, "a/cloud.vdb", "b/other.vdb")
    assert find_absence(Disk(), f"{tmp_path}/b/cloud.vdb", "./cloud.vdb") == Absence("", None)


def test_a_moved_cache_is_looked_for_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, *(f"{folder}/{file}.vdb" for folder in "abcd" for file in range(9)))
    (tmp_path / "a").rename(tmp_path / "moved")
    for folder in "bcd":
        (tmp_path / folder / "0.vdb").unlink()
    asked: list[str] = []
    is_file = os.path.isfile
    monkeypatch.setattr(os.path, "isfile", lambda path: asked.append(path) or is_file(path))
    disk = Disk()
    for file in range(9):
        assert disk.siblings_with(f"{tmp_path}/a", f"/{file}.vdb") == ["moved"]
    assert len(asked) < 2 * 9


def test_no_end_of_folders_is_searched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, "moved/0.vdb", "other/1.vdb")
    monkeypatch.setattr("usdvol_lint.facts.files.disk._NAMES_TRIED", 3)
    folders = Folders()
    for disk in (Disk(folders), Disk(folders)):  # of a stage each
        assert disk.siblings_with(f"{tmp_path}/a", "/0.vdb") == ["moved"]
        assert disk.siblings_with(f"{tmp_path}/b", "/1.vdb") == []
    assert Disk(folders).siblings_with(f"{tmp_path}/b", "/1.vdb") == ["other"]


def test_a_file_that_is_not_meant(tmp_path: Path) -> None:
    """A layer is not meant by what it names itself, also where only the case differs."""
    own = tmp_path / "shot.usda"
    own.touch()
    for name in ("Shot.usda", "shop.usda"):
        path = f"{tmp_path}/{name}"
        assert find_absence(Disk(), path, f"./{name}").similar == "./shot.usda"
        assert find_absence(Disk(), path, f"./{name}", [str(own)]) == Absence("", None)


def test_beside_a_package_is_no_folder_in_it(tmp_path: Path) -> None:
    with ZipFile(tmp_path / "shot.usdz", "w") as package:
        package.writestr("shot.usda", "#usda 1.0\n")
    path = f"{tmp_path}/shot.usdz[../smoke/a.vdb]"
    assert missing_folder(Disk(), path) is None
    assert find_absence(Disk(), path, "../smoke/a.vdb") == Absence(" in 'shot.usdz'", None)
