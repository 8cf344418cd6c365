"""Paths as users read them, and the suffixes of USD's own layers."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
"""The suffixes of USD's own file formats."""
_INPUTS = (*SUFFIXES, ".vdb", ".nvdb", ".f3d", ".toml", ".py")
"""What stages, volume files, configurations and rules end with."""
FORMAT_ARGUMENTS = ":SDF_FORMAT_ARGS:"
"""Stands between a path and the arguments for the file format plugin that reads it."""
_IN_PACKAGE = r"(?is)(?P<package>.+?\.usdz)(?P<inside>\[.+\])"


def real(path: str) -> str:
    """The absolute path without links; of `package.usdz[inner]` that of the package."""
    outer, inner = split_package(path)
    return os.path.realpath(outer) + inner


def canonical(path: str) -> str:
    """The name of the file that a path is: real, with `/`, in NFC, and without format arguments.

    It is spelt as its folder spells it, also where the case of letters does not matter.
    """
    outer, inner = split_package(path.partition(FORMAT_ARGUMENTS)[0])
    outer = os.path.realpath(outer)
    if sys.platform == "darwin":  # elsewhere `realpath` does it, or letters have one case
        outer = as_spelt(outer)
    return composed(outer.replace(os.sep, "/") + inner)


def as_spelt(path: str, names_in: Callable[[str], Iterable[str]] = os.listdir) -> str:
    """A path with each name as its folder spells it; what is not found there stays as it is."""
    folder, name = os.path.split(path)
    if not name:
        return path
    try:
        names = list(names_in(folder))
    except OSError:
        return path
    if name not in names:
        folded = _folded(name)
        name = next((each for each in names if _folded(each) == folded), name)
    return os.path.join(as_spelt(folder, names_in), name)


def _folded(name: str) -> str:
    return composed(name).casefold()


def is_called_like_input(file: str) -> bool:
    """Whether a file, or what it is a link to, may be what runs read, which none must destroy."""
    return any(name.lower().endswith(_INPUTS) for name in (file, os.path.realpath(file)))


def composed(text: str) -> str:
    """A text in NFC."""
    if text.isascii():
        return text
    from unicodedata import normalize  # costs start-up time

    return normalize("NFC", text)


def below(path: str, root: str | None) -> str:
    """A canonical path in relation to a canonical folder; what lies outside stays absolute."""
    if root is None:
        return path
    inside = path.removeprefix(f"{root.rstrip('/')}/")
    return "." if path == root else inside


def display(path: str) -> str:
    """A path relative to the working directory, with `/`; `package.usdz[inner]` stays as it is."""
    outer, inner = split_package(path)
    try:
        relative = os.path.relpath(outer)
    except ValueError:  # another drive
        relative = os.path.abspath(outer)
    return relative.replace(os.sep, "/") + inner


def named(path: str) -> str:
    """A path as a user named it: an absolute one as it is, others as `display` has them."""
    return path.replace(os.sep, "/") if os.path.isabs(path) else display(path)


def display_beside(stage: str, path: str) -> str:
    """A path as `display` has it, or absolute where the stage that shows it was named so.

    A file below the working directory is named in relation to that in any case.
    """
    shown = display(path)
    is_outside = shown.startswith("../") and os.path.isabs(stage)
    return path.replace(os.sep, "/") if is_outside and os.path.isabs(path) else shown


def split_package(path: str) -> tuple[str, str]:
    """The path of a file, and what is named in it if it is a package."""
    package = re.fullmatch(_IN_PACKAGE, path) if path.endswith("]") else None
    return (package["package"], package["inside"]) if package else (path, "")
