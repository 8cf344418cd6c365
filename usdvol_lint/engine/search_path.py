"""Where USD's own resolver looks for paths that begin with neither `/` nor `.`."""

from __future__ import annotations

import os
from collections.abc import Iterable

from pxr import Ar

_VARIABLE = "PXR_AR_DEFAULT_SEARCH_PATH"


def search_path(folders: Iterable[str]) -> list[str]:
    """These folders, then those of the environment; absolute, but for the latter."""
    given = os.environ.get(_VARIABLE, "").split(os.pathsep)
    return [*map(os.path.abspath, folders), *filter(None, given)]


def set_search_path(folders: Iterable[str]) -> None:
    """Sets the search path of this process: these folders, then those of the environment."""
    Ar.DefaultResolver.SetDefaultSearchPath(search_path(folders))
