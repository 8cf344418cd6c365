"""What suppressions are made of, wherever they stand: reasons, dates and patterns."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from usdvol_lint.gitignore import spec_of
from usdvol_lint.model import UsageError
from usdvol_lint.nearest import did_you_mean


class InStages(NamedTuple):
    """How a worker process takes the suppressions that stand in stages.

    `heeded` is False for a run that trusts none of them, `unused` asks for those that match
    nothing; `today` is a date in place of the real one.
    `prims` are the patterns of a configuration that the instances of a prim are told apart by.
    """

    heeded: bool = True
    unused: bool = False
    today: str | None = None
    prims: tuple[tuple[str, ...], ...] = ()


class Suppression(NamedTuple):
    """A table `[[suppress]]` of a configuration; `where` is how messages name it.

    `files`, `stages` and `prims` are patterns as in a .gitignore, `rules` are codes, prefixes of
    codes and names; where it has none of a kind, everything of it is meant.
    It holds to the end of the day `until`, in UTC.
    """

    where: str
    reason: str
    files: tuple[str, ...] = ()
    stages: tuple[str, ...] = ()
    prims: tuple[str, ...] = ()
    rules: tuple[str, ...] = ()
    until: str | None = None

    def as_written(self) -> dict[str, object]:
        """What the table says, by its keys."""
        said = self._asdict()
        return {key: said[key] for key in (*_LISTS, "reason", "until") if said[key]}

    def is_over(self, today: str | None) -> bool:
        return self.until is not None and is_over(self.until, today)


# --- dates ----------------------------------------------------------------------------------------


def is_date(text: str) -> bool:
    """Whether it is a day of the calendar, as YYYY-MM-DD."""
    from datetime import date  # few suppressions have one

    try:
        return date.fromisoformat(text).isoformat() == text
    except ValueError:
        return False


def is_over(until: str, today: str | None = None) -> bool:
    """Whether a day has ended; `today` is a date in place of the real one, in UTC."""
    if today is None:
        from datetime import UTC, datetime

        today = datetime.now(UTC).date().isoformat()
    return until < today


def date_of(where: str, value: Any) -> str:
    """The value, if it is a date of TOML, or one as text."""
    text = str(value)  # that of a date of TOML is YYYY-MM-DD, that of one with a time is longer
    if isinstance(value, int | float | list | dict) or not is_date(text):
        raise UsageError(f"{where} must be a date such as 2026-12-31, not {text!r}")
    return text


# --- patterns -------------------------------------------------------------------------------------


def matching(lines: Sequence[str]) -> Callable[[str], bool]:
    """Whether a path matches patterns that are written as in a .gitignore.

    Raises ValueError for one that is none.
    """
    spec = spec_of(lines)
    return lambda path: bool(spec.match_file(path))


# --- tables of a configuration --------------------------------------------------------------------

_LISTS = ("files", "stages", "prims", "rules")


def read_tables(where: str, value: Any) -> tuple[Suppression, ...]:
    """The tables; raises UsageError, which `where` begins, for what is wrong with one."""
    return tuple(_read(*each) for each in tables_of(where, value, "suppress"))


def tables_of(where: str, value: Any, key: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """The tables of a list, each with how messages name it."""
    if not isinstance(value, list) or not all(isinstance(table, dict) for table in value):
        raise UsageError(f"{where} must be tables, each below a line [[{key}]], not {value!r}")
    yield from ((f"{where}, table {number}", each) for number, each in enumerate(value, 1))


def check_known(where: str, table: dict[str, Any], known: tuple[str, ...]) -> None:
    """Raises UsageError for a key of a table that is not known."""
    for key in table:
        if key not in known:
            raise UsageError(f"{where}: unknown key {key!r}{did_you_mean(key, known)}")


def _read(where: str, table: dict[str, Any]) -> Suppression:
    check_known(where, table, (*_LISTS, "reason", "until"))
    reason = table.get("reason")
    if not isinstance(reason, str) or not reason.strip():
        found = f", not {reason!r}" if "reason" in table else ""
        raise UsageError(f"{where}: 'reason' must say why{found}")
    if not any(key in table for key in _LISTS):
        raise UsageError(f"{where}: name what is suppressed, with one of {', '.join(_LISTS)}")
    reading = {key: texts if key == "rules" else patterns for key in _LISTS if key in table}
    lists = {key: read(f"{where}: {key}", table[key]) for key, read in reading.items()}
    until = date_of(f"{where}: until", table["until"]) if "until" in table else None
    return Suppression(where, reason.strip(), until=until, **lists)


def texts(where: str, value: Any) -> tuple[str, ...]:
    """The value, if it is a text or a list of texts."""
    given = [value] if isinstance(value, str) else value
    is_list = isinstance(given, list) and bool(given)
    if not is_list or not all(isinstance(text, str) and text.strip() for text in given):
        raise UsageError(f"{where} must be a text or a list of texts, not {value!r}")
    return tuple(given)


def patterns(where: str, value: Any) -> tuple[str, ...]:
    """The value, if it is a pattern as in a .gitignore, or a list of such."""
    given = texts(where, value)
    check_patterns(where, given)
    return given


def check_patterns(where: str, patterns: tuple[str, ...]) -> None:
    """Raises UsageError, which `where` begins, for a text that is no pattern."""
    for pattern in patterns:
        try:
            matching([pattern])
        except ValueError as error:
            raise UsageError(f"{where}: {pattern!r} is no pattern as in a .gitignore") from error
