"""The nouns of a run: plain, frozen, picklable data that knows nothing of USD."""

from __future__ import annotations

import builtins
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum, StrEnum
from typing import NamedTuple


class UsageError(Exception):
    """A mistake of the user's: one line that says what, where and what to do (exit code 2)."""


class PackError(UsageError):
    """A rule pack that can't be loaded."""


def quoted(text: str) -> str:
    """Text between quotes as it stands, a backslash too; what can't be printed is escaped."""
    mark = '"' if "'" in text and '"' not in text else "'"
    return f"{mark}{printable(text)}{mark}"


def printable(text: str) -> str:
    r"""Text from a stage as one visible line: what does not print is shown as `\x1b` or `\u202e`.

    That covers control characters, line breaks, bidirectional overrides, invisible characters,
    spaces that only look like one, and bytes that were never text (`\xff`).
    """
    return text if text.isprintable() else "".join(map(_visible, text))


def _visible(char: str) -> str:
    if char.isprintable():
        return char
    point = ord(char)
    if 0xDC80 <= point <= 0xDCFF:  # a byte that Python could not decode in a file name
        point -= 0xDC00
    if point <= 0xFF:
        return f"\\x{point:02x}"
    return f"\\u{point:04x}" if point <= 0xFFFF else f"\\U{point:08x}"


class Severity(IntEnum):
    """How bad a finding is; ordered, so that thresholds are comparisons."""

    INFO = 1
    WARNING = 2
    ERROR = 3

    @property
    def label(self) -> str:
        return self.name.lower()


class Status(StrEnum):
    """What became of one stage."""

    CHECKED = "checked"
    UNREADABLE = "unreadable"
    CRASHED = "crashed"
    TIMED_OUT = "timed_out"


@dataclass(frozen=True, slots=True)
class Site:
    """Where a finding is: the layer that holds the opinion, the composed prim, the frames.

    `layer` is relative to the working directory, with `/`.
    `variant` is where in its layer the opinion is, `look=thin`, or, for what the stage shows only
    under another selection than the authored one, that selection: `/model{look=thin}`.
    `line` and `column` are 1-based and None in binary layers.
    `times` are time codes of the stage, ascending; `at_default` says that USD's default time
    is affected too.
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
        """The time codes as ranges, `102-104, 117`; None where time plays no part."""
        if not self.times:
            return None
        ranges = frame_ranges(self.times)
        return f"default, {ranges}" if self.at_default else ranges


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that is wrong, ready to be reported."""

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


class ParticleFieldStats(NamedTuple):
    """What one particle field holds, over all the time samples that were looked at.

    `count` is the greatest number of particles at one time, `bytes` what its arrays take in all.
    `precision` is `float`, `half` or `mixed`, `bounds` are the corners that enclose all positions.
    `opacity` and `scale` are quantiles by name, from `min` to `max`, `transparent` is the share of
    particles that are as good as invisible.
    What there is no array for is None.
    """

    prim: str
    count: int  # type: ignore[assignment]  # in the place of what tuples call so
    sh_degree: int | None
    bytes: int
    precision: str | None
    bounds: tuple[tuple[float, ...], tuple[float, ...]] | None
    opacity: dict[str, float] | None
    scale: dict[str, float] | None
    transparent: float | None


class StageReport(NamedTuple):
    """What one stage came to.

    `path` is the stage as the user gave it or as it was found in a folder.
    `stats` counts what was looked at, `seconds` are wall-clock by phase.
    `particle_fields` is None unless statistics were asked for.
    """

    path: str
    status: Status
    # One empty dictionary for all: a Mapping is not written to, and a MappingProxyType can't be
    # pickled, which a worker does with its reports.
    stats: Mapping[str, int] = {}
    findings: tuple[Finding, ...] = ()
    seconds: Mapping[str, float] = {}
    particle_fields: tuple[ParticleFieldStats, ...] | None = None


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
    """A whole run: everything that any output format prints."""

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


def format_time(time: float) -> str:
    """A time code as people write it: `101`, `101.5`, never `101.0`."""
    rounded = round(time, 6)
    return str(int(rounded)) if rounded.is_integer() and abs(rounded) < 2**53 else repr(rounded)


def frame_ranges(times: Sequence[float]) -> str:
    """Ascending time codes as ranges: `102-104, 117`; every second frame is `0-10x2`."""
    parts: list[str] = []
    start = 0
    while start < len(times):
        stop = _run_end(times, start)
        step = times[start + 1] - times[start] if stop - start > 1 else 0.0
        if stop - start > 2 or _same(step, 1.0):
            suffix = "" if _same(step, 1.0) else f"x{format_time(step)}"
            parts.append(f"{format_time(times[start])}-{format_time(times[stop - 1])}{suffix}")
            start = stop
        else:
            parts.append(format_time(times[start]))
            start += 1
    return ", ".join(parts)


def _run_end(times: Sequence[float], start: int) -> int:
    """One past the last of the evenly spaced times that begin at `start`."""
    stop = start + 2
    if stop > len(times):
        return len(times)
    step = times[start + 1] - times[start]
    while stop < len(times) and _same(times[stop] - times[stop - 1], step):
        stop += 1
    return stop


def _same(one: float, other: float) -> bool:
    return abs(one - other) < 1e-6


def with_fingerprints(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Findings sorted, without repetitions, each with its fingerprint.

    A fingerprint is made of code, layer, prim and property, so it survives other machines, other
    runs and unrelated edits; findings that share all four are numbered in their order.
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
        stamped.append(replace(finding, fingerprint=_digest(text)))
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
