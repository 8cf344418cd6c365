"""What a stage came to, as plain, frozen and picklable data that knows nothing of USD."""

from __future__ import annotations

import builtins
from collections.abc import Iterable, Mapping
from enum import IntEnum, StrEnum
from operator import eq, itemgetter
from typing import NamedTuple, TypeAlias

from usdvol_lint.words import frame_ranges


class UsageError(Exception):
    """A mistake of the user's, in one line: what, where and what to do (exit code 2)."""


class PackError(UsageError):
    """A rule pack that can't be loaded."""


class Severity(IntEnum):
    """How bad a finding is; ordered, so that thresholds are comparisons."""

    INFO = 1
    WARNING = 2
    ERROR = 3

    @property
    def label(self) -> str:
        return self.name.lower()


class Status(StrEnum):
    """Whether one stage was checked, or why not."""

    CHECKED = "checked"
    UNREADABLE = "unreadable"
    CRASHED = "crashed"
    TIMED_OUT = "timed_out"
    UNCHECKED = "unchecked"


class Excerpt(NamedTuple):
    """A line of a text layer without its indent, or a part of it; `column` counts from 1 there."""

    text: str
    column: int


class Site(NamedTuple):
    """Where a finding is seen: the layer and line to look at, the composed prim, the time codes.

    `layer` is relative to the working directory, with `/`.
    `variant` is the variant in which the opinion is authored, `look=thin`; or, for what is so only
    under another selection than the authored one, that selection: `/model{look=thin}`.
    `line` and `column` count from 1 and are None in binary layers.
    `times` are time codes of the stage, ascending; `at_default` adds USD's default time.
    `entry` are line and column in the stage's own file through which a layer comes in that a code
    host does not have, where that was asked for.
    """

    layer: str
    prim: str | None = None
    property: str | None = None
    variant: str | None = None
    line: int | None = None
    column: int | None = None
    times: tuple[float, ...] = ()
    at_default: bool = False
    excerpt: Excerpt | None = None
    entry: tuple[int, int] | None = None

    @builtins.property
    def frames(self) -> str | None:
        """The time codes as ranges, `102-104, 117`; None if there are none."""
        if not self.times:
            return None
        ranges = frame_ranges(self.times)
        return f"default, {ranges}" if self.at_default else ranges


class Source(NamedTuple):
    """What is to blame: a spec in a layer.  It is the same wherever and however often it shows.

    `layer` is the real path of the layer's file, in a package `x.usdz[inner.usda]`, or the
    identifier of a layer without a file; None where the machine is to blame.
    `path` is the spec's own path in that layer, with the variants that it stands in.
    `subject` tells what stands at one spec apart, such as the name of a token.
    """

    layer: str | None
    path: str | None = None
    property: str | None = None
    subject: str = ""


class Cover(NamedTuple):
    """How much of what is to blame a finding covers: more than before is worse.

    `frames` are time codes of the layer to blame, for clips that which names them, ascending;
    None are all that there are, or ever will be.  `at_default` adds the default time.
    `share` is the share of an array's elements that is concerned, and `elements` how many it has
    at one time; None without an array.
    `level` is the rule's own, whatever a configuration makes of it.
    """

    level: Severity
    frames: tuple[float, ...] | None = None
    at_default: bool = False
    share: float | None = None
    elements: int | None = None


Lack: TypeAlias = tuple[str, str, str]
"""The path of a layer, that of a spec there, and what this lacks: a property or a field of it."""


class Completed(NamedTuple):
    """What specs at `path` in some layers lack, and the stage has."""

    layers: tuple[str, ...]
    path: str
    lacking: tuple[str, ...]


class Completion(NamedTuple):
    """What a stage brings to layers that lack it; `layers` are all those below its root."""

    layers: tuple[str, ...]
    specs: tuple[Completed, ...]


class Finding(NamedTuple):
    """One problem as one stage shows it."""

    code: str
    name: str
    severity: Severity
    message: str
    site: Site
    source: Source
    cover: Cover
    suggestion: str | None = None
    help: str | None = None
    detail: str | None = None
    """What `--verbose` may add, such as a traceback."""
    fold: str | None = None
    """A report for people tells findings of a rule with the same key, on one stage, in one line."""
    absent: tuple[frozenset[Lack], ...] = ()
    """What is absent, if nothing else is wrong: of each set one has to be completed elsewhere."""
    ignored: str | None = None
    """The reason why a suppression, in the stage or the configuration, ignores it."""
    since: str | None = None
    """The version in which the rule came to see this, where that is younger than the rule."""


class ParticleFieldStats(NamedTuple):
    """Figures about one particle field, over all the time samples that were read.

    `count` is the greatest number of particles at one time, `bytes` the size of all its arrays.
    `precision` is `float`, `half` or `mixed`, `bounds` are the corners that enclose all positions.
    `opacity` and `scale` are quantiles by name, from `min` to `max`; `transparent` is the share,
    from 0 to 1, of particles that are practically invisible.
    A figure is None if the array it is computed from is missing.
    """

    prim: str
    count: int  # type: ignore[assignment]  # hides tuple.count
    sh_degree: int | None
    bytes: int
    precision: str | None
    bounds: tuple[tuple[float, ...], tuple[float, ...]] | None
    opacity: dict[str, float] | None
    scale: dict[str, float] | None
    transparent: float | None


class StageReport(NamedTuple):
    """What a worker process found on one stage.

    `path` is the stage as the user named it or as it was found in a folder.
    `stats` are counts by name, such as `volumes`; `seconds` is wall-clock time by phase.
    `particle_fields` is None unless statistics were asked for.
    `completes` is None where no layer lacks what the stage has.
    One that `is_unchanged` was not checked, for it uses none of the files that changed.
    """

    path: str
    status: Status
    # One empty dictionary for all: a Mapping is not written to, and a MappingProxyType can't be
    # pickled, which a worker does with its reports.
    stats: Mapping[str, int] = {}
    findings: tuple[Finding, ...] = ()
    seconds: Mapping[str, float] = {}
    particle_fields: tuple[ParticleFieldStats, ...] | None = None
    completes: Completion | None = None
    is_unchanged: bool = False


def in_order(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """The findings of a stage by prim, property and place, without duplicates."""
    keyed = sorted(((_order(each), each) for each in findings), key=itemgetter(0))
    orders, ordered = zip(*keyed, strict=True) if keyed else ((), ())
    # To hash them takes as long as to sort them, and equal ones lie beside each other.
    return tuple(dict.fromkeys(ordered)) if any(map(eq, orders, orders[1:])) else ordered


def _order(finding: Finding) -> tuple[object, ...]:
    site = finding.site
    return (
        site.prim or "",
        site.property or "",
        site.layer,
        site.line or 0,
        site.column or 0,
        finding.code,
        site.variant or "",
        site.times,
        site.at_default,
        finding.severity,
        finding.message,
        finding.suggestion or "",
        finding.detail or "",
    )
