"""The causes of a run beside a baseline: which are known, worse and new, and which are gone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from usdvol_lint.baseline.cover import exceeds
from usdvol_lint.baseline.entry import Entry, by_fingerprint, entry_of, is_held
from usdvol_lint.model import Severity
from usdvol_lint.results import Cause, State


class Comparison(NamedTuple):
    """The causes with their states, and the entries that none of them matches."""

    causes: tuple[Cause, ...]
    unmatched: tuple[Entry, ...]


def compare(entries: Mapping[str, Entry], causes: Iterable[Cause]) -> Comparison:
    """What a suppression takes out matches nothing: else it would be known once that expires."""
    judged = tuple(_judged(cause, entries.get(cause.fingerprint)) for cause in causes)
    left = {cause.fingerprint for cause in judged if cause.state is not State.SUPPRESSED}
    gone = (entry for mark, entry in sorted(entries.items()) if mark not in left)
    return Comparison(judged, tuple(gone))


def _judged(cause: Cause, entry: Entry | None) -> Cause:
    if cause.state is State.SUPPRESSED or entry is None:
        return cause
    if exceeds(entry.cover, cause.cover):
        return cause._replace(state=State.WORSE, was=entry.cover)
    return cause._replace(state=State.KNOWN)


def held(causes: Iterable[Cause], least: Severity) -> list[Entry]:
    """What a baseline holds of the causes."""
    return [
        entry
        for cause in causes
        if is_held(entry := entry_of(cause), cause.state, cause.severity, least)
    ]


def brought_up_to_date(
    entries: Mapping[str, Entry], now: Iterable[Entry], covers: bool
) -> dict[str, Entry]:
    """The entries of a run in place of those before it, of which some stay if it saw less."""
    if covers:
        return by_fingerprint(now)
    return by_fingerprint([*entries.values(), *now])


def pruned(entries: Mapping[str, Entry], causes: Sequence[Cause]) -> dict[str, Entry]:
    """The entries that are still there, and of them what still is; nothing new or worse."""
    narrowed = {}
    for cause in causes:
        entry = entries.get(cause.fingerprint)
        if entry and cause.state is not State.SUPPRESSED:
            is_less = cause.state is State.KNOWN
            narrowed[cause.fingerprint] = entry._replace(cover=cause.cover) if is_less else entry
    return narrowed
