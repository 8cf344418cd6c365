"""The data of a run, plain, frozen and picklable, and how it is written; nothing of USD."""

from __future__ import annotations

import builtins
from collections import Counter
from collections.abc import Iterable, Mapping
from enum import IntEnum, StrEnum
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


class Site(NamedTuple):
    """Where a finding is: the layer with the opinion, the composed prim, the time codes.

    `layer` is relative to the working directory, with `/`.
    `variant` is the variant in which the opinion is authored, `look=thin`; or, for what is so only
    under another selection than the authored one, that selection: `/model{look=thin}`.
    `line` and `column` count from 1 and are None in binary layers.
    `times` are time codes of the stage, ascending; `at_default` adds USD's default time.
    """

    layer: str
    prim: str | None = None
    property: str | None = None
    variant: str | None = None
    line: int | None = None
    column: int | None = None
    times: tuple[float, ...] = ()
    at_default: bool = False

    @builtins.property
    def frames(self) -> str | None:
        """The time codes as ranges, `102-104, 117`; None if there are none."""
        if not self.times:
            return None
        ranges = frame_ranges(self.times)
        return f"default, {ranges}" if self.at_default else ranges


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
    """One problem, ready to be reported."""

    code: str
    name: str
    severity: Severity
    message: str
    site: Site
    suggestion: str | None = None
    help: str | None = None
    detail: str | None = None
    """What `--verbose` may add, such as a traceback."""
    fingerprint: str = ""
    faulty_rule: str | None = None
    """The code of a rule, where this is about that rule and no stage: reported once in a run."""
    absent: tuple[frozenset[Lack], ...] = ()
    """What is absent, if nothing else is wrong: of each set one has to be completed elsewhere."""


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
    """The result for one stage.

    `path` is the stage as the user named it or as it was found in a folder.
    `stats` are counts by name, such as `volumes`; `seconds` is wall-clock time by phase.
    `particle_fields` is None unless statistics were asked for.
    `completes` is None where no layer lacks what the stage has.
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


class Summary(NamedTuple):
    """Counts over all stages."""

    stages: int
    errors: int
    warnings: int
    infos: int
    by_code: dict[str, int]
    by_status: dict[str, int]
    stats: dict[str, int]
    stages_with_findings: int

    @property
    def findings(self) -> int:
        return self.errors + self.warnings + self.infos


class Report(NamedTuple):
    """The result of a run: all that the output formats print."""

    version: str
    usd_version: str | None
    settings: dict[str, object]
    stages: tuple[StageReport, ...]
    seconds: float

    @property
    def summary(self) -> Summary:
        findings = [finding for stage in self.stages for finding in stage.findings]
        severities = Counter(finding.severity for finding in findings)
        stats: Counter[str] = Counter()
        for stage in self.stages:
            stats.update(stage.stats)
        return Summary(
            stages=len(self.stages),
            errors=severities[Severity.ERROR],
            warnings=severities[Severity.WARNING],
            infos=severities[Severity.INFO],
            by_code=dict(sorted(Counter(finding.code for finding in findings).items())),
            by_status=dict(sorted(Counter(str(stage.status) for stage in self.stages).items())),
            stats=dict(sorted(stats.items())),
            stages_with_findings=sum(1 for stage in self.stages if stage.findings),
        )


def with_fingerprints(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """The findings, sorted and without duplicates, each with its fingerprint.

    A fingerprint is a hash of code, layer, prim, property and variant, so it is the same on other
    machines, in other runs and after unrelated edits; findings that share all five are numbered.
    """
    stamped: list[Finding] = []
    seen: Counter[tuple[str | None, ...]] = Counter()
    for finding in sorted(dict.fromkeys(findings), key=_order):
        site = finding.site
        identity = (finding.code, site.layer, site.prim, site.property, site.variant)
        text = "\0".join(part or "" for part in identity)
        if seen[identity]:
            text += f"\0{seen[identity]}"
        seen[identity] += 1
        stamped.append(finding._replace(fingerprint=_digest(text)))
    return tuple(stamped)


def _digest(text: str) -> str:
    from hashlib import sha256  # costs start-up time, and clean stages need none

    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]


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
