"""Whether a stage uses a file that changed, seen from its layers alone: nothing is composed."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator
from functools import cache

from pxr import UsdUtils

from usdvol_lint.config import Storage
from usdvol_lint.engine.search_path import search_path
from usdvol_lint.facts.files.storage import mapped
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.files.names import is_among, names_of
from usdvol_lint.paths import FORMAT_ARGUMENTS, split_package

_NUMBER = re.compile(r"[0-9]+|<[A-Za-z]+>|#+")


def concerned(changed: frozenset[str], storage: Storage) -> Callable[[str], bool]:
    """Whether one of the files that changed is used by the stage at a path, in any variant.

    A file counts also where a stage names it and it is gone, or was found before another one that
    stands in for it now, or was a further frame of a sequence of which a stage uses others.
    A stage that USD can't read is concerned.
    """
    gone = [path for path in changed if not os.path.lexists(path)]
    families = {_family(path) for path in gone}
    folders = [name for each in search_path(storage.search_path) for name in names_of(each)]
    has_folders = any(map(os.path.isdir, changed))

    @cache
    def is_changed(path: str) -> bool:
        if not os.path.isabs(path):  # for a search path, or a file that is gone
            return has_folders or any(each.endswith(f"/{path}") for each in changed)
        names = names_of(path)
        if is_among(path, changed) or any(_family(name) in families for name in names):
            return True
        ends = tuple(_searched(names, folders)) if gone else ()
        return bool(ends) and any(each.endswith(ends) for each in gone)

    def concerns(stage: str) -> bool:
        if is_changed(os.path.abspath(stage)):
            return True
        used = _used(stage)
        return used is None or any(map(is_changed, _on_disk(used, storage)))

    return concerns


def _searched(names: Iterable[str], folders: Iterable[str]) -> Iterator[str]:
    """How a file in a folder of the search path may be named, from the slash before that on."""
    for folder in folders:
        start = folder.rstrip("/")
        yield from (name[len(start) :] for name in names if name.startswith(f"{start}/"))


def _used(stage: str) -> Iterable[str] | None:
    """All that a stage's layers name, directly or not; None where USD can't say."""
    try:
        layers, assets, unresolved = UsdUtils.ComputeAllDependencies(os.path.abspath(stage))
    except (*UNREADABLE, UnicodeEncodeError):  # the latter where a path is not UTF-8
        return None
    return [*(layer.realPath for layer in layers), *assets, *unresolved] if layers else None


def _on_disk(paths: Iterable[str], storage: Storage) -> Iterator[str]:
    """The files that paths are, of what is in a package the package."""
    for path in paths:
        if path:
            yield _file(mapped(path, storage.path_map) or path)


def _file(path: str) -> str:
    """What is on disk of a path: no arguments for a file format, wherever they stand."""
    outer = split_package(path)[0].partition(FORMAT_ARGUMENTS)[0]
    return split_package(outer)[0]


def _family(path: str) -> str:
    """A path without the numbers of its name, which the frames of a sequence share."""
    folder, _, name = path.rpartition("/")
    return f"{folder}/{_NUMBER.sub('#', name)}" if _NUMBER.search(name) else path
