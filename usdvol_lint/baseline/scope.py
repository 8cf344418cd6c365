"""What a run looked at, and whether another one looked at all of that."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from usdvol_lint.baseline.values import found, list_of, string, table_of
from usdvol_lint.config import CONTENTS, LEVELS, LOADS, TIMES, VARIANTS
from usdvol_lint.model import Status, UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE
from usdvol_lint.results import Report, State
from usdvol_lint.words import printable

_NAMED = 3
_NARROWING = ("exclude", "stages", "frames", "assume_present")


class Scope(NamedTuple):
    """What a run looked at: its arguments, named as layers are, the rules in force, and how deep.

    `arguments` is None where nobody said.
    `narrowing` are settings that leave something out, each as a configuration has it.
    """

    arguments: tuple[str, ...] | None
    rules: Mapping[str, str]
    load: str = "all"
    content: str = "all"
    times: str | int = "all"
    variants: str = "selected"
    variant_limit: int = 0
    narrowing: tuple[str, ...] = ()


def scope_of(report: Report) -> Scope:
    """What the run looked at that came to this report."""
    return scope_from_json("the run", report.settings, report.arguments)


def scope_from_json(
    where: str, settings: Mapping[str, Any], arguments: Sequence[str] | None
) -> Scope:
    """The scope in the `settings` of a report or of the first line of a baseline."""
    rules = table_of(where, settings, "rules")
    limit = settings.get("variant_limit", 0)
    if not isinstance(limit, int) or not all(level in LEVELS for level in rules.values()):
        raise UsageError(f"{where}: 'rules' must be levels by code, 'variant_limit' a number")
    return Scope(
        arguments=None if arguments is None else outermost(arguments),
        rules=rules,
        load=_one_of(where, settings, "load", LOADS),
        content=_one_of(where, settings, "content", CONTENTS),
        times=_times(where, settings),
        variants=_one_of(where, settings, "variants", VARIANTS),
        variant_limit=limit,
        narrowing=tuple(_narrowing(settings)),
    )


def _narrowing(settings: Mapping[str, Any]) -> Iterator[str]:
    """What a run leaves out; the first line of a baseline has it as it was found."""
    for each in settings.get("narrowing", ()):
        yield str(each)
    for key in _NARROWING:
        if value := settings.get(key):
            yield f"{key.replace('_', '-')} = {value}"


def arguments_from_json(where: str, table: Mapping[str, Any]) -> tuple[str, ...]:
    arguments = list_of(where, table, "arguments")
    if not all(isinstance(argument, str) for argument in arguments):
        raise UsageError(f"{where}: 'arguments' must be a list of texts")
    return tuple(arguments)


def _one_of(where: str, settings: Mapping[str, Any], key: str, allowed: tuple[str, ...]) -> str:
    value = string(where, settings, key)
    if value not in allowed:
        wanted = ", ".join(allowed)
        raise UsageError(f"{where}: {key!r} must be one of {wanted}, {found(settings, key)}")
    return value


def _times(where: str, settings: Mapping[str, Any]) -> str | int:
    value = settings.get("times")
    return value if type(value) is int else _one_of(where, settings, "times", TIMES)


def scope_as_json(scope: Scope) -> dict[str, object]:
    """The scope as the first line of a baseline has it."""
    settings = scope._asdict()
    arguments = settings.pop("arguments")
    if not scope.narrowing:
        del settings["narrowing"]
    return {"arguments": arguments, "settings": settings}


def widest(one: Scope, other: Scope) -> Scope:
    """What a run has to look at that covers both."""
    arguments = (one.arguments, other.arguments)
    return Scope(
        arguments=None if None in arguments else outermost(arguments[0] + arguments[1]),  # type: ignore[operator]
        rules=dict(sorted({**one.rules, **other.rules}.items())),
        load=_deeper(LOADS, one.load, other.load),
        content=_deeper(CONTENTS, one.content, other.content),
        times=_more_times(one.times, other.times),
        variants=max(one.variants, other.variants, key=VARIANTS.index),
        variant_limit=max(one.variant_limit, other.variant_limit),
        narrowing=tuple(each for each in one.narrowing if each in other.narrowing),
    )


def _deeper(values: tuple[str, ...], one: str, other: str) -> str:
    """Of two values of a setting the one that looks at more, which stands first."""
    return min(one, other, key=values.index)


def _more_times(one: str | int, other: str | int) -> str | int:
    covering = (each for each, less in ((one, other), (other, one)) if _has_times(each, less))
    return next(covering, "all")


def _has_times(now: str | int, was: str | int) -> bool:
    """Whether the time samples that were read are among those now; numbers of them are spread."""
    return now in ("all", was) or was == "first" or (was == "ends" and now not in ("first", 1))


def outermost(arguments: Iterable[str]) -> tuple[str, ...]:
    """The arguments in order, without those that lie in others."""
    ordered = sorted(set(arguments))
    return tuple(
        each
        for each in ordered
        if not any(other != each and lies_in(each, other) for other in ordered)
    )


def lies_in(path: str, folder: str) -> bool:
    """Whether a search of the folder finds what lies at the path; it skips what is hidden."""
    if path == folder:
        return True
    inside = path if folder == "." else path.removeprefix(f"{folder.rstrip('/')}/")
    is_inside = not inside.startswith("/") and (folder == "." or inside != path)
    return is_inside and not any(part.startswith(".") for part in inside.split("/"))


def lacking(was: Scope, now: Scope, root: str | None) -> Iterator[str]:
    """In words what a run did not look at, that the scope of a baseline has."""
    if was.arguments is None:
        yield "nothing says what the baseline was made of"
    yield from _named(list(_unchecked(was, now, root)), "not checked: {}")
    yield from _named(sorted(was.rules.keys() - now.rules.keys()), "not in force: {}")
    if LOADS.index(now.load) > LOADS.index(was.load):
        yield _instead("load", now.load, was.load)
    if CONTENTS.index(now.content) > CONTENTS.index(was.content):
        yield _instead("content", now.content, was.content)
    if not _has_times(now.times, was.times):
        yield _instead("times", now.times, was.times)
    yield from _lacking_variants(was, now)
    yield from (each for each in now.narrowing if each not in was.narrowing)


def _unchecked(was: Scope, now: Scope, root: str | None) -> Iterator[str]:
    """The arguments that a run leaves out; what is not there any more, nobody can check."""
    for path in was.arguments or ():
        is_covered = any(lies_in(path, argument) for argument in now.arguments or ())
        if not is_covered and os.path.lexists(os.path.join(root or "", path)):
            yield path


def _lacking_variants(was: Scope, now: Scope) -> Iterator[str]:
    if VARIANTS.index(now.variants) < VARIANTS.index(was.variants):
        yield _instead("variants", now.variants, was.variants)
    elif was.variants == "all" and now.variant_limit < was.variant_limit:
        yield f"variant-limit = {now.variant_limit} instead of {was.variant_limit}"


def _instead(option: str, now: object, was: object) -> str:
    return f"--{option} {now} instead of {was}"


def not_done(report: Report) -> Iterator[str]:
    """In words what a run could not look at, though it was asked to."""
    paths = [stage.path for stage in report.stages if stage.status is not Status.CHECKED]
    yield from _named(paths, "not read: {}")
    failed = {
        report.stages[place.stage].path
        for cause in report.causes
        if cause.code in NOT_IGNORABLE and cause.state is not State.SUPPRESSED
        for place in cause.places
    }
    yield from _named(sorted(failed.difference(paths)), "a rule failed on {}")


def _named(names: Sequence[str], words: str) -> Iterator[str]:
    """The words with the first few names, if there is one."""
    if names:
        more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
        yield words.format(printable(", ".join(names[:_NAMED]))) + more
