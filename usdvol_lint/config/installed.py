"""The rule packs that are installed as Python packages, as their entry points name them."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress

ENTRY_POINT_GROUP = "usdvol_lint.packs"


def installed_packs() -> Mapping[str, str]:
    """The importable package of each installed pack, by the name of its entry point, in order."""
    # Importing importlib.metadata takes ten times as long as seeing that there are no packs.
    if not any(map(_names_packs, sys.path)):
        return {}
    from importlib.metadata import entry_points

    return dict(
        sorted((entry.name, entry.value) for entry in entry_points(group=ENTRY_POINT_GROUP))
    )


def _names_packs(folder: str) -> bool:
    """Whether some distribution in a folder of `sys.path` declares a rule pack."""
    return any(map(_is_declared, _declarations(folder or os.curdir)))


def _declarations(folder: str) -> Iterator[str]:
    with suppress(OSError):
        for name in os.listdir(folder):
            if name.endswith("-info"):
                yield os.path.join(folder, name, "entry_points.txt")


def _is_declared(file: str) -> bool:
    with suppress(OSError), open(file, "rb") as declared:
        return ENTRY_POINT_GROUP.encode() in declared.read()
    return False
