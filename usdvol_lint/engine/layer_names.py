"""What layers are called: as the files that they are, and as a person reads it."""

from __future__ import annotations

from typing import Any

from usdvol_lint.paths import canonical, display_beside, split_package

ANONYMOUS = "anon:"


def shown_name(layer: Any, stage: str = "") -> str:
    """The path relative to the working directory; the identifier of a layer without a file.

    It is as `display_beside` has it where the stage is known, as its user named it.
    """
    return display_beside(stage, layer.realPath or layer.identifier)


def real_name(layer: Any) -> str:
    """The file that a layer is; the first layer of a package is the package."""
    path = layer.realPath
    if not path or layer.anonymous:
        return str(layer.identifier)
    if path.endswith("]"):
        from usdvol_lint.volumefile.package import first_in

        package, inner = split_package(path)
        if inner and first_in(package) == inner[1:-1]:
            return canonical(package)
    return canonical(path)
