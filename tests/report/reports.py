"""Reports to write: one that has everything, clean ones, and one on a run that failed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

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
from usdvol_lint.results import Report, RunInfo
from usdvol_lint.run.causes import Causes

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


def without_styles(text: str) -> str:
    """Text without the escape codes that set a style."""
    return re.sub(r"\x1b\[[0-9;]*m", "", text)
