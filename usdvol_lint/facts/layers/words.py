"""Names that speak of volumes and particle fields."""

from __future__ import annotations

import re
from collections.abc import Iterable

_ANYWHERE = (
    *("volume", "vdb", "smoke", "cloud", "pyro", "explosion", "simulation"),
    *("splat", "gaussian", "3dgs", "particle"),
)
_ALONE = frozenset(
    {"vol", "vols", "fog", "fire", "dust", "mist", "steam", "sim", "sims", "fx", "vfx", "gs"}
)
"""Words that are too short to be looked for inside of others: `revolver` is no `vol`."""

_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def speak_of_ours(names: Iterable[str]) -> bool:
    """Whether one of these names or paths has such a word, in whatever case."""
    return any(map(_speaks_of_ours, names))


def _speaks_of_ours(name: str) -> bool:
    lower = name.lower()
    if any(word in lower for word in _ANYWHERE):
        return True
    return not _ALONE.isdisjoint(word.lower() for word in _WORD.findall(name))
