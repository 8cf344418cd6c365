"""What each key of the configuration may be: every value is checked where it is given."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from usdvol_lint.config import (
    CONTENTS,
    FAIL_ON,
    LEVELS,
    LOADS,
    OUTPUT_FORMATS,
    SHOWABLE,
    SUPPRESSIONS,
    TIMES,
    VARIANTS,
)
from usdvol_lint.model import UsageError
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.releases import release, required_version
from usdvol_lint.words import shortened

if TYPE_CHECKING:
    from usdvol_lint.config.per_path import PerPath
    from usdvol_lint.suppressions import Suppression

LONGEST_TIMEOUT = 1_000_000
_LARGEST = (1 << 63) - 1
"""As TOML has it: Python shows no number of some thousand digits."""
_LONGEST_SHOWN = 100
"""Of a longer pattern the middle is left out in a message."""
_SIZES = {"": 1, "K": 1 << 10, "M": 1 << 20, "G": 1 << 30, "T": 1 << 40}
_NO_SIZES = {"auto": None, "none": 0, "0": 0}
_NO_LEVELS = ("ignore", "ignored", "off", "none", "never", False)
"""What somebody writes for the severity of a rule that is to report nothing."""


def plain(where: str, value: Any, has_nul: bool = False) -> None:
    """Raises UsageError if something in a value can be no path, no name and no number of a setting.

    `has_nul` is for the options of rules, which may have any text.
    """
    match value:
        case dict():
            for name, inner in value.items():
                plain(where, name, has_nul)
                plain(where, inner, has_nul)
        case list():
            for item in value:
                plain(where, item, has_nul)
        case str() if "\0" in value and not has_nul:
            raise UsageError(f"{where} has a NUL character, which nothing is called: leave it out")
        case int() if abs(value) > _LARGEST:
            raise UsageError(f"{where} has a number of more than 64 bits, which no setting is")


def strings(where: str, value: Any) -> list[str]:
    """The value, if it is a list of strings."""
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise UsageError(f"{where} must be a list of strings, not {value!r}")
    return value


def one_of(where: str, value: Any, allowed: tuple[str, ...]) -> str:
    """The value, if it is one of those allowed."""
    if value in allowed:
        return str(value)
    hint = did_you_mean(value, allowed) if isinstance(value, str) else ""
    raise UsageError(f"{where} must be one of {', '.join(allowed)}, not {value!r}{hint}")


def level(where: str, value: Any) -> str:
    """The value, if it is the name of a severity."""
    if value in _NO_LEVELS:
        said = f"not {value!r}; a rule that is to report nothing stands in `ignore`"
        raise UsageError(f"{where} must be one of {', '.join(LEVELS)}, {said}")
    return one_of(where, value, LEVELS)


def filled(where: str, value: Any) -> tuple[str, ...]:
    """The value, if it is a list of strings none of which is empty."""
    given = tuple(strings(where, value))
    if not all(map(str.strip, given)):
        raise UsageError(f"{where} has an empty string, which names nothing: leave it out")
    return given


def shown(where: str, value: Any) -> tuple[str, ...]:
    """The value, if it is a list of what reports for people can show."""
    return tuple(one_of(where, word, SHOWABLE) for word in strings(where, value))


def table(where: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise UsageError(f"{where} must be a table, not {value!r}")
    return value


def levels(where: str, value: Any) -> dict[str, str]:
    return {code: level(f"{where}.{code}", name) for code, name in table(where, value).items()}


def _tables(where: str, value: Any) -> dict[str, dict[str, Any]]:
    return {
        rule: table(f"{where}.{rule}", options) for rule, options in table(where, value).items()
    }


def _boolean(where: str, value: Any) -> bool:
    if not isinstance(value, bool):
        raise UsageError(f"{where} must be true or false, not {value!r}")
    return value


def _text(where: str, value: Any) -> str:
    if not isinstance(value, str):
        raise UsageError(f"{where} must be a text, not {value!r}")
    if not value:
        raise UsageError(f"{where} must not be empty: leave it out")
    return value


def _pattern(where: str, value: Any) -> str:
    """The value, if it is a regular expression."""
    import re  # few configurations have one

    shown = shortened(repr(value), _LONGEST_SHOWN)
    try:
        re.compile(_text(where, value))
    except (re.error, RecursionError, OverflowError) as error:
        why = "it is nested too deep" if isinstance(error, RecursionError) else error
        raise UsageError(f"{where}: {shown} is no regular expression: {why}") from error
    if re.match(r"\(\?[aiLmsux]+\)", value):
        raise UsageError(f"{where}: {shown} has flags for all of a path: write '(?i:…)' around it")
    if re.match(r"\^|\\A|.*(?<!\\)(\\\\)*(\$|\\[zZ])\Z", value, re.DOTALL):
        why = "leave it out, for the pattern has to match all between two separators of a path"
        raise UsageError(f"{where}: {shown} begins or ends with '^' or '$': {why}")
    return str(value)


def _suppress(where: str, value: Any) -> tuple[Suppression, ...]:
    from usdvol_lint.suppressions import read_tables  # few configurations have one

    return read_tables(where, value)


def _per_path(where: str, value: Any) -> tuple[PerPath, ...]:
    from usdvol_lint.config.per_path import read_per_path

    return read_per_path(where, value)


def _day(where: str, value: Any) -> str:
    from usdvol_lint.suppressions import date_of

    return date_of(where, value)


def _whole_number(where: str, value: Any, least: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise UsageError(f"{where} must be a whole number from {least}, not {value!r}")
    return value


def _timeout(where: str, value: Any) -> float:
    """The value, if it is a time limit, in seconds, that a timer takes."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not 0 < value <= LONGEST_TIMEOUT:
        wanted = f"a number of seconds above 0, at most {LONGEST_TIMEOUT:,}"
        raise UsageError(f"{where} must be {wanted}, not {value!r}")
    return float(value)


