"""Volumes, their fields and volume files."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bench.case import Case
from bench.measure import ROOT, Command, gauged, linter, python

_ASSETS = ROOT / "rules" / "assets"

# Before the grids: signature, versions, a flag, the UUID, no metadata, the number of grids.
_HEADER = struct.Struct("<8s3I?36s2I")
_OFFSETS = struct.Struct("<3q")

_READ_SAMPLES = """
import os, sys
from pxr import Usd, UsdVol
stage = Usd.Stage.Open(sys.argv[1])
attribute = stage.GetPrimAtPath("/Smoke/density").GetAttribute("filePath")
values = [attribute.Get(time) for time in attribute.GetTimeSamples()]
os.listdir(os.path.join(os.path.dirname(sys.argv[1]), "files"))
"""
_READ_FILES = f"""{_READ_SAMPLES}
for value in values:
    descriptor = os.open(value.resolvedPath, os.O_RDONLY)
    os.read(descriptor, 6000)
    os.close(descriptor)
"""
_READ_VOLUMES = """
import sys
from pxr import Usd, UsdVol
stage = Usd.Stage.Open(sys.argv[1])
for prim in stage.Traverse():
    if prim.GetTypeName() == "OpenVDBAsset":
        prim.GetAttribute("filePath").Get()
        prim.GetAttribute("fieldName").Get()
    elif prim.GetTypeName() == "Volume":
        prim.GetRelationship("field:density").GetTargets()
