"""What is in folders and packages, listed once in a run, and again once it has changed."""

from __future__ import annotations

import os
import re
import time
from collections import defaultdict
from collections.abc import Iterable, Iterator
from itertools import chain
from typing import TypeAlias

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.files.places import folders_above, names_listed
from usdvol_lint.nearest import are_swapped, closest_match

_NUMBER = re.compile(r"[0-9]+")
_NAMES_KEPT = 200_000
"""So many names take some 20 MB."""
_FOLDERS_KEPT = 10_000
_SOUGHT_KEPT = 1_000
"""So many missing names are kept with what was found for them, of each folder."""
_SETTLED = 2_000_000_000
"""In so many nanoseconds a folder may change twice, and its time of change once."""

_Numbers: TypeAlias = tuple[str, ...]
_State: TypeAlias = tuple[int, int, int]


class Listing:
    """The names in a folder, sorted, or the paths in a package."""

    def __init__(self, names: Iterable[str]) -> None:
        self.names = tuple(names)
        self.with_file: dict[str, tuple[str, ...]] = {}
        """By a path, those of the names that are folders with a file at that path below them."""
        self._closest: dict[tuple[str, frozenset[str]], str | None] = {}

    @cached_property
    def by_case(self) -> dict[str, str]:
        """The names, by themselves and by their lower case."""
        return {name.lower(): name for name in self.names} | {name: name for name in self.names}

    @cached_property
    def folders(self) -> frozenset[str]:
        """The folders of a package."""
        return frozenset(chain.from_iterable(map(folders_above, self.names)))

    @cached_property
    def _by_numbers(self) -> dict[_Numbers, list[str]]:
        groups: dict[_Numbers, list[str]] = defaultdict(list)
        for name in self.names:
            groups[_numbers(name)].append(name)
        return groups

    def names_in(self, folder: str) -> Iterator[str]:
        """The names of the files in a folder of a package; of all that is listed, if it is ""."""
        start = f"{folder}/" if folder else ""
        inside = (name.removeprefix(start) for name in self.names if name.startswith(start))
        return (name for name in inside if "/" not in name)

    def siblings_with(self, folder: str, below: str) -> list[str]:
        """The folders beside one in a package that have a file at the path `below`, `/a.vdb`."""
        start = folder[: folder.rfind("/") + 1]
        found = (
            name.removeprefix(start).removesuffix(below)
            for name in self.names
            if name.startswith(start) and name.endswith(below)
        )
        return [name for name in found if "/" not in name]

    def closest(self, name: str, excluded: frozenset[str]) -> str | None:
        """The closest other name; one with other numbers is no misspelling."""
        key = name, excluded
        if key not in self._closest:
            if len(self._closest) >= _SOUGHT_KEPT:
                self._closest.clear()  # a listing lasts for the whole run
            alike = self._by_numbers.get(_numbers(name), ())
            others = [other for other in alike if other != name and other not in excluded]
            swapped = (other for other in others if are_swapped(name, other))
            self._closest[key] = next(swapped, None) or closest_match(name, others)
        return self._closest[key]


class Folders:
    """The listings of folders and packages, and what was searched in them, for a whole run."""

    def __init__(self) -> None:
        self._listings: dict[str, tuple[_State, Listing]] = {}
        self._names_kept = 0
        self._ignores_case: dict[str, bool] = {}

    def listing(self, folder: str) -> Listing:
        """What is in a folder or package now; nothing if it can't be read."""
        state = _state(folder)
        known, listing = self._listings.get(folder, (None, None))
        if listing is None or state is None or known != state:
            began = time.time_ns()
            listing = Listing(names_listed(folder))
            if state and began - state[0] > _SETTLED:
                self._keep(folder, state, listing)
        return listing

    def ignores_case(self, path: str) -> bool:
        """Whether the file system finds an existing file under another case of its name.

        That is asked once in each folder, and stays so.
        """
        folder, _, name = path.rpartition("/")
        if folder not in self._ignores_case:
            if len(self._ignores_case) >= _FOLDERS_KEPT:
                self._ignores_case.clear()
            try:
                same = os.path.samefile(path, f"{folder}/{name.swapcase()}")
            except OSError:
                same = False
            self._ignores_case[folder] = same
        return self._ignores_case[folder]

    def with_file(self, folder: str, below: str) -> tuple[str, ...]:
        """The folders in a folder that have a file at the path `below`, such as `/a.vdb`."""
        listing = self.listing(folder)
        if below not in listing.with_file:
            listing.with_file[below] = tuple(_with_file(folder, listing.names, below))
        return listing.with_file[below]

    def _keep(self, folder: str, state: _State, listing: Listing) -> None:
        _, before = self._listings.pop(folder, (None, Listing(())))
        self._listings[folder] = (state, listing)
        self._names_kept += len(listing.names) - len(before.names)
        while self._names_kept > _NAMES_KEPT:
            _, oldest = self._listings.pop(next(iter(self._listings)))
            self._names_kept -= len(oldest.names)


def _state(folder: str) -> _State | None:
    """What differs once names were added or removed; None for a folder that is not there."""
    try:
        status = os.stat(folder)
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino


def _with_file(folder: str, names: Iterable[str], below: str) -> Iterator[str]:
    return (name for name in names if os.path.isfile(f"{folder}/{name}{below}"))


def _numbers(name: str) -> _Numbers:
    return tuple(number.lstrip("0") for number in _NUMBER.findall(name))
