"""What rules are written with: `@rule`, `Problem`, `NotChecked`, `Facts`, preconditions."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from enum import Enum
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias

from usdvol_lint import schema
from usdvol_lint.facts import Facts
from usdvol_lint.facts.files import Files
from usdvol_lint.facts.files.states import AssetState, FileFault, PathMark
from usdvol_lint.facts.found import column, summary
from usdvol_lint.facts.grids import Grids
from usdvol_lint.facts.prims import Prims
from usdvol_lint.facts.volumes import Volumes
from usdvol_lint.facts.volumes.states import BindingMark, Emptiness, TargetState
from usdvol_lint.model import Severity, format_time, frame_ranges, quoted
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.schema import (
    ABSTRACT_TYPE,
    ATTRIBUTES,
    FIELD_ASSET,
    STAGE,
    TYPE_BASES,
    UNKNOWN_TYPE,
    VOLUME,
)

__all__ = [
    "ABSTRACT_TYPE",
    "ERROR",
    "INFO",
    "OURS",
    "STAGE",
    "UNKNOWN_TYPE",
    "WARNING",
    "AssetSample",
    "AssetState",
    "BindingMark",
    "Content",
    "ContentClass",
    "Emptiness",
    "Facts",
    "FileFault",
    "Files",
    "Grids",
    "NotChecked",
    "Occurrence",
    "ParticleArray",
    "PathMark",
    "Prim",
    "Prims",
    "Problem",
    "Problems",
    "Rule",
    "TargetState",
    "Volumes",
    "When",
    "authored",
    "bindings",
    "contents",
    "file_paths",
    "format_time",
    "frame_ranges",
    "lacks",
    "layered",
    "quoted",
    "rule",
]

if TYPE_CHECKING:
    from usdvol_lint.facts.files.assets import AssetSample
    from usdvol_lint.facts.grids.contents import Content, ContentClass
    from usdvol_lint.facts.particles.array import ParticleArray
else:
    # Rules can be loaded where pxr is not imported.
    AssetSample = Content = ContentClass = ParticleArray = Any

_ATTRIBUTES = frozenset(chain.from_iterable(ATTRIBUTES.values()))
ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO

OURS = tuple(sorted(schema.OURS))
"""What a rule is `on` that asks for all of UsdVol: Volumes, fields and particle fields."""

Prim: TypeAlias = Any
"""A `pxr.Usd.Prim`; spelt so that rules can be loaded where pxr is not imported."""


class Occurrence(Protocol):
    """Some of the values of an attribute, by their times; what most facts consist of.

    `times` are time codes of the stage; `at_default` adds USD's default time.
    `asset` is the asset path there, as authored, if the line reported should be the path's.
    """

    @property
    def attribute(self) -> Any: ...
    @property
    def times(self) -> tuple[float, ...]: ...
    @property
    def at_default(self) -> bool: ...
    @property
    def asset(self) -> str | None: ...


def lacks(prim: Prim, *names: str) -> tuple[tuple[Prim, str], ...]:
    """A part of `Problem.absent`: a prim lacks one of these properties, or words of `schema`."""
    return tuple((prim, name) for name in names)


class _Result:
    """What a rule reports, and where.

    `at` is a `Usd.Prim`, a `Usd.Property`, or an `Occurrence`, which brings `times`, `at_default`
    and `asset` along.
    The layer and line are those of the strongest opinion at `at` (and the first of `times`), unless
    `spec` names another `Sdf` spec.
    """

    __slots__ = ("asset", "at", "at_default", "message", "spec", "suggestion", "times")

    def __init__(
        self,
        message: str,
        *,
        at: Any,
        times: Iterable[float] = (),
        at_default: bool = False,
        suggestion: str | None = None,
        spec: Any = None,
        asset: str | None = None,
    ) -> None:
        # What is no text here would fail where reports are written, for all stages at once.
        if not all(isinstance(text, str) for text in (message, suggestion or "")):
            raise TypeError("message and suggestion of a problem are text")
        if hasattr(at, "at_default"):
            at, times, at_default, asset = at.attribute, at.times, at.at_default, at.asset
        self.message = message
        self.at = at
        self.times = tuple(map(float, times))
        self.at_default = at_default
        self.suggestion = suggestion
        self.spec = spec
        self.asset = asset


class Problem(_Result):
    """What a rule yields: what is wrong, and where.

    `severity` may lower the rule's own for a milder case, never raise it.
    `holds` is called after all variant selections were checked; if it returns False, the problem is
    not reported.
    `absent` is what is absent, if nothing is wrong: the problem is not reported where another stage
    of the run composes this one and has all of it, of each part (see `lacks`) one.
    """

    __slots__ = ("absent", "holds", "severity")

    def __init__(
        self,
        message: str,
        *,
        severity: Severity | None = None,
        holds: Callable[[], bool] | None = None,
        absent: Iterable[tuple[tuple[Prim, str], ...]] = (),
        **where: Any,
    ) -> None:
        super().__init__(message, **where)
        self.severity = severity
        self.holds = holds
        self.absent = tuple(absent)


class NotChecked(_Result):
    """What a rule could not check, and why: reported as LNT005, never as an error."""

    __slots__ = ()


Problems: TypeAlias = Iterator[Problem | NotChecked]
Check: TypeAlias = Callable[..., Problems]


class When(NamedTuple):
    """A precondition: the rule runs only on prims whose key `holds` accepts.

    `keys` is declared in a wing, such as `Files.path_marks`.
    `holds` is called once for each distinct key, with those of the rule's options that it has
    parameters for.
    It may accept too many keys, which costs time, but never too few, which loses findings: a rule
    has to be right without it.
    `about` is the type without which a prim has no such keys; "" if any prim has them.
    """

    keys: column[Any, Any] | summary[Any, Any]
    holds: Callable[..., bool]
    about: str = ""

    @property
    def options(self) -> tuple[str, ...]:
        """The names of the options that `holds` is given: its parameters but for the key."""
        code = getattr(self.holds, "__code__", None)
        return code.co_varnames[1 : code.co_argcount + code.co_kwonlyargcount] if code else ()


def authored(*names: str) -> When:
    """When one of these attributes is authored, or has values in clips.

    Raises ValueError for one that no schema of UsdVol, nor a base of one, declares.
    """
    unknown = [name for name in names if name not in _ATTRIBUTES]
    if unknown or not names:
        said = f"no attribute {unknown[0]!r}" if unknown else "no attribute"
        hint = did_you_mean(unknown[0], _ATTRIBUTES) if unknown else ""
        raise ValueError(f"authored: {said} of UsdVol{hint}")
    return When(Prims.authored, lambda authored: not authored.declared.keys().isdisjoint(names))


def layered() -> When:
    """When several specs make up a prim, or value clips apply to it."""
    return When(Prims.authored, lambda authored: authored.is_layered or authored.is_clipped)


def file_paths(*marks: AssetState | PathMark) -> When:
    """When the values of `filePath` have one of these states or marks."""
    _require("file_paths", marks, AssetState, PathMark)
    return When(Files.path_marks, lambda states: not states.isdisjoint(marks), FIELD_ASSET)


def bindings(*marks: BindingMark | TargetState | Emptiness) -> When:
    """When the `field:` namespace of a Volume has one of these states or marks."""
    _require("bindings", marks, BindingMark, TargetState, Emptiness)
    return When(Volumes.binding_marks, lambda states: not states.isdisjoint(marks), VOLUME)


def contents(*keys: Callable[[Content], Hashable | None]) -> When:
    """When one of these keys is not None for the content of one of a field's files."""
    if not keys or not all(map(callable, keys)):
        raise ValueError(f"contents: takes functions, not {keys!r}")
    return When(Grids.content_classes, AnyKey(keys), FIELD_ASSET)


