"""What a dictionary `usdvolLint` says is to be ignored, and what is wrong with it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple, TypeAlias

from usdvol_lint.nearest import did_you_mean
from usdvol_lint.packs.catalog import NOT_IGNORABLE
from usdvol_lint.rule import Rule
from usdvol_lint.suppressions import is_date, is_over
from usdvol_lint.words import quoted

KEY, IGNORE = "usdvolLint", "ignore"
TAKEN_BACK = ""
"""The reason that takes back what a weaker layer or a prim above ignores."""

_DATED = re.compile(r"(?is)until\s+(?P<day>\d+[-./]\d[\d./-]*)\s*:?\s*(?P<reason>.*)")
_SHAPE = 'write dictionary usdvolLint = { dictionary ignore = { string CODE = "why" } }'
_KINDS = ((bool, "a bool"), (int | float, "a number"), (dict, "a dictionary"), (str, "a text"))

Keys: TypeAlias = tuple[str, ...]


class Fault(NamedTuple):
    """What is wrong with the value below some keys, and what to do about it."""

    keys: Keys
    message: str
    suggestion: str | None = None


class Said(NamedTuple):
    """The reasons by code, TAKEN_BACK among them, and what is wrong."""

    reasons: Mapping[str, str]
    faults: tuple[Fault, ...]


def read(data: Any, rules: Mapping[str, Rule], today: str | None) -> Said:
    """What a value of the key `usdvolLint` says; `rules` are all there are, by code.

    Values that USD can't read are None, and say nothing: they are told of as what can't be read.
    """
    reasons: dict[str, str] = {}
    faults: list[Fault] = []
    ignored = data.get(IGNORE, {}) if isinstance(data, dict) else {}
    faults += _misshapen(data)
    if isinstance(ignored, dict):
        for code, value in ignored.items():
            if value is None:
                continue
            fault = _no_code(code, rules) or _no_reason(code, value, today)
            if fault:
                faults.append(Fault((KEY, IGNORE, code), *fault))
            else:
                reasons[code] = value.strip()
    return Said(reasons, tuple(faults))


def nothing_to_take_back(code: str) -> Fault:
    return Fault(
        (KEY, IGNORE, code),
        f"{code} is ignored here without a reason, and nothing else ignores it that this takes "
        "back",
        "say why in its value, or take it out",
    )


def matched_nothing(code: str, reason: str) -> Fault:
    return Fault(
        (KEY, IGNORE, code),
        f"{code} is ignored here, and nothing is found that this suppresses: {quoted(reason)}",
        "take it out, unless another stage or selection needs it",
    )


def _misshapen(data: Any) -> Iterator[Fault]:
    if not isinstance(data, dict):
        message = f"{KEY!r} is {_kind(data)}, not a dictionary: it ignores nothing"
        yield Fault((KEY,), message, _SHAPE)
        return
    for key in data:
        if key != IGNORE:
            message = f"{KEY!r} has a key {quoted(key)}, which means nothing"
            yield Fault((KEY, key), message, f"all it can have is {IGNORE!r}")
    if not isinstance(data.get(IGNORE) or {}, dict):
        found = _kind(data[IGNORE])
        yield Fault(
            (KEY, IGNORE),
            f"{IGNORE!r} in {KEY!r} is {found}, not a dictionary: it ignores nothing",
            _SHAPE,
        )


_Wrong: TypeAlias = tuple[str, str | None]


def _no_code(code: str, rules: Mapping[str, Rule]) -> _Wrong | None:
    """What is wrong with a key that has to be the code of a rule."""
    if code in NOT_IGNORABLE:
        return f"{code} can't be ignored: it says that the job was not done", "take it out"
    if code in rules:
        return None
    by_name = {rule.name: rule.code for rule in rules.values()}
    meant = by_name.get(code.lower().replace("_", "-")) or code.upper()
    if meant in rules:
        return f"{quoted(code)} is not the code of a rule: it ignores nothing", f"write {meant!r}"
    is_prefix = any(rule.startswith(meant) for rule in rules)
    hint = "" if is_prefix else did_you_mean(meant, rules).removeprefix("; ")
    each = "write a key for each code, such as AST002"
    return f"there is no rule {quoted(code)} to ignore", hint or each


def _no_reason(code: str, value: Any, today: str | None) -> _Wrong | None:
    """What is wrong with a value that has to be a reason, or TAKEN_BACK."""
    if not isinstance(value, str):
        found = _kind(value)
        return f"the reason why {code} is ignored is {found}, not a text", "write it as a string"
    if value.strip().lower().rstrip(":") == "until":
        return f"{code} is ignored until no day", "write 'until YYYY-MM-DD: ' and the reason"
    dated = _DATED.match(value.strip())
    if not dated:
        return None
    day = dated["day"]
    if not is_date(day):
        return (
            f"{code} is ignored until {quoted(day)}, which is no date: it ignores nothing",
            "write 'until YYYY-MM-DD: ' and the reason",
        )
    if not dated["reason"]:
        return f"{code} is ignored until {day} without a reason", "say why after the date"
    if is_over(day, today):
        said = quoted(dated["reason"])
        return f"{code} was ignored until {day}, which is over: {said}", "mend it, or take this out"
    return None


def _kind(value: Any) -> str:
    names = (name for kind, name in _KINDS if isinstance(value, kind))
    return next(names, "a list" if hasattr(value, "__len__") else f"of type {type(value).__name__}")
