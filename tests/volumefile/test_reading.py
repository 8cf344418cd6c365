"""Which reader a file gets, which files get none, and how little of a file is read."""

from __future__ import annotations

import os
import pickle
import zipfile
from contextlib import suppress
from pathlib import Path

import pytest
import vdbwriter as w
from attempts import refusal_of_file
from process import SAMPLES

from usdvol_lint.volumefile import VolumeFileError, read_volume_file, window


def code_of(path: Path | str, offset: int = 0, size: int | None = None) -> str:
    error = refusal_of_file(path, offset, size)
    assert error.message == error.message.strip(".")
    return error.code


def test_the_signature_decides_and_not_the_extension(tmp_path: Path) -> None:
    for source, name, kind in (
        ("class_0.vdb", "a.nvdb", "openvdb"),
        ("type_all_z.nvdb", "b.f3d", "nanovdb"),
        ("f3d_ogawa.f3d", "c.vdb", "field3d"),
    ):
        (tmp_path / name).write_bytes((SAMPLES / source).read_bytes())
        assert read_volume_file(str(tmp_path / name)).format == kind


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (b"", "not-a-file"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 3\n", "not-a-file"),
        (b"#usda 1.0\n", "not-a-volume-file"),
        (b"PK\3\4" + bytes(60), "not-a-volume-file"),
        (b"\0" * 4096, "not-a-volume-file"),
        (b"\0\0\0\0VDB " + bytes(60), "not-a-volume-file"),
        (b" BDV", "truncated"),
        (b" BDV\0\0\0", "truncated"),
        (b" BDV\0\0\0\1" + bytes(60), "not-a-volume-file"),
        (b"NanoVDB", "truncated"),
        (b"NanoVDB9" + bytes(60), "not-a-volume-file"),
        (b"Ogaw", "truncated"),
        (b"\x89HDF", "truncated"),
        (b"\n", "not-a-volume-file"),
    ],
)
def test_files_of_no_known_kind(tmp_path: Path, content: bytes, code: str) -> None:
    (tmp_path / "file.vdb").write_bytes(content)
    assert code_of(tmp_path / "file.vdb") == code


def test_paths_that_lead_to_no_file(tmp_path: Path) -> None:
    (tmp_path / "loop.vdb").symlink_to("loop.vdb")
    (tmp_path / "dangling.vdb").symlink_to("nowhere.vdb")
    for path in (
        tmp_path,
        tmp_path / "missing.vdb",
        tmp_path / "loop.vdb",
        tmp_path / "dangling.vdb",
        "a\0b.vdb",
        tmp_path / ("x" * 300),
        "",
    ):
        assert code_of(path) == "not-a-file"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no FIFOs on this system")
