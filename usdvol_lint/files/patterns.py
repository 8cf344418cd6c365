"""Patterns as in a .gitignore, each relative to the folder of the file that says it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from functools import cache
from itertools import groupby
from operator import attrgetter

from usdvol_lint.config import Glob
from usdvol_lint.gitignore import spec_of


class Patterns:
    """Which paths some patterns match; of several patterns the last that speaks of a path counts.

    A path outside the folder of a pattern goes by its absolute one.
    """

    def __init__(self, globs: Sequence[Glob]) -> None:
        self._is_any = bool(globs)
        self._groups = [
            _Group(folder, [glob.pattern for glob in group])
            for folder, group in groupby(globs, attrgetter("folder"))
        ]
        self._may_bring_back = any(glob.pattern.startswith("!") for glob in globs)

    def match(self, path: str) -> bool:
        """Whether a file is meant, by the path that it has or the one without links."""
        verdict = False
        for group in self._groups:
            said = group.verdict(path)
            verdict = verdict if said is None else said
        return verdict

    def match_folder(self, path: str) -> bool:
        """Whether all below a folder is meant."""
        return self._is_any and not self._may_bring_back and self.match(os.path.join(path, ""))


class _Group:
    """The patterns of one folder, in their order."""

    def __init__(self, folder: str, patterns: Iterable[str]) -> None:
        self._spec = spec_of(patterns)
        self._folders = (os.path.abspath(folder), os.path.realpath(folder))

    def verdict(self, path: str) -> bool | None:
        end = os.sep if path.endswith(os.sep) else ""
        folder, name = os.path.split(os.path.abspath(path))
        names = (os.path.join(folder, name), os.path.join(_real(folder), name))
        relative = map(_relative, names, self._folders)
        said = [self._spec.check_file(each + end).include for each in dict.fromkeys(relative)]
        return next((each for each in said if each is not None), None)


_real = cache(os.path.realpath)


def _relative(path: str, folder: str) -> str:
    inside = path.removeprefix(folder.rstrip(os.sep) + os.sep)
    return inside.replace(os.sep, "/").lstrip("/")