def _memory_limit(where: str, value: Any) -> str:
    """The value, if it is a size, or says that there is no limit."""
    is_number = isinstance(value, int) and not isinstance(value, bool)
    text = str(value) if is_number else value
    try:
        bytes_of(text)
    except (TypeError, ValueError):
        wanted = "a size such as 4G or 500M, or none"
        raise UsageError(f"{where} must be {wanted}, not {value!r}") from None
    return str(text)


def bytes_of(size: str) -> int | None:
    """A size in bytes, 0 for any, None for a share of what there is; raises ValueError."""
    if size in _NO_SIZES:
        return _NO_SIZES[size]
    import re  # few runs have one

    number = r"\s*(\d{1,15}(?:\.\d{1,6})?)\s*([KMGT]?)(?:I?B)?\s*"
    found = re.fullmatch(number, size, re.ASCII | re.IGNORECASE)
    if not found:
        raise ValueError(size)
    return int(float(found[1]) * _SIZES[found[2].upper()])


def _times(where: str, value: Any) -> str | int:
    """The value, if it says which time samples of particles are read."""
    if isinstance(value, str) and value.isascii() and value.isdigit():
        value = int(value)
    is_number = isinstance(value, int) and not isinstance(value, bool) and value > 0
    if value not in TIMES and not is_number:
        wanted = f"{', '.join(TIMES)} or a whole number from 1"
        raise UsageError(f"{where} must be {wanted}, not {value!r}")
    return value  # type: ignore[no-any-return]


def globs(where: str, value: Any) -> tuple[str, ...]:
    """The value, if it is a list of patterns as in a .gitignore."""
    patterns = filled(where, value)
    if patterns:
        from usdvol_lint.suppressions import check_patterns  # few configurations have one

        check_patterns(where, patterns)
    return patterns


def _path_map(where: str, value: Any) -> dict[str, str]:
    starts = table(where, value)
    if not all(starts):
        raise UsageError(f"{where} has an empty beginning, which every path has: leave it out")
    return {start: _text(f"{where}.{start}", to) for start, to in starts.items()}


def _frames(where: str, value: Any) -> tuple[float, float]:
    """The value, if it is a range of frames, FIRST-LAST."""
    import re  # few runs have one

    number = r"(-?\d+(?:\.\d+)?)"
    found = re.fullmatch(rf"\s*{number}\s*-\s*{number}\s*", value) if type(value) is str else None
    if not found:
        raise UsageError(f"{where}: write it as FIRST-LAST, such as 1001-1100, not {value!r}")
    first, last = map(float, found.groups())
    if first > last:
        raise UsageError(f"{where}: {value!r} ends before it begins")
    return first, last


CHECKS: Mapping[str, Callable[[str, Any], Any]] = {
    "extend": _text,
    "select": filled,
    "ignore": filled,
    "severity": levels,
    "options": _tables,
    "packs": filled,
    "fail-on": partial(one_of, allowed=FAIL_ON),
    "fail-on-unchecked": _boolean,
    "output-format": partial(one_of, allowed=OUTPUT_FORMATS),
    "show": shown,
    "jobs": partial(_whole_number, least=0),
    "timeout": _timeout,
    "memory-limit": _memory_limit,
    "load": partial(one_of, allowed=LOADS),
    "content": partial(one_of, allowed=CONTENTS),
    "variants": partial(one_of, allowed=VARIANTS),
    "variant-limit": partial(_whole_number, least=1),
    "times": _times,
    "statistics": _boolean,
    "max-places": partial(_whole_number, least=1),
    "root": _text,
    "version-pattern": _pattern,
    "baseline": _text,
    "required-version": required_version,
    "rules-as-of": release,
    "suppressions": partial(one_of, allowed=SUPPRESSIONS),
    "suppress": _suppress,
    "per-path": _per_path,
    "today": _day,
    "exclude": globs,
    "stages": globs,
    "frames": _frames,
    "search-path": filled,
    "assume-present": globs,
    "path-map": _path_map,
}
"""For each key of a configuration a function that returns the value for the `Config`.

It is called with where the value was given, which begins its UsageError, and the value.
"""
