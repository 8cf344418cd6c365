"""Paths as users read them, and the suffixes of USD's own layers."""

from __future__ import annotations

import os
import re

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
"""The suffixes of USD's own file formats."""
_IN_PACKAGE = r"(?is)(?P<package>.+?\.usdz)(?P<inside>\[.+\])"


def display(path: str) -> str:
    """A path relative to the working directory, with `/`; `package.usdz[inner]` stays as it is."""
    package = re.fullmatch(_IN_PACKAGE, path) if path.endswith("]") else None
    outer, inner = (package["package"], package["inside"]) if package else (path, "")
    try:
        relative = os.path.relpath(outer)
    except ValueError:  # another drive
        relative = os.path.abspath(outer)
    return relative.replace(os.sep, "/") + inner
