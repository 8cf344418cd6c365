"""Reads the texts of layers, each once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pxr import Ar

from usdvol_lint.layertext.signatures import TEXT_SIGNATURES

if TYPE_CHECKING:
    from usdvol_lint.layertext.lines import TextLayer


class LayerTexts:
    """The texts of layers: one is read once, and only if something in it is looked for."""

    def __init__(self) -> None:
        self._texts: dict[str, TextLayer | None] = {}

    def of(self, layer: Any) -> TextLayer | None:
        """The text of a layer; None if it is in no file, or in a crate."""
        from usdvol_lint.layertext.lines import (
            TextLayer,  # costs start-up time; clean stages need none
        )

        key = layer.identifier
        if key not in self._texts:
            data = _read(layer)
            self._texts[key] = TextLayer(data) if data.startswith(TEXT_SIGNATURES) else None
        return self._texts[key]


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
