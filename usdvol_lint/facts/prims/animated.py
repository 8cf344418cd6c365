"""What is animated on Volumes, fields and particle fields, and when it has samples."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.values import sample_times
from usdvol_lint.schema import OURS


def animated(tables: Tables) -> Iterator[tuple[Any, list[float]]]:
    """The attributes of ours that have two time samples at least, and the times of these."""
    for prims, authored in tables.authored(*OURS):
        for name in authored.declared:
            for prim in prims:
                attribute = prim.GetAttribute(name)
                times = _times(attribute)
                if len(times) > 1:
                    yield attribute, times


def _times(attribute: Any) -> list[float]:
    try:
        return sample_times(attribute)
    except UNREADABLE:  # clips that do not open: reported by another rule
        return []