def test_a_fifo_is_refused_at_once(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.vdb")
    with pytest.raises(VolumeFileError, match=r"^not a regular file$"):
        read_volume_file(str(tmp_path / "pipe.vdb"))


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no /dev/zero on this system")
def test_a_device_is_refused() -> None:
    with pytest.raises(VolumeFileError, match=r"^not a regular file$"):
        read_volume_file("/dev/zero")


@pytest.mark.skipif(os.name == "nt", reason="permissions are another matter on Windows")
def test_an_unreadable_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "secret.vdb"
    path.write_bytes(w.vdb())
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip("this user may read everything")
    assert code_of(path) == "not-a-file"


def test_a_file_that_can_not_be_opened_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The same as above where tests run as root."""

    def refuse(*_: object) -> int:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(window.os, "open", refuse)
    with pytest.raises(VolumeFileError, match=r"^permission denied$"):
        read_volume_file(str(tmp_path / "any.vdb"))


def test_a_file_that_fails_while_it_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "file.vdb"
    path.write_bytes(w.vdb(w.Grid(), w.Grid("b", topology=bytes(50_000)), w.Grid("c"), version=226))

    def fail(descriptor: int, count: int) -> bytes:
        if os.lseek(descriptor, 0, os.SEEK_CUR) > 0:
            raise OSError(5, "Input/output error")
        return genuine(descriptor, count)

    genuine = os.read
    monkeypatch.setattr(window.os, "read", fail)
    error = refusal_of_file(path)
    assert (error.code, error.message) == ("not-a-file", "input/output error")
    assert error.partial is not None
    assert [grid.name for grid in error.partial.grids] == ["density", "b"]


def test_a_file_that_shrinks_while_it_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "file.vdb"
    path.write_bytes(w.vdb(w.Grid(), w.Grid("b", voxels=bytes(50_000)), w.Grid("c")))
    genuine = os.read

    def shrink(descriptor: int, count: int) -> bytes:
        content = genuine(descriptor, count)
        os.truncate(path, 20_000)
        return content

    monkeypatch.setattr(window.os, "read", shrink)
    error = refusal_of_file(path)
    assert error.code == "truncated"
    assert error.partial is not None
    assert [grid.name for grid in error.partial.grids] == ["density", "b"]


def test_short_reads_are_completed(monkeypatch: pytest.MonkeyPatch) -> None:
    path = str(SAMPLES / "dup_names.vdb")
    whole = read_volume_file(path)
    genuine = os.read
    monkeypatch.setattr(window.os, "read", lambda descriptor, count: genuine(descriptor, 7))
    assert read_volume_file(path) == whole


def test_no_descriptor_is_left_open(tmp_path: Path) -> None:
    folder = Path("/proc/self/fd")
    if not folder.exists():
        pytest.skip("no /proc on this system")
    before = len(list(folder.iterdir()))
    for name in ("class_0.vdb", "type_all_z.nvdb", "f3d_ogawa.f3d", "README.md", ""):
        with suppress(VolumeFileError):
            read_volume_file(str(SAMPLES / name))
    assert len(list(folder.iterdir())) == before


@pytest.mark.parametrize(
    "name", ["dup_names.vdb", "xf_frustum.vdb", "type_all_z.nvdb", "f3d_ogawa.f3d"]
)
def test_a_file_stored_in_a_package_is_read_in_place(tmp_path: Path, name: str) -> None:
    package = tmp_path / "package.usdz"
    content = (SAMPLES / name).read_bytes()
    with zipfile.ZipFile(package, "w", zipfile.ZIP_STORED) as archive:
        archive.writestr("root.usda", "#usda 1.0\n" * 10)
        archive.writestr(f"fields/{name}", content)
        archive.writestr("last.txt", "more" * 1000)
    offset = package.read_bytes().index(content)
    assert read_volume_file(str(package), offset, len(content)) == read_volume_file(
        str(SAMPLES / name)
    )
    assert code_of(package, offset, len(content) - 1) == "truncated"
    assert code_of(package, package.stat().st_size + 1, 10) == "truncated"
    assert code_of(package, offset, 0) == "not-a-file"


def test_a_part_may_not_be_negative() -> None:
    with pytest.raises(ValueError, match="negative"):
        read_volume_file(str(SAMPLES / "class_0.vdb"), -1)
    with pytest.raises(ValueError, match="negative"):
        read_volume_file(str(SAMPLES / "class_0.vdb"), 0, -1)


def test_results_and_errors_cross_processes(tmp_path: Path) -> None:
    file = read_volume_file(str(SAMPLES / "xf_frustum.vdb"))
    assert pickle.loads(pickle.dumps(file)) == file
    content = (SAMPLES / "instances.vdb").read_bytes()
    (tmp_path / "cut.vdb").write_bytes(content[:-1])
    error = refusal_of_file(tmp_path / "cut.vdb")
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.code, copy.partial) == (
        str(error),
        error.code,
        error.partial,
    )


def test_reading_asks_for_little(monkeypatch: pytest.MonkeyPatch) -> None:
    """A grid costs one small read, however many voxels it has."""
    asked: list[int] = []
    genuine = os.read

    def count(descriptor: int, wanted: int) -> bytes:
        asked.append(wanted)
        return genuine(descriptor, wanted)

    monkeypatch.setattr(window.os, "read", count)
    read_volume_file(str(SAMPLES / "xf_affine.vdb"))
    assert len(asked) == 1
    assert sum(asked) <= 16_384
    read_volume_file(str(SAMPLES / "dup_names.vdb"))
    assert len(asked) == 1 + 5
