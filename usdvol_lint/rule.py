"""The words rules are written in: `@rule`, `Problem`, `NotChecked`, `Facts`, `Prim`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import KW_ONLY, dataclass
from typing import Any, TypeAlias

from usdvol_lint.facts import Facts
from usdvol_lint.facts.states import AssetState, Emptiness, FileFault, TargetState
from usdvol_lint.model import Severity, format_time, frame_ranges
from usdvol_lint.schema import ABSTRACT_TYPE, STAGE, UNKNOWN_TYPE

__all__ = [
    "ABSTRACT_TYPE",
    "ERROR",
    "INFO",
    "STAGE",
    "UNKNOWN_TYPE",
    "WARNING",
    "AssetState",
    "Content",
    "Emptiness",
    "Facts",
    "FileFault",
    "NotChecked",
    "Prim",
    "Problem",
    "Problems",
    "Rule",
    "TargetState",
    "format_time",
    "frame_ranges",
    "rule",
]

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO

Prim: TypeAlias = Any
"""A `pxr.Usd.Prim`; spelt so that rules can be loaded where pxr is not imported."""

Content: TypeAlias = Any
"""A `usdvol_lint.facts.contents.Content`, spelt so for the same reason."""


@dataclass(frozen=True, slots=True)
class Problem:
    """What a rule yields: what is wrong, and where.

    `at` is a `Usd.Prim` or a `Usd.Property`; the layer and line are those of its strongest
    opinion (at the first of `times`), unless `spec` names the `Sdf` spec that is to blame.
    `times` are time codes of the stage; `at_default` adds USD's default time.
    `asset` is an asset path, as authored, that stands in the layer where the line should point.
    `severity` may lower the rule's own for a milder case, never raise it.
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


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule: what it is called, which prims it is handed, and what it does with them.

    `on` are schema names: a prim type, also as a base, or an applied API.
    Three constants stand beside them: `STAGE` (handed the pseudo-root, once), `UNKNOWN_TYPE`
    (prims whose type nobody registers), `ABSTRACT_TYPE` (prims whose type may not be instantiated).
    `options` maps the names of the check's keyword-only parameters to their defaults.
    `default` is False for rules that are off until selected by name.
    """

    code: str
    name: str
    on: tuple[str, ...]
    severity: Severity
    since: str
    check: Check
    options: dict[str, Any]
    default: bool = True


def rule(
    code: str,
    *,
    on: str | tuple[str, ...],
    severity: Severity,
    since: str,
    default: bool = True,
) -> Callable[[Check], Rule]:
    """Makes the decorated generator a rule, named after it: `file_missing` is `file-missing`."""

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
        )

    return decorate
