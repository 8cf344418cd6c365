"""Reads the texts of layers, each once."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from pxr import Ar

from usdvol_lint.layertext.signatures import TEXT_SIGNATURES

if TYPE_CHECKING:
    from usdvol_lint.layertext.lines import TextLayer


_MOST_LAYERS = 32
_LARGEST = 4 << 20


class SharedTexts:
    """The texts of layers that several stages name, the last ones; of a file that changed anew."""

    def __init__(self) -> None:
        self._texts: dict[str, tuple[object, TextLayer | None]] = {}

    def of(self, layer: Any) -> TextLayer | None:
        """The text of a layer; it is kept if it is a file of its own, and no large one."""
        path = layer.realPath
        try:
            status = os.stat(path) if path else None
        except OSError:  # in a package
            status = None
        if status is None or status.st_size > _LARGEST:
            return _text(layer)
        signature = status.st_mtime_ns, status.st_size, status.st_ino
        known = self._texts.pop(path, None)
        if known is None or known[0] != signature:
            known = signature, _text(layer)
        self._texts[path] = known  # the last one
        if len(self._texts) > _MOST_LAYERS:
            del self._texts[next(iter(self._texts))]
        return known[1]


class LayerTexts:
    """The texts of layers: one is read once, and only if something in it is looked for."""

    def __init__(self, shared: SharedTexts | None = None) -> None:
        self._shared = shared or SharedTexts()
        self._texts: dict[str, TextLayer | None] = {}

    def of(self, layer: Any) -> TextLayer | None:
        """The text of a layer; None if it is in no file, or in a crate."""
        key = layer.identifier
        if key not in self._texts:
            self._texts[key] = self._shared.of(layer)
        return self._texts[key]


def _text(layer: Any) -> TextLayer | None:
    from usdvol_lint.layertext.lines import TextLayer  # costs start-up time; clean stages need none

    data = _read(layer)
    return TextLayer(data) if data.startswith(TEXT_SIGNATURES) else None


def _read(layer: Any) -> bytes:
    path = layer.realPath
    if not path or layer.anonymous:
        return b""
    if layer.GetFileFormat().IsPackage():
        path = _root_layer_of_package(path)
    if Ar.IsPackageRelativePath(path):
        asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(path))
        return bytes(asset.GetBuffer()) if asset else b""
    try:
        with open(path, "rb") as file:
            head = file.read(8)
            return head + file.read() if head.startswith(TEXT_SIGNATURES) else b""
    except OSError:
        return b""


def _root_layer_of_package(path: str) -> str:
    """The path of the first file in a package, which is what USD opens."""
    from usdvol_lint.volumefile.package import first_in  # costs start-up time; few are packages

    first = first_in(path)
    return str(Ar.JoinPackageRelativePath(path, first)) if first else path
