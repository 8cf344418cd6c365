"""One line of a baseline: a cause, and how much of it is known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from usdvol_lint.baseline.cover import cover_as_json, cover_from_json, join
from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.baseline.values import optional_string, string, table_of
from usdvol_lint.model import Cover, Severity, Source, UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE
from usdvol_lint.results import Cause, State
from usdvol_lint.words import printable

_MOST_FRAMES = 10_000_000
ANONYMOUS = "anon:"
"""The identifiers of layers without a file begin so, and hold for one process."""


class Entry(NamedTuple):
    """A cause that is known; the layer of `source` is in relation to the root."""

    fingerprint: str
    code: str
    source: Source
    cover: Cover

    def __str__(self) -> str:
        layer, path, name, subject = self.source
        spec = f" <{path}{'.' if name else ''}{name or ''}>" if path else ""
        return printable(f"{self.code} {layer or 'the machine'}{spec} {subject}".rstrip())


def entry_of(cause: Cause) -> Entry:
    """What a baseline holds of a cause."""
    return Entry(cause.fingerprint, cause.code, cause.source, cause.cover)


class FrameLimit:
    """Holds a file to no more frames than any run tells: a short text may say many.

    Entries with equal texts share their frames, which count once.
    """

    def __init__(self, file: str) -> None:
        self._file = file
        self._seen: dict[int, tuple[float, ...]] = {}
        self._left = _MOST_FRAMES

    def counted(self, entry: Entry) -> Entry:
        """The entry; raises UsageError where it is one too many."""
        frames = entry.cover.frames
        if frames and id(frames) not in self._seen:
            self._seen[id(frames)] = frames
            self._left -= len(frames)
            if self._left < 0:
                hint = "write the baseline anew"
                raise UsageError(f"{self._file}: more than {_MOST_FRAMES:,} frames in all: {hint}")
        return entry


def least_held(settings: Mapping[str, object]) -> Severity:
    """The severity from which on a baseline holds causes: infos where they may fail a run."""
    are_infos = settings.get("fail_on") == "info" or settings.get("fail_on_unchecked") is True
    return Severity.INFO if are_infos else Severity.WARNING


def is_held(entry: Entry, state: State, severity: Severity, least: Severity) -> bool:
    """Whether a baseline holds a cause."""
    lasts = not (entry.source.layer or "").startswith(ANONYMOUS)
    known = state is not State.SUPPRESSED and entry.code not in NOT_IGNORABLE
    return severity >= least and known and lasts


def by_fingerprint(entries: Iterable[Entry]) -> dict[str, Entry]:
    """The entries by fingerprint; those of one cause are joined."""
    joined: dict[str, Entry] = {}
    for entry in entries:
        other = joined.get(entry.fingerprint)
        joined[entry.fingerprint] = widened(other, entry.cover) if other else entry
    return joined


def widened(entry: Entry, cover: Cover) -> Entry:
    """The entry, which covers that too."""
    return entry._replace(cover=join(entry.cover, cover))


def entry_as_json(entry: Entry) -> dict[str, object]:
    """An entry as its line has it: what tells it apart first, what does not apply left out."""
    source = entry.source
    return {
        "fingerprint": entry.fingerprint,
        "code": entry.code,
        "layer": source.layer,
        "path": source.path,
        **({"property": source.property} if source.property else {}),
        **({"subject": source.subject} if source.subject else {}),
        "cover": cover_as_json(entry.cover),
    }


def entry_from_json(where: str, table: Mapping[str, Any], source: Mapping[str, Any]) -> Entry:
    """The entry that `table` holds, with what is to blame in `source`."""
    code, mark = string(where, table, "code"), string(where, table, "fingerprint")
    blamed = Source(
        optional_string(where, source, "layer"),
        optional_string(where, source, "path"),
        optional_string(where, source, "property"),
        optional_string(where, source, "subject") or "",
    )
    try:
        cover = cover_from_json(table_of(where, table, "cover"))
    except ValueError as error:
        raise UsageError(f"{where}: cover: {error}") from None
    return Entry(mark, code, blamed, cover)


def checked(where: str, entry: Entry) -> Entry:
    """The entry; raises UsageError for one that no run of ours wrote."""
    if entry.code in NOT_IGNORABLE:
        raise UsageError(f"{where}: {entry.code} can't be in a baseline: take the line out")
    return named_right(where, entry)


def named_right(where: str, entry: Entry) -> Entry:
    """The entry; raises UsageError where its fingerprint is another's, as after an edit by hand."""
    if fingerprint(entry.code, entry.source) != entry.fingerprint:
        said = "the fingerprint is not that of this code, layer, path, property and subject"
        raise UsageError(f"{where}: {said}; --moved OLD=NEW renames layers")
    return entry