"""
_READ_HEADERS = """
import os, sys
from time import perf_counter
from usdvol_lint.volumefile import read_volume_file
paths = [entry.path for entry in os.scandir(sys.argv[1])]
read_volume_file(paths[0])
began = perf_counter()
for path in paths: read_volume_file(path)
print((perf_counter() - began) / len(paths) * 1000)
"""
_PEER = Command(("nvidia_usd_validate",), exit_code=1)
_VDB_PRINT = Command(("sh", "-c", 'exec vdb_print "$1"/*.vdb', "sh"))


def many_samples(folder: Path, scale: float) -> Path:
    """100,000 time samples of one attribute, all of whose files exist."""
    (folder / "files").mkdir()
    count = max(1, round(100_000 * scale))
    for number in range(count):
        (folder / "files" / f"smoke.{number:06}.vdb").write_bytes(b"x")
    return _animated(folder / "samples.usda", count)


def long_sequence(folder: Path, scale: float) -> Path:
    """10,000 frames of 10 kB, no two alike."""
    count = max(1, round(10_000 * scale))
    _write_frames(folder / "files", count, (_ASSETS / "smoke" / "smoke.0001.vdb").read_bytes())
    return _animated(folder / "sequence.usdc", count)


def longer_sequence(folder: Path, scale: float) -> Path:
    """100,000 of these frames."""
    return long_sequence(folder, 10 * scale)


def many_files(folder: Path, scale: float) -> Path:
    """1,000 files of 200 kB with two grids, no two alike."""
    one_grid = (ROOT / "tests" / "samples" / "xf_affine.vdb").read_bytes()
    _write_frames(folder / "files", max(1, round(1000 * scale)), _doubled(one_grid))
    return folder / "files"


def many_volumes(folder: Path, scale: float) -> Path:
    """100,000 Volumes with a field each; five files."""
    from pxr import Sdf

    _write_frames(folder / "files", 5, (_ASSETS / "cloud.vdb").read_bytes())
    stage = folder / "volumes.usdc"
    layer = Sdf.Layer.CreateNew(str(stage))
    with Sdf.ChangeBlock():
        for group in range(max(1, round(1000 * scale))):
            parent = Sdf.PrimSpec(layer, f"group_{group}", Sdf.SpecifierDef, "Xform")
            for number in range(100):
                file = f"./files/smoke.{number % 5:06}.vdb"
                add_volume(parent, f"cloud_{number}", file)
    layer.Save()
    return stage


def add_volume(parent: Any, name: str, file: str) -> None:
    """Adds a Volume with one field of one file below a prim spec."""
    from pxr import Sdf, Vt

    volume = Sdf.PrimSpec(parent, name, Sdf.SpecifierDef, "Volume")
    extent = Sdf.AttributeSpec(volume, "extent", Sdf.ValueTypeNames.Float3Array)
    extent.default = Vt.Vec3fArray([(0, 0, 0), (1, 1, 1)])
    field = Sdf.PrimSpec(volume, "density", Sdf.SpecifierDef, "OpenVDBAsset")
    relationship = Sdf.RelationshipSpec(volume, "field:density")
    relationship.targetPathList.explicitItems = [field.path]
    for attribute, kind, value in (
        ("filePath", Sdf.ValueTypeNames.Asset, Sdf.AssetPath(file)),
        ("fieldName", Sdf.ValueTypeNames.Token, "density"),
        ("fieldDataType", Sdf.ValueTypeNames.Token, "float"),
    ):
        Sdf.AttributeSpec(field, attribute, kind).default = value


def _write_frames(folder: Path, count: int, data: bytes) -> None:
    """Writes `count` copies of a file with UUIDs and bounds that differ, as those of frames do."""
    folder.mkdir()
    corners = [
        *((at, 1) for at in _offsets_of(data, b"file_bbox_min")),
        *((at, 6) for at in _offsets_of(data, b"file_bbox_max")),
    ]
    frame = bytearray(data)
    for number in range(count):
        frame[21:57] = f"{number:08}-0000-0000-0000-000000000000".encode()
        for corner, (at, least) in enumerate(corners):
            shifts = (number // 4 ** (3 * corner + axis) % 4 for axis in range(3))
            struct.pack_into("<3i", frame, at, *(least + shift for shift in shifts))
        (folder / f"smoke.{number:06}.vdb").write_bytes(frame)


def _doubled(data: bytes) -> bytes:
    """An OpenVDB file whose one grid, "density", is repeated as "opacity"."""
    grid = data[_HEADER.size :]
    copy = bytearray(grid.replace(b"density", b"opacity"))
    at = grid.index(b"Tree_float_5_4_3") + len(b"Tree_float_5_4_3") + 4
    offsets = _OFFSETS.unpack_from(copy, at)
    _OFFSETS.pack_into(copy, at, *(offset + len(grid) for offset in offsets))
    return data[: _HEADER.size - 4] + struct.pack("<I", 2) + grid + copy


def _offsets_of(data: bytes, name: bytes) -> Iterator[int]:
    """The offsets of the values of an entry of metadata with three integers."""
    entry = name + struct.pack("<I", 5) + b"vec3i" + struct.pack("<I", 12)
    start = data.find(entry)
    while start >= 0:
        yield start + len(entry)
        start = data.find(entry, start + 1)


def _animated(stage: Path, count: int) -> Path:
    """Writes a Volume whose field has another file in each frame."""
    from pxr import Sdf, Vt

    layer = Sdf.Layer.CreateNew(str(stage))
    layer.startTimeCode, layer.endTimeCode = 0, count - 1
    with Sdf.ChangeBlock():
        volume = Sdf.PrimSpec(layer, "Smoke", Sdf.SpecifierDef, "Volume")
        extent = Sdf.AttributeSpec(volume, "extent", Sdf.ValueTypeNames.Float3Array)
        extent.default = Vt.Vec3fArray([(0, 0, 0), (1, 1, 1)])
        field = Sdf.PrimSpec(volume, "density", Sdf.SpecifierDef, "OpenVDBAsset")
        relationship = Sdf.RelationshipSpec(volume, "field:density")
        relationship.targetPathList.explicitItems = [field.path]
        for name, value in (("fieldName", "density"), ("fieldDataType", "float")):
            Sdf.AttributeSpec(field, name, Sdf.ValueTypeNames.Token).default = value
        path = Sdf.AttributeSpec(field, "filePath", Sdf.ValueTypeNames.Asset).path
        for number in range(count):
            file = Sdf.AssetPath(f"./files/smoke.{number:06}.vdb")
            layer.SetTimeSample(path, number, file)
    layer.Save()
    return stage


_HEADERS = python(_READ_HEADERS)
_MEMORY = gauged("memory", linter())

CASES = (
    Case("samples", linter("--select", "AST"), python(_READ_SAMPLES), 2.0, many_samples),
    Case("sequence", linter(), python(_READ_FILES), 2.0, long_sequence),
    Case("frames", linter(), python(_READ_FILES), 2.5, longer_sequence, is_big=True),
    Case("frames-memory", _MEMORY, None, 350, longer_sequence, unit="MB", is_big=True),
    Case("volumes", linter(), python(_READ_VOLUMES), 2.0, many_volumes),
    Case("volumes-peer", linter(), _PEER, 0.05, many_volumes, needs=_PEER.words[0]),
    Case("headers", _HEADERS, _VDB_PRINT, 0.2, many_files, needs="vdb_print"),
    Case("header", python(_READ_HEADERS, prints=True), None, 0.25, many_files, unit="ms"),
)
