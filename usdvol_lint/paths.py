"""Paths as users read them, and the suffixes of USD's own layers."""

from __future__ import annotations

import os
import re

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
"""The suffixes of USD's own file formats."""
_IN_PACKAGE = r"(?is)(?P<package>.+?\.usdz)(?P<inside>\[.+\])"


def real(path: str) -> str:
    """The absolute path without links; of `package.usdz[inner]` that of the package."""
    outer, inner = _split(path)
    return os.path.realpath(outer) + inner


def display(path: str) -> str:
    """A path relative to the working directory, with `/`; `package.usdz[inner]` stays as it is."""
    outer, inner = _split(path)
    try:
        relative = os.path.relpath(outer)
    except ValueError:  # another drive
        relative = os.path.abspath(outer)
    return relative.replace(os.sep, "/") + inner


def _split(path: str) -> tuple[str, str]:
    """The path of a file, and what is named in it if it is a package."""
    package = re.fullmatch(_IN_PACKAGE, path) if path.endswith("]") else None
    return (package["package"], package["inside"]) if package else (path, "")
