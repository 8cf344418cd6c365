"""Frames that are laid out like one before are recalled as they are read."""

from __future__ import annotations

import os
import random
from pathlib import Path

import pytest
import vdbwriter as w
from process import SAMPLES

from usdvol_lint.volumefile import VolumeFile, VolumeFileError, cache, read_volume_file, window
from usdvol_lint.volumefile.cache import Reading, VolumeFiles


def frame(number: int) -> bytes:
    low, high = (number, -number, 0), (number + 7, 7, number)
    stored = {
        **w.bounds(low, high),
        "file_delayed_load": ("__delayedload", bytes(number % 50)),
        "file_voxel_count": w.value("int64", number),
        "name": w.string("density"),
    }
    voxels = bytes(number % 13)
    return w.vdb(
        w.Grid("density", metadata=stored, voxels=voxels),
        w.Grid("heat", "Tree_float_5_4_3_HalfFloat", metadata={"name": w.string("heat")}),
        uuid=f"{number:036}".encode(),
        metadata_bytes=w.metadata({"creator": w.string("me"), "frame": w.value("int32", number)}),
    )


def plainly(path: Path) -> VolumeFile | str:
    """What the reader itself says, as far as it is kept."""
    try:
        file = read_volume_file(str(path))
    except VolumeFileError as error:
        return str(error)
    grids = tuple(each._replace(metadata={}) for each in file.grids)
    return file._replace(uuid=None, metadata={}, grids=grids)


def as_kept(found: Reading) -> VolumeFile | str | None:
    return str(found.fault) if found.fault else found.file


def test_frames_are_recalled_as_they_are(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    parsed = 0

    def counting(stretch: window.Window) -> VolumeFile:
        nonlocal parsed
        parsed += 1
        return genuine(stretch)

    genuine = cache.read_window
    monkeypatch.setattr(cache, "read_window", counting)
    layouts = set()
    for number in range(200):
        path.write_bytes(frame(number))
        found = files.read(str(path), 0, len(frame(number)))
        layouts.add(found.layout)
        assert as_kept(found) == plainly(path)
    assert parsed == 1
    assert len(layouts) == 1
    path.write_bytes(frame(-8))
    empty = files.read(str(path))
    assert as_kept(empty) == plainly(path)
    assert empty.file
    assert empty.file.grids[0].is_empty
    assert empty.layout not in layouts
    assert parsed == 1


def test_instances_have_the_bounds_of_their_own_frame(tmp_path: Path) -> None:
    """Also with other offsets than OpenVDB writes, by which instances are not recalled."""
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    for number in range(1, 4):
        shown = {"name": w.string("a"), **w.bounds((0, 0, 0), (number,) * 3)}
        instance = w.Grid("b", parent="a", offsets=lambda start, _, end: (start, end, end))
        path.write_bytes(w.vdb(w.Grid("a", metadata=shown), instance))
        os.utime(path, ns=(number, number))
        assert as_kept(files.read(str(path))) == plainly(path)


def test_bounds_may_be_told_twice(tmp_path: Path) -> None:
    """Those of the whole file are not those of its grid."""
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    for number in range(1, 4):
        own = {"name": w.string("a"), **w.bounds((0, 0, 0), (number,) * 3)}
        of_the_file = w.metadata(w.bounds((0, 0, 0), (5, 5, 5)))
        path.write_bytes(w.vdb(w.Grid("a", metadata=own), metadata_bytes=of_the_file))
        os.utime(path, ns=(number, number))
        assert as_kept(files.read(str(path))) == plainly(path)


def test_a_recalled_frame_may_lie(tmp_path: Path) -> None:
    """Whatever byte is another one, it is told as the reader tells it."""
    choose = random.Random(7)
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    path.write_bytes(frame(3))
    files.read(str(path))
    for number in range(3000):
        content = bytearray(frame(choose.randrange(60)))
        for _ in range(choose.choice((1, 1, 2))):
            content[choose.randrange(len(content))] = choose.choice((0, 1, 0x7F, 0xFF))
        if choose.random() < 0.2:
            del content[choose.randrange(len(content)) :]
        path.write_bytes(content)
        os.utime(path, ns=(number, number))
        assert as_kept(files.read(str(path))) == plainly(path)


@pytest.mark.parametrize("path", sorted(SAMPLES.glob("*.[vnf]*")), ids=lambda path: path.name)
def test_samples_are_recalled_as_they_are(path: Path, tmp_path: Path) -> None:
    files = VolumeFiles()
    for copy in ("a", "b"):
        (tmp_path / copy).write_bytes(path.read_bytes())
        assert as_kept(files.read(str(tmp_path / copy))) == plainly(path)
