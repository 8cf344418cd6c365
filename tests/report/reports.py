"""One report that has everything, the schema of the JSON format, and text without its styles."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from process import ROOT

from usdvol_lint.model import (
    Cover,
    Excerpt,
    Finding,
    ParticleFieldStats,
    Severity,
    Site,
    Source,
    StageReport,
    Status,
)
from usdvol_lint.report import Options, Writer, writer
from usdvol_lint.report.json_report import SCHEMA_VERSION
from usdvol_lint.results import BaselineUse, Cause, Place, Report, RunInfo, StageResult, State
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.folding import folded

SCHEMA: dict[str, Any] = json.loads(
    (ROOT / f"usdvol_lint/report/report-{SCHEMA_VERSION}.schema.json").read_text(encoding="utf-8")
)


def strict(schema: Any) -> Any:
    """The schema with every object closed: what is not described there fails."""
    if isinstance(schema, list):
        return list(map(strict, schema))
    if not isinstance(schema, dict):
        return schema
    closed = {"additionalProperties": False} if "required" in schema else {}
    return {**{key: strict(value) for key, value in schema.items()}, **closed}


STRICT: dict[str, Any] = strict(SCHEMA)

HELP = "https://example.org/rules"

LONG_FOLDER = "projects/feature/sequences/sq010/shots/sq010_sh0420/effects/pyro/publish/v0017"
LONG_PRIM = "/World/Effects/Pyro/Explosion_Main/Debris_Trails/Trail_0042/Simulation/Cache/Volume"


def found(
    code: str,
    name: str,
    severity: Severity,
    message: str,
    site: Site,
    cover: Cover | None = None,
    **more: Any,
) -> Finding:
    """A finding that is to blame on what stands where it is seen."""
    source = Source(site.layer, site.prim, site.property)
    return Finding(
        code, name, severity, message, site, source, cover or Cover(severity, site.times), **more
    )


MISSING = found(
    code="AST002",
    name="file-missing",
    severity=Severity.ERROR,
    message="no file at '../vdb cache/smoke.0102.vdb' (4 of 120 frames)",
    site=Site(
        layer="shots/smoke.usda",
        prim="/World/Smoke/density",
        property="filePath",
        line=31,
        column=12,
        times=(102.0, 103.0, 104.0, 117.0),
        excerpt=Excerpt("asset filePath.timeSamples = {", 7),
    ),
    suggestion="render the missing frames, or end the clip at frame 101",
    help=f"{HELP}/file-missing",
)

SMOKE = StageReport(
    path="shots/smoke.usda",
    status=Status.CHECKED,
    stats={
        "prims": 1234,
        "volumes": 11,
        "fields": 24,
        "particle_fields": 1,
        "files_checked": 31204,
    },
    findings=(
        found(
            code="STG004",
            name="units-unsaid",
            severity=Severity.WARNING,
            message="no metersPerUnit, so that densities have no scale",
            site=Site(layer="shots/smoke.usda", line=1, column=1),
            suggestion="author metersPerUnit",
        ),
        MISSING,
        MISSING._replace(
            code="GRD001",
            name="grid-missing",
            message="no grid 'density' in '../vdb/smoke.0101.vdb', which holds 'Density'",
            site=MISSING.site._replace(
                property="fieldName",
                layer=f"{LONG_FOLDER}/smoke_payload.usda",
                line=7,
                column=None,
                times=(101.5,),
                variant="{quality=high}",
            ),
            source=Source(
                f"{LONG_FOLDER}/smoke_payload.usda",
                "/Smoke{quality=high}density",
                "fieldName",
            ),
            cover=Cover(Severity.ERROR, (101.5,)),
            suggestion=None,
            help=None,
        ),
        found(
            code="FLD003",
            name="field-unused",
            severity=Severity.INFO,
            message="no volume uses this field",
            site=Site(layer=f"{LONG_FOLDER}/lib.usdc", prim=LONG_PRIM),
            suggestion=f"bind it to a volume or remove it: {LONG_PRIM} holds 24 fields more, and "
            "each of them costs time",
        ),
        found(
            code="ARR001",
            name="not-finite",
            severity=Severity.ERROR,
            message="3 of 1,000,000 values are not finite, first nan at [17]",
            site=Site(
                layer="shots/smoke.usda",
                prim="/World/Splats",
                property="primvars:opacities",
                line=88,
                column=5,
                times=(1.0, 3.0, 5.0),
                at_default=True,
            ),
        ),
    ),
    seconds={"open": 0.25, "facts": 1.0, "rules": 0.125},
)

HOSTILE = StageReport(
    path="shots/\udcff[red]evil[/red].usda",
    status=Status.CHECKED,
    stats={"prims": 1},
    findings=(
        found(
            code="SCH001",
            name="odd-name",
            severity=Severity.ERROR,
            message="'\x1b[31mred\x1b[0m' [bold]is[/bold] :boom:\r\n::error::no\u202etxet"
            "\x9b0m \ud800",
            site=Site(
                layer="shots/\udcff[red]evil[/red].usda",
                prim="/[link=x]\n/\x07",
                property="a:\x7f\u2028b",
                line=2,
                column=3,
            ),
            suggestion="rename Дым煙\N{FIRE} \x00",
        ),
    ),
)

CRASHED = StageReport(
    path="shots/crash.usd",
    status=Status.CRASHED,
    findings=(
        found(
            code="LNT001",
            name="rule-failed",
            severity=Severity.ERROR,
            message="GRD001 failed: ZeroDivisionError: division by zero",
            site=Site(layer="shots/crash.usd", prim="/World"),
            detail='Traceback:\n\tFile "grid.py", line 3\nZeroDivisionError: \x1b[5mzero\n',
        ),
    ),
)

CLEAN = StageReport(
    path="shots/clean.usda", status=Status.CHECKED, stats={"volumes": 1, "files_checked": 1}
)
TIMED_OUT = StageReport(path="shots/endless.usdc", status=Status.TIMED_OUT)
UNREADABLE = StageReport(path="shots/broken.usdz", status=Status.UNREADABLE)


def report(*stages: StageReport, most: int = 20, **states: dict[str, Any]) -> Report:
    """The report on these stages, whose causes carry at most so many places.

    `states` are fields of causes, by their code.
    """
    gathered = Causes(most=most)
    for number, stage in enumerate(stages):
        gathered.add(number, stage.path, stage.findings)
    causes = gathered.result()
    return Report(
        version="0.1.0",
        usd_version="0.26.8",
        settings={
            "fail_on": Severity.ERROR,
            "select": frozenset({"GRD", "AST"}),
            "options": {"GRD004": {"limit": float("inf")}},
            "config": Path("studio/usdvol-lint.toml"),
            "paths": ("shots",),
            "payloads": True,
            "baseline": None,
        },
        root="/studio",
        arguments=("shots",),
        stages=tuple(gathered.stage(*each) for each in enumerate(stages)),
        causes=causes,
        run=RunInfo(
            "2026-11-29T01:30:00Z",
            ("usdvol-lint", "shots", "-j", "2"),
            "usdvol-lint.toml",
            1.2345,
            2,
        ),
    ).with_causes([cause._replace(**states.get(cause.code, {})) for cause in causes])


class Listener:
    """Keeps what a writer says of a run that goes on."""

    listening = True

    def __init__(self, writer: Writer) -> None:
        self.writer = writer
        self.said: list[str] = []

    def begin(self, head: Report) -> None:
        self.said += self.writer.begin(head)

    def cause(self, number: int, cause: Cause) -> None:
        self.said += self.writer.cause(number, cause)

    def place(self, number: int, place: Place) -> None:
        self.said += self.writer.place(number, place)

    def raised(self, number: int, cause: Cause, was: Severity) -> None:
        self.said += self.writer.raised(number, cause, was)

    def stage(self, number: int, stage: StageResult) -> None:
        self.said += self.writer.stage(number, stage)


def streamed(
    format: str, stages: Sequence[StageReport], options: Options, most: int = 20
) -> tuple[str, Report]:
    """What is written while a run over these stages goes on, and the report at its end."""
    told = Listener(writer(format, options))
    head = report()
    told.begin(head)
    judged = ((stage, False) for stage in stages)
    results, causes = folded(Causes(most=most), judged, False, told)
    whole = head._replace(stages=results).with_causes(causes)
    told.said += told.writer.end(whole)
    return "".join(told.said), whole


EVERYTHING = report(SMOKE, CLEAN, HOSTILE, CRASHED, TIMED_OUT, UNREADABLE)
NOTHING = report(CLEAN)
FAILED = report()._replace(
    root=None, failure="usdvol-lint.toml: unknown key '<b>|`@me`', did you mean 'a]]>'?"
)
"""A run that ended before it looked at anything."""

_NO_FIGURES = ParticleFieldStats("/World/Void", 0, None, 0, None, None, None, None, None)
_FIGURES = _NO_FIGURES._replace(
    prim="/World/Splats",
    count=1_234_567,
    sh_degree=3,
    bytes=291_357_812,
    precision="half",
    bounds=((-1.5, 0.0, -2.25), (1234.567, 4.0, 5.5)),
    opacity={"min": 0.0, "p50": 0.75, "max": 1.0},
    scale={"min": 1e-7, "p50": 0.0125, "max": 3.5},
    transparent=0.0375,
)
FIGURES = report(
    SMOKE._replace(particle_fields=(_FIGURES,)),
    CLEAN._replace(
        particle_fields=(
            _NO_FIGURES,
            _FIGURES._replace(count=1, bytes=44, precision="mixed", transparent=0.0),
        )
    ),
    CLEAN._replace(particle_fields=()),
)
UNUSED = SMOKE._replace(findings=SMOKE.findings[3:4])
UNUSED_TOO = UNUSED._replace(
    findings=tuple(each._replace(source=Source("other.usda")) for each in UNUSED.findings)
)
INFOS = report(UNUSED, CLEAN)


def shown_on(stage: str, finding: Finding, *prims: str | None) -> StageReport:
    """A stage that shows one and the same mistake at these prims."""
    findings = (finding._replace(site=finding.site._replace(prim=prim)) for prim in prims)
    return StageReport(f"shots/{stage}.usda", Status.CHECKED, {"volumes": 1}, tuple(findings))


TANK = found(
    "AST002",
    "file-missing",
    Severity.ERROR,
    "no file at './tank.0003.vdb' (1 of 8 samples)",
    Site("assets/tank.usda", "/Tank/fire", "filePath", None, 24, 20, (3.0,)),
)
"""A mistake in an asset; who uses it shows it."""
NO_EXTENTS = tuple(
    found(
        "SCH007",
        "extent-missing",
        Severity.WARNING,
        "no extent, so USD takes the bounds for empty",
        Site("assets/tank.usda", f"/Tank/smoke{number}", line=40 + number, column=5),
        fold="Volume",
    )
    for number in range(5)
)
NO_READER = found(
    "LNT004",
    "usd-too-old",
    Severity.WARNING,
    "OpenUSD 25.5 knows no particle fields",
    Site("assets/tank.usda", line=1, column=1),
)._replace(source=Source(None, subject="usd-core"))


KNOWN = found(
    "VOL001",
    "target-missing",
    Severity.ERROR,
    "'field:density' targets </World/Old/density>, and there is no such prim",
    Site("shots/sh010.usda", "/World/Old", "field:density", line=7, column=9),
)
EXCUSED = found(
    "AST018",
    "frame-gap",
    Severity.WARNING,
    "no file for frame 12, between frames that have one",
    Site("shots/sh020.usda", "/World/Late", "filePath", line=12, column=9, times=(12.0,)),
)
STATES: dict[str, dict[str, Any]] = {
    "AST002": {
        "state": State.WORSE,
        "was": TANK.cover,
        "cover": Cover(Severity.ERROR, (3.0, 7.0, 8.0, 9.0)),
    },
    "VOL001": {"state": State.KNOWN},
    "AST018": {"state": State.SUPPRESSED, "reason": "late frames come from the farm, JIRA-1"},
}

ASSET = StageReport(
    "assets/tank.usda", Status.CHECKED, {"volumes": 5}, (NO_READER, TANK, *NO_EXTENTS)
)
SHOTS = [
    shown_on(f"sh{number:03}", TANK, "/World/Left/fire", "/World/Right/fire")
    for number in range(10, 60, 10)
]
SHOTS[0] = SHOTS[0]._replace(findings=(*SHOTS[0].findings, KNOWN))
SHOTS[1] = SHOTS[1]._replace(findings=(*SHOTS[1].findings, EXCUSED))
USED = BaselineUse(
    "usdvol-lint-baseline.jsonl",
    entries=9,
    gone=("AST002 assets/old/tank.usda </Tank/fire>",),
    moved=(("assets/old", "assets"),),
)
BY_CAUSE = report(ASSET, *SHOTS, **STATES)._replace(baseline=USED)
"""An asset that several shots use, beside a baseline, with each state that a cause may have."""
SHOTS_ALONE = report(*SHOTS)


def without_styles(text: str) -> str:
    """Text without the escape codes that set a style."""
    return re.sub(r"\x1b\[[0-9;]*m", "", text)
