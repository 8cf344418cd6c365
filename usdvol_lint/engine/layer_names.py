"""What layers are called: as the files that they are, and as a person reads it."""

from __future__ import annotations

import os
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


def link_to(layer: Any) -> str | None:
    """The name of a layer as a link in another folder than its file's, if it is opened as one."""
    path = layer.realPath
    if not path or layer.anonymous or path.endswith((".usdz", "]")):
        return None
    folder, name = os.path.split(path)
    link = f"{canonical(folder)}/{name}"
    return None if os.path.dirname(link) == os.path.dirname(canonical(path)) else link


def leads_elsewhere(link: str, asset: str | None) -> bool:
    """Whether a path leads from the folder of a link to something else than from the file's."""
    if not asset:
        return False
    from_link, from_file = (
        canonical(os.path.join(os.path.dirname(path), asset)) for path in (link, canonical(link))
    )
    return from_link != from_file and any(map(os.path.exists, (from_link, from_file)))