def _require(precondition: str, marks: tuple[object, ...], *kinds: type[Enum]) -> None:
    """Raises ValueError for marks that no prim ever has, which would keep a rule from running."""
    if not marks or not all(isinstance(mark, kinds) for mark in marks):
        names = " or ".join(kind.__name__ for kind in kinds)
        raise ValueError(f"{precondition}: takes members of {names}, not {marks!r}")


class AnyKey:
    """Whether any of these keys is not None for any class of contents."""

    def __init__(self, keys: tuple[Callable[[Content], Hashable | None], ...]) -> None:
        self.keys = keys

    def __call__(self, classes: Iterable[ContentClass]) -> bool:
        return any(contents.answer(key) is not None for contents in classes for key in self.keys)


class Rule(NamedTuple):
    """One rule: what it is called, which prims it checks, and how.

    `on` are schema names: a prim type, also as a base, or an applied API; or one of `STAGE` (the
    pseudo-root, once), `UNKNOWN_TYPE` (prims whose type is not registered) and `ABSTRACT_TYPE`
    (prims whose type may not be instantiated).
    `check` is called with a prim, the facts of its stage, and the options.
    `options` maps the names of the check's keyword-only parameters to their defaults.
    `default` is False for rules that are off until selected by name.
    `when` is a precondition on the prims of `on`; None accepts all of them.
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
    """Makes a rule of the generator below it, which it is named after: `file-missing`.

    Raises ValueError for a `when` whose keys no wing declares, whose options the rule lacks, or
    that no prim of these types ever meets.
    """
    types = (on,) if isinstance(on, str) else on
    if when is not None and not isinstance(when, When):
        raise ValueError(f"{code}: `when` takes a When, not {when!r}")
    if when and not isinstance(when.keys, column | summary):
        raise ValueError(f"{code}: `when` names no column or summary of a wing, but {when.keys!r}")
    if not types:
        raise ValueError(f"{code}: `on` names no type")
    if when and when.about and all(_is_other(name, when.about) for name in types):
        raise ValueError(f"{code}: `when` is about a {when.about}, and `on` names none: {on!r}")

    def decorate(check: Check) -> Rule:
        options = dict(check.__kwdefaults__ or {})
        for name in when.options if when else ():
            if name not in options:
                raise ValueError(f"{code}: `when` asks for {name!r}, no option of the rule")
        return Rule(
            code=code,
            name=check.__name__.replace("_", "-"),
            on=types,
            severity=severity,
            since=since,
            check=check,
            options=options,
            default=default,
            when=when,
        )

    return decorate


def _is_other(name: str, about: str) -> bool:
    """Whether no prim of one of our types is one of the other."""
    related = (name, *TYPE_BASES.get(name, ())), (about, *TYPE_BASES[about])
    return name in TYPE_BASES and about not in related[0] and name not in related[1]
