"""From arguments to the list of stages: what is there, what is left out, and what are parts."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Sequence
from contextlib import suppress

from usdvol_lint.config import Glob
from usdvol_lint.files import Listed, Listing
from usdvol_lint.files.folders import Found, found_at, stages_in
from usdvol_lint.files.globs import expand, is_glob
from usdvol_lint.files.patterns import Patterns
from usdvol_lint.model import UsageError
from usdvol_lint.nearest import closest_match
from usdvol_lint.paths import SUFFIXES
from usdvol_lint.words import quoted

_NAMED = 10
"""So many wrong arguments are named in one message."""
_CLOSE = 0.6


def list_stages(
    paths: Iterable[str], exclude: Sequence[Glob] = (), wholes: Sequence[Glob] = ()
) -> Listing:
    """The stages that arguments name, sorted by path, whatever the order of these; each once.

    `exclude` takes away what is named too; where there are `wholes`, all others are parts.
    Raises UsageError where an argument leads to nothing, for all of them at once, and where a
    folder is searched and none of the wholes is there.
    """
    arguments = _Arguments(Patterns(exclude), paths)
    arguments.raise_for_wrong()
    found = _each_once(arguments.found)
    stages = tuple(each for each in found if not arguments.excluded.match(each))
    if not stages:
        left_out = "every stage is excluded" if exclude and (found or arguments.searched) else ""
        return Listing((), left_out or "the list of files is empty")
    if not wholes:
        return Listing(tuple(map(Listed, stages)))
    meant = Patterns(wholes)
    listed = tuple(Listed(each, not meant.match(each)) for each in stages)
    if arguments.searched and all(each.is_part for each in listed):
        raise UsageError(_no_whole(arguments, wholes, meant))
    return Listing(listed)


def _no_whole(arguments: _Arguments, wholes: Sequence[Glob], meant: Patterns) -> str:
    """Why there is no whole: all are excluded, or the pattern is wrong."""
    named = ", ".join(quoted(glob.pattern) for glob in wholes)
    every = _each_once(_Arguments(Patterns(()), arguments.paths).found)
    excluded = next(filter(meant.match, every), None)
    if excluded is not None:
        return (
            f"'exclude' leaves out every stage that matches 'stages' ({named}), such as "
            f"{quoted(excluded)}: correct one of them, or name the stages to check as parts one "
            "by one"
        )
    return (
        f"no stage of this run matches 'stages' ({named}), relative to {wholes[0].folder}: "
        "correct the pattern, or name the stages to check as parts one by one"
    )


class _Arguments:
    """What arguments lead to, and which of them lead to nothing.

    `searched` says that one of them is a folder, or a pattern.
    """

    def __init__(self, excluded: Patterns, paths: Iterable[str]) -> None:
        self.excluded = excluded
        self.paths = tuple(dict.fromkeys(paths))
        self.found: list[Found] = []
        self.searched = False
        self._wrong: list[str] = []
        for path in self.paths:
            self._add(path)

    def _add(self, path: str) -> None:
        if not path:
            self._wrong.append("an argument is empty")
        elif os.path.isdir(path):
            self._search([path], f"{quoted(path)} holds no stage ({_kinds()}), hidden ones aside")
        elif _is_there(path):
            self.found.append(found_at(path))
        elif is_glob(path):
            self._search(expand(path), f"{quoted(path)} matches no stage")
        else:
            self._wrong.append(f"no such file or folder: {quoted(path)}{_hint(path)}")

    def _search(self, paths: Iterable[str], unless: str) -> None:
        self.searched = True
        is_any = False
        for path in paths:
            if os.path.isdir(path):
                found, has_skipped = stages_in(path, self.excluded.match_folder)
                self.found += found
                is_any |= bool(found) or has_skipped
            else:
                self.found.append(found_at(path))
                is_any = True
        if not is_any:
            self._wrong.append(unless)

    def raise_for_wrong(self) -> None:
        if self._wrong:
            more = len(self._wrong) - _NAMED
            rest = [f"and {more} more"] if more > 0 else []
            raise UsageError("; ".join([*self._wrong[:_NAMED], *rest]))


def _each_once(found: Iterable[Found]) -> list[str]:
    """The paths of stages, sorted; where several lead to one, the first with fewest links."""
    chosen: dict[tuple[str, str], Found] = {}
    for each in sorted(found, key=lambda each: _order(each.path)):
        before = chosen.setdefault(each.key, each)
        if each.links < before.links:
            chosen[each.key] = each
    return sorted((each.path for each in chosen.values()), key=_order)


def _order(path: str) -> tuple[str, int, str]:
    """By where a path leads; of those that are written in several ways the shortest is first."""
    return os.path.normpath(path), len(path), path


def _is_there(path: str) -> bool:
    """Whether anything is at a path, a link that leads nowhere too, or nobody may know."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return False
    except OSError as error:
        return error.errno != errno.ENAMETOOLONG  # which nothing can be called
    return True


def _kinds() -> str:
    return ", ".join(SUFFIXES)


def _hint(path: str) -> str:
    """What was probably meant: the nearest name where the path first leads nowhere."""
    parent, name = os.path.split(os.path.normpath(path))
    rest = ""
    while parent and parent != os.path.dirname(parent) and not os.path.isdir(parent):
        rest = os.path.join(name, rest) if rest else name
        parent, name = os.path.split(parent)
    names: list[str] = []
    with suppress(OSError):
        names = os.listdir(parent or os.curdir)
    nearest = closest_match(name, names, cutoff=_CLOSE)
    if nearest is None:
        return ""
    meant = os.path.join(parent, nearest)
    whole = os.path.join(meant, rest) if rest else meant
    return f" (did you mean {quoted(whole if os.path.exists(whole) else meant)}?)"
