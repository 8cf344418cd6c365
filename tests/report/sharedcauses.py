"""An asset whose mistakes several shots show, beside a baseline and suppressions."""

from __future__ import annotations

from typing import Any

from reports import found, report

from usdvol_lint.model import Cover, Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.results import BaselineUse, State


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
