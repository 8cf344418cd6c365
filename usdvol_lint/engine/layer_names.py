"""What layers are called: as the files that they are, and as a person reads it."""

from __future__ import annotations

from typing import Any

from usdvol_lint.paths import canonical, display, split_package

ANONYMOUS = "anon:"


class LayerNames:
    """The names of layers, each found once."""

    def __init__(self) -> None:
        self._real: dict[Any, str] = {}
        self._shown: dict[Any, str] = {}

    def shown(self, layer: Any) -> str:
        """The path relative to the working directory; the identifier of a layer without a file."""
        key = layer.identifier
        if key not in self._shown:
            self._shown[key] = display(layer.realPath or key)
        return self._shown[key]

    def real(self, layer: Any) -> str:
        """The file that a layer is; the first layer of a package is the package."""
        key = layer.identifier
        if key not in self._real:
            self._real[key] = _real(layer)
        return self._real[key]


def _real(layer: Any) -> str:
    path = layer.realPath
    if not path or layer.anonymous:
        return str(layer.identifier)
    if path.endswith("]"):
        from usdvol_lint.volumefile.package import first_in

        package, inner = split_package(path)
        if inner and first_in(package) == inner[1:-1]:
            return canonical(package)
    return canonical(path)
