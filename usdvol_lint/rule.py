"""The words rules are written in: `@rule`, `Problem`, `NotChecked`, `Facts`, `Prim`."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from dataclasses import KW_ONLY, dataclass
from enum import Enum
from typing import Any, NamedTuple, TypeAlias

from usdvol_lint.facts import Facts
from usdvol_lint.facts.files.states import AssetState, FileFault, PathMark
from usdvol_lint.facts.sums import Sums
from usdvol_lint.facts.volumes.states import BindingMark, Emptiness, TargetState
from usdvol_lint.model import Severity, format_time, frame_ranges, quoted
from usdvol_lint.schema import ABSTRACT_TYPE, STAGE, UNKNOWN_TYPE

__all__ = [
    "ABSTRACT_TYPE",
    "ERROR",
    "INFO",
    "STAGE",
    "UNKNOWN_TYPE",
    "WARNING",
    "AssetState",
    "BindingMark",
    "Content",
    "Emptiness",
    "Facts",
    "FileFault",
    "NotChecked",
    "PathMark",
    "Prim",
    "Problem",
    "Problems",
    "Rule",
    "TargetState",
    "When",
    "authored",
    "bindings",
    "contents",
    "file_paths",
    "format_time",
    "frame_ranges",
    "quoted",
    "rule",
]

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO

Prim: TypeAlias = Any
"""A `pxr.Usd.Prim`; spelt so that rules can be loaded where pxr is not imported."""

Content: TypeAlias = Any
"""A `usdvol_lint.facts.grids.contents.Content`, spelt so for the same reason."""


@dataclass(frozen=True, slots=True)
class Problem:
    """What a rule yields: what is wrong, and where.

    `at` is a `Usd.Prim` or a `Usd.Property`; the layer and line are those of its strongest
    opinion (at the first of `times`), unless `spec` names the `Sdf` spec that is to blame.
    `times` are time codes of the stage; `at_default` adds USD's default time.
    `asset` is an asset path, as authored, that stands in the layer where the line should point.
    `severity` may lower the rule's own for a milder case, never raise it.
    `holds` is asked when all of the stage was looked at, other variant selections too.
    """

    message: str
    _: KW_ONLY
    at: Any
    times: tuple[float, ...] = ()
    at_default: bool = False
    suggestion: str | None = None
    spec: Any = None
    asset: str | None = None
    severity: Severity | None = None
    holds: Callable[[], bool] | None = None


@dataclass(frozen=True, slots=True)
class NotChecked:
    """What a rule yields where it could not look: reported as LNT005, never as an error.

    The fields are those of `Problem`.
    """

    message: str
    _: KW_ONLY
    at: Any
    times: tuple[float, ...] = ()
    at_default: bool = False
    suggestion: str | None = None
    spec: Any = None
    asset: str | None = None


Problems: TypeAlias = Iterator[Problem | NotChecked]
Check: TypeAlias = Callable[..., Problems]


class When(NamedTuple):
    """What must hold for a rule to be handed a prim, so that it costs nothing on all others.

    `fact` is a method of `usdvol_lint.facts.sums.Sums`, which sums prims up; those that have a lot
    in common share what it gives, and `holds` is asked once for each such sum. It is given the
    rule's options too.
    """

    fact: str
    holds: Callable[..., bool]


def authored(*names: str) -> When:
    """When one of these attributes is authored, or has values in clips."""
    return When("authored", lambda authored: not authored.declared.keys().isdisjoint(names))


def file_paths(*marks: Enum) -> When:
    """When the values of `filePath` have one of these states or marks about them."""
    return When("file_path_marks", lambda found: not found.isdisjoint(marks))


def bindings(*marks: Enum) -> When:
    """When the `field:` namespace of a Volume has one of these states or marks about it."""
    return When("binding_marks", lambda found: not found.isdisjoint(marks))


def contents(*keys: Callable[[Content], Hashable | None]) -> When:
    """When the content of one of a field's files has one of these keys."""
    return When(
        "content_kinds",
        lambda kinds: any(kind.answer(key) is not None for kind in kinds for key in keys),
    )


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule: what it is called, which prims it is handed, and what it does with them.

    `on` are schema names: a prim type, also as a base, or an applied API.
    Three constants stand beside them: `STAGE` (handed the pseudo-root, once), `UNKNOWN_TYPE`
    (prims whose type nobody registers), `ABSTRACT_TYPE` (prims whose type may not be instantiated).
    `options` maps the names of the check's keyword-only parameters to their defaults.
    `default` is False for rules that are off until selected by name.
    `when` narrows down which of these prims it is handed; None means all of them.
    """

    code: str
    name: str
    on: tuple[str, ...]
    severity: Severity
    since: str
    check: Check
    options: dict[str, Any]
    default: bool = True
    when: When | None = None


def rule(
    code: str,
    *,
    on: str | tuple[str, ...],
    severity: Severity,
    since: str,
    default: bool = True,
    when: When | None = None,
) -> Callable[[Check], Rule]:
    """Makes the decorated generator a rule, named after it: `file_missing` is `file-missing`."""

    if when and not hasattr(Sums, when.fact):
        raise ValueError(f"{code}: there is no fact {when.fact!r} that `when` could go by")

    def decorate(check: Check) -> Rule:
        return Rule(
            code=code,
            name=check.__name__.replace("_", "-"),
            on=(on,) if isinstance(on, str) else on,
            severity=severity,
            since=since,
            check=check,
            options=dict(check.__kwdefaults__ or {}),
            default=default,
            when=when,
        )

    return decorate
