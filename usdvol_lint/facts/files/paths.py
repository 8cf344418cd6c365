"""Asset paths: their parts as text, and the absolute path of each."""

from __future__ import annotations

import os
import re
from typing import Any

from pxr import Ar, Sdf

from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.paths import FORMAT_ARGUMENTS

_UNLISTED = ("", ".", "..")
_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+-]+):")


def split_path(path: str) -> tuple[str, str]:
    """The folder of a path and the name of the file, without a slash between, and no arguments."""
    folder, _, name = path.partition(FORMAT_ARGUMENTS)[0].rpartition("/")
    return folder, name


def extension_of(path: str) -> str:
    """The extension in lower case with its dot, or empty; in a package that of the inner file."""
    name = path.partition(FORMAT_ARGUMENTS)[0].rstrip("]").rpartition("/")[2]
    _, dot, extension = name.rpartition(".")
    return f".{extension}".lower() if dot else ""


def count_names(path: str) -> int:
    """How many names a path has that folders list, so without `.` and `..`."""
    return _listed(os.path.normpath(path).replace(os.sep, "/").split("/"))


def _listed(names: list[str]) -> int:
    """How many of the names of a path folders list."""
    return len(names) - sum(map(names.count, _UNLISTED))


def count_shared(path: str, place: str) -> int:
    """How many names, counted from the end, a path shares with the absolute one of its place.

    These are all of its names, unless a configuration or a resolver leads it elsewhere.
    """
    names = os.path.normpath(path).replace("\\", "/").split("/")
    others = place.replace("\\", "/").split("/")
    shared = 0
    for name, other in zip(reversed(names), reversed(others), strict=False):
        if name != other:
            break
        shared += 1
    return min(count_names(path) if "\\" in path else _listed(names), shared)


def is_packaged(path: str) -> bool:
    """Whether a path names a file in a package, `package.usdz[inner]`."""
    return path.endswith("]") and bool(Ar.IsPackageRelativePath(path))


def is_uri(path: str) -> bool:
    """Whether a path has a scheme that no installed resolver answers for."""
    if ":" not in path:
        return False
    scheme = _SCHEME.match(Sdf.Layer.SplitIdentifier(path)[0])
    return scheme is not None and scheme[1].lower() not in Ar.GetRegisteredURISchemes()


def anchored(attribute: Any, time: float | None, path: str) -> str:
    """The absolute path of a value, without arguments, whether or not anything is there.

    It is anchored at the layer that holds the strongest opinion at a time; None is the default.
    """
    bare = str(Sdf.Layer.SplitIdentifier(path)[0])
    strongest = strongest_opinion(attribute, time)
    if strongest is None:
        return bare
    return anchored_to(strongest.spec.layer, bare)


def anchored_to(layer: Any, path: str) -> str:
    """The absolute path of one that is authored in a layer, whether or not anything is there."""
    absolute = str(layer.ComputeAbsolutePath(path))
    # USD leaves a bare name that it does not find as it is, for the resolver's search path.
    searched = absolute == path and not (os.path.isabs(path) or is_uri(path))
    return str(layer.ComputeAbsolutePath(f"./{path}")) if searched else absolute
