"""Scenes become folders on disk."""

from __future__ import annotations

import posixpath
import shutil
import struct
from pathlib import Path
from zipfile import ZIP_STORED, ZipFile, ZipInfo

from .files import SHARED
from .model import SCENE, Content, Layer, Scene
from .usda import layer_text

ROOT = Path(__file__).parents[2]
_ZIP_HEADER = 30
_ALIGNMENT = 64
_PADDING = 0x1986
"""The identifier that USD itself gives the padding of its packages."""


def write_shared(folder: Path) -> None:
    """The volume files that all scenes of a batch name, beside the folders of these."""
    shutil.copytree(ROOT / "rules" / "assets", folder / SHARED)
    shutil.copytree(ROOT / "tests" / "samples", folder / SHARED / "samples")


def write_scene(scene: Scene, folder: Path) -> Path:
    """The file to lint; the shared volume files have to stand beside `folder`."""
    folder.mkdir(parents=True)
    contents = _contents(scene, folder)
    for parent in {posixpath.dirname(path) for path in (*contents, *scene.packages)}:
        (folder / parent).mkdir(parents=True, exist_ok=True)
    for path, data in contents.items():
        (folder / path).write_bytes(data)
    for path, content in scene.packages.items():
        _write_package(folder / path, _contents(content, folder))
    return folder / scene.root


def _contents(content: Content, folder: Path) -> dict[str, bytes]:
    layers = {layer.path: _stored(layer, folder) for layer in content.layers}
    files = {
        path: data.read_bytes() if isinstance(data, Path) else data
        for path, data in content.files.items()
    }
    return {**layers, **files}


def _stored(layer: Layer, folder: Path) -> bytes:
    """The bytes of a layer, in the format that its extension names."""
    text = layer_text(layer).replace(SCENE, folder.resolve().as_posix())
    if posixpath.splitext(layer.path)[1] == ".usda":
        return text.encode()
    from pxr import Sdf

    crate = Sdf.Layer.CreateAnonymous(".usdc")
    if not crate.ImportFromString(text):
        raise ValueError(f"USD does not read this text:\n{text}")
    path = folder / "crate.usdc"
    crate.Export(str(path))
    data = path.read_bytes()
    path.unlink()
    return data


def _write_package(path: Path, contents: dict[str, bytes]) -> None:
    """A usdz: nothing compressed, the data of each file at a multiple of 64 bytes."""
    with ZipFile(path, "w", ZIP_STORED) as package:
        for name, data in contents.items():
            entry = ZipInfo(name)
            assert package.fp
            start = package.fp.tell() + _ZIP_HEADER + len(name.encode())
            padding = -(start + 4) % _ALIGNMENT
            entry.extra = struct.pack("<HH", _PADDING, padding) + bytes(padding)
            package.writestr(entry, data)
