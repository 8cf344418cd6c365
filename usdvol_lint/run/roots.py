"""The folder that layers go by: the same layer has one name on all machines."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator

from usdvol_lint.model import UsageError
from usdvol_lint.paths import canonical

_REPOSITORIES = (".git", ".hg", ".svn", ".jj")


def root_of(
    paths: Iterable[str],
    given: str | None = None,
    of_baseline: str | None = None,
    configured: str | None = None,
    config_folder: str | None = None,
) -> str | None:
    """The root of a run, or None where there is none, and layers go by their absolute paths.

    The first that there is: the one that was `given`, that of the baseline in use, that which the
    configuration says, the innermost repository that holds all paths, the folder of the
    configuration.
    """
    said = given or of_baseline or configured
    if said is not None:
        if not os.path.isdir(said):
            raise UsageError(f"the root {said!r} is no folder")
        return canonical(said)
    found = repository_of(paths) or config_folder
    return canonical(found) if found else None


def checkout_of(paths: Iterable[str]) -> str:
    """The folder that a code host names files by: that of its job, the repository, or this one."""
    said = os.environ.get("GITHUB_WORKSPACE") or os.environ.get("CI_PROJECT_DIR")
    return canonical(said or repository_of(paths) or os.getcwd())


def repository_of(paths: Iterable[str]) -> str | None:
    """The innermost working copy of a repository that holds all paths, links resolved."""
    try:
        shared = os.path.commonpath([os.path.realpath(path) for path in paths])
    except ValueError:  # no paths, or on several drives
        return None
    return next(filter(_is_repository, _upward(shared)), None)


def _upward(folder: str) -> Iterator[str]:
    yield folder
    parent = os.path.dirname(folder)
    if parent != folder:
        yield from _upward(parent)


def _is_repository(folder: str) -> bool:
    return any(os.path.exists(os.path.join(folder, name)) for name in _REPOSITORIES)
