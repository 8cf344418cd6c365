"""A baseline as a file: a line that says what the run was, and one for each cause."""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from usdvol_lint import __version__
from usdvol_lint.baseline.entry import (
    Entry,
    FrameLimit,
    by_fingerprint,
    checked,
    entry_as_json,
    entry_from_json,
)
from usdvol_lint.baseline.fingerprint import FINGERPRINT_VERSION
from usdvol_lint.baseline.scope import Scope, arguments_from_json, scope_as_json, scope_from_json
from usdvol_lint.baseline.values import line_of, string, table_of, value_of
from usdvol_lint.model import UsageError
from usdvol_lint.paths import canonical, is_called_like_input
from usdvol_lint.replacing import replacing
from usdvol_lint.words import quoted

FORMAT_KEY = "usdvol_lint_baseline"
FORMAT = 1
MOST_BYTES = 512 << 20
"""What is read as a baseline, a million causes: one of a stranger may be any file."""
_HEAD = 4096
_MERGED = (b"<<<<<<<", b'{"fingerprint"')
"""What a baseline begins with that git could not merge, or whose first line is gone."""
_CONFLICT = ("<<<<<<<", "|||||||", "=======", ">>>>>>>")


class Baseline(NamedTuple):
    """What a file holds.

    `root` is the folder that its layers go by; None for a report, which holds on any machine, and
    where there is none, as `has_root` says.
    """

    file: str
    root: str | None
    scope: Scope
    entries: Mapping[str, Entry]
    has_root: bool = True
    is_report: bool = False


def read_lines(file: str, text: str) -> Baseline:
    """The baseline in a text of JSON Lines; raises UsageError with the number of the line."""
    first: dict[str, Any] = {}
    entries = []
    limit = FrameLimit(file)
    lines = text.split("\n")
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        where = f"{file}:{number}"
        table = _object(where, line, is_cut=number == len(lines))
        if FORMAT_KEY in table:
            _check_first(where, table, first)
            first = first or table
        elif not first:
            raise UsageError(f"{where}: no line above says what the run was: {_ANEW}")
        else:
            entry = checked(where, entry_from_json(where, table, table))
            entries.append(limit.counted(entry))
    if not first:
        raise UsageError(f"{file}:1: no baseline, there is nothing in it")
    return _baseline(file, first, entries)


_ANEW = "write the baseline anew"


def _object(where: str, line: str, is_cut: bool) -> dict[str, Any]:
    if line.startswith(_CONFLICT):
        hint = "keep the entries of both sides, and one first line"
        raise UsageError(f"{where}: a conflict of a merge, {quoted(line[:40].strip())}: {hint}")
    try:
        value = value_of(line)
    except ValueError as error:
        cut = "; cut off, as the last line is not whole" if is_cut else ""
        raise UsageError(f"{where}: no JSON, as a baseline is: {error}{cut}") from None
    if not isinstance(value, dict):
        raise UsageError(f"{where}: no entry of a baseline: it must be an object")
    return value


def _check_first(where: str, line: dict[str, Any], other: dict[str, Any]) -> None:
    check_version(where, line, FORMAT_KEY, FORMAT, "a baseline of format")
    check_version(
        where, line, "fingerprint_version", FINGERPRINT_VERSION, "fingerprints of version"
    )
    if other and line != other:
        hint = "keep that of the run that looked at more"
        raise UsageError(f"{where}: a second first line, which differs from the first: {hint}")


def check_version(where: str, table: Mapping[str, Any], key: str, ours: int, what: str) -> None:
    """Raises UsageError for a number that is not ours."""
    theirs = table.get(key)
    if type(theirs) is not int or theirs != ours:
        shown = quoted(theirs[:40]) if isinstance(theirs, str) else str(theirs)[:40]
        if theirs is None:
            raise UsageError(f"{where}: {key!r} is missing, this version reads {ours}: {_ANEW}")
        raise UsageError(f"{where}: {what} {shown}, this version reads {ours}: {_ANEW}")


def _baseline(file: str, first: dict[str, Any], entries: list[Entry]) -> Baseline:
    where = f"{file}:1"
    said = string(where, first, "root")
    try:
        root = root_from(file, said)
    except ValueError:  # NUL, or half of a pair of UTF-16
        raise UsageError(f"{where}: its root is {quoted(said[:40])}, which is no path") from None
    if not os.path.isdir(root):
        raise UsageError(f"{where}: its root is {quoted(root)}, and there is no such folder")
    settings = table_of(where, first, "settings")
    scope = scope_from_json(where, settings, arguments_from_json(where, first))
    return Baseline(file, root, scope, by_fingerprint(entries))


def root_from(file: str, relative: str) -> str:
    """The folder that a path in a file leads to from there."""
    return canonical(os.path.join(os.path.dirname(os.path.realpath(file)), relative))


def root_in(file: str, root: str) -> str:
    """A folder in relation to that of a file."""
    folder = os.path.dirname(os.path.realpath(file))
    try:
        return os.path.relpath(os.path.realpath(root), folder).replace(os.sep, "/")
    except ValueError:  # another drive
        return root


def as_text(baseline: Baseline) -> str:
    """The lines of a baseline, which are the same for the same causes."""
    first = {
        FORMAT_KEY: FORMAT,
        "fingerprint_version": FINGERPRINT_VERSION,
        "tool": __version__,
        "root": root_in(baseline.file, baseline.root or "."),
        **scope_as_json(baseline.scope),
    }
    ordered = sorted(baseline.entries.items())
    lines = (first, *(entry_as_json(entry) for _, entry in ordered))
    return "".join(f"{line_of(line)}\n" for line in lines)


def write_baseline(baseline: Baseline) -> None:
    """Writes a file, or leaves the one that is there; raises OSError."""
    data = as_text(baseline).encode("utf-8")
    if len(data) > MOST_BYTES:
        raise OSError(errno.EFBIG, f"no baseline has more than {MOST_BYTES:,} bytes")
    with replacing(Path(baseline.file)) as stream:
        stream.write(data)
        stream.flush()
        os.fsync(stream.fileno())  # some disks are full only here


def check_writable(option: str, file: Path, replaces: bool = True) -> None:
    """Raises UsageError, before any work, where a file can't be written.

    Where it `replaces` one that is not read, this has to be a baseline.
    """
    target = Path(os.path.realpath(file))
    if target.exists() and not target.is_file():
        raise UsageError(f"{option}: this is no file, name one")
    if replaces and target.exists() and not _may_be_replaced(target):
        raise UsageError(f"{option}: the file that is there is no baseline: name another")
    if replaces and is_called_like_input(str(file)):
        said = "a baseline is not written to a file that is called like an input"
        raise UsageError(f"{option}: {said}: name another one")
    if not target.parent.is_dir():
        raise UsageError(f"{option}: there is no folder {file.parent}")
    if not os.access(target.parent, os.W_OK):
        raise UsageError(f"{option}: no permission to write there")


def _may_be_replaced(file: Path) -> bool:
    """Whether a file is a baseline, or nothing yet: a slip must not cost a stage."""
    try:
        with file.open("rb") as stream:
            head = stream.read(_HEAD)
    except OSError:
        return True  # which is said where it is read, or written
    return not head.strip() or FORMAT_KEY.encode() in head or head.lstrip().startswith(_MERGED)
