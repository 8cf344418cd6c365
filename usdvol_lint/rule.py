"""What rules are written with: `@rule`, `Problem`, `NotChecked`, `Facts`, preconditions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias

from usdvol_lint import schema
from usdvol_lint.facts import Facts
from usdvol_lint.facts.files import Files
from usdvol_lint.facts.files.states import AssetState, FileFault, PathMark
from usdvol_lint.facts.grids import Grids
from usdvol_lint.facts.prims import Prims
from usdvol_lint.facts.volumes import Volumes
from usdvol_lint.facts.volumes.states import BindingMark, Emptiness, TargetState
from usdvol_lint.model import Severity
from usdvol_lint.precondition import (
    When,
    authored,
    bindings,
    check_precondition,
    contents,
    file_paths,
    layered,
)
from usdvol_lint.schema import ABSTRACT_TYPE, STAGE, UNKNOWN_TYPE
from usdvol_lint.words import format_time, frame_ranges, quoted

__all__ = [
    "ABSTRACT_TYPE",
    "APIS",
    "CLIPS",
    "ERROR",
    "INFO",
    "NAME",
    "OURS",
    "STAGE",
    "TYPE",
    "UNKNOWN_TYPE",
    "VALUED_NAME",
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

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO

OURS = tuple(sorted(schema.OURS))
"""What a rule is `on` that asks for all of UsdVol: Volumes, fields and particle fields."""

CLIPS = "value clips"
TYPE, APIS, NAME, VALUED_NAME = schema.TYPE_NAME, "apiSchemas", "name", "valued name"
"""Whose opinion counts: see `Problem`."""

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
    """What a rule reports, where it shows, and what is to blame.

    `at` is a `Usd.Prim`, a `Usd.Property`, or an `Occurrence`, which brings `times`, `at_default`
    and `asset` along.
    To blame is the spec whose opinion counts at `at`, at the first of `times`: for a property that
    with its value, for a prim the weakest that makes it what it is, since what it lacks each
    stronger one merely did not bring.
    `of` asks for the opinion on something else: on TYPE, on an API, `(APIS, name)`, on metadata by
    its name, also that of a property, or on NAME, which the weakest spec of a property has, or on
    VALUED_NAME, which the weakest one has that has a value, or on the CLIPS that reach a property.
    `spec` names another `Sdf` spec, and an `of` beside it the metadata that it is about.
    `against` is what contradicts it, as prims, properties, occurrences, or pairs of a prim and such
    an `of`, or a spec of it: then the strongest spec of all is to blame, or the arc that brings
    them together.
    `machine` says that the machine lacks something, and names it: then no layer is to blame.
    `subject` tells apart what a rule reports of one spec; it holds no number, time or wording, and
    is the name of the API where there is one.
    `fold` is a key: a report for people tells problems of the rule that have it in one line.
    """

    __slots__ = (
        *("absent", "against", "asset", "at", "at_default", "cover", "fold", "holds", "machine"),
        *("message", "of", "severity", "since", "spec", "subject", "suggestion", "times"),
    )

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
        of: str | tuple[str, str] | None = None,
        against: Iterable[Any] = (),
        subject: str = "",
        fold: str | None = None,
        machine: str | None = None,
        severity: Severity | None = None,
        since: str | None = None,
        holds: Callable[[], bool] | None = None,
        absent: Iterable[tuple[tuple[Prim, str], ...]] = (),
    ) -> None:
        # What is no text here would fail where reports are written, for all stages at once.
        is_text = isinstance(message, str) and isinstance(subject, str)
        if not is_text or not (suggestion is None or isinstance(suggestion, str)):
            raise TypeError("message, suggestion and subject of a problem are text")
        self.cover = None
        if not type(at).__module__.startswith("pxr"):  # to ask a prim what it lacks takes long
            self.cover = at
            at, times, at_default, asset = at.attribute, at.times, at.at_default, at.asset
        self.message, self.suggestion, self.fold = message, suggestion, fold
        self.at, self.at_default, self.asset = at, at_default, asset
        self.times = tuple(map(float, times)) if times else ()
        self.spec, self.of, self.against = spec, of, tuple(against)
        self.subject = subject or (of[1] if isinstance(of, tuple) else "")
        self.machine, self.severity, self.since = machine, severity, since
        self.holds, self.absent = holds, tuple(absent)


class Problem(_Result):
    """What a rule yields: what is wrong, and where.

    `severity` may lower the rule's own for a milder case, never raise it.
    `since` is the version that came to see this case, where that is younger than the rule.
    `holds` is called after all variant selections were checked; if it returns False, the problem is
    not reported.
    `absent` is what is absent, if nothing is wrong: the problem is not reported where another stage
    of the run composes this one and has all of it, of each part (see `lacks`) one.
    """

    __slots__ = ()


class NotChecked(_Result):
    """What a rule could not check, and why: reported as LNT005, never as an error."""

    __slots__ = ()

    def __init__(self, message: str, **where: Any) -> None:
        if not where.keys().isdisjoint(_OF_PROBLEMS):
            raise TypeError(f"{', '.join(_OF_PROBLEMS)} are of problems only")
        super().__init__(message, **where)


_OF_PROBLEMS = ("severity", "since", "holds", "absent")
"""What only a `Problem` has: nothing is known of what was not checked."""


Problems: TypeAlias = Iterator[Problem | NotChecked]
Check: TypeAlias = Callable[..., Problems]


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

    Raises ValueError for what is no code, severity or text, and for a `when` whose keys no wing
    declares, whose options the rule lacks, or that no prim of these types ever meets.
    """
    _check_words(code, severity, since)
    types = (on,) if isinstance(on, str) else on
    if not types:
        raise ValueError(f"{code}: `on` names no type")
    if not isinstance(types, tuple) or not all(isinstance(name, str) and name for name in types):
        raise ValueError(f"{code}: `on` is the name of a type or a tuple of such, not {on!r}")
    check_precondition(code, when, types)

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


def _check_words(code: Any, severity: Any, since: Any) -> None:
    """Raises ValueError for what would fail where rules are sorted, judged or compared."""
    if not isinstance(code, str):
        raise ValueError(f"the code of a rule is a text such as 'STU001', not {code!r}")
    if not isinstance(severity, Severity):
        raise ValueError(f"{code}: `severity` is ERROR, WARNING or INFO, not {severity!r}")
    if not isinstance(since, str):
        raise ValueError(f"{code}: `since` is a text such as '0.1', not {since!r}")
