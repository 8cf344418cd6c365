"""Fields as text, files for them, and what is said of their paths and sequences."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

from process import ASSETS

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]
CODES = ("AST006", "AST007", "AST008", "AST009", "AST011", "AST012", "AST013", "AST015")


def field(body: str, header: str = "", kind: str = "OpenVDBAsset") -> str:
    return (
        f'#usda 1.0\n{header}\ndef {kind} "density"\n{{\n    token fieldName = "density"\n'
        f"    {body}\n}}\n"
    )


def sampled(samples: Iterable[tuple[float, str]], header: str = "") -> str:
    lines = "".join(f"{time}: @{path}@,\n" for time, path in samples)
    return field(f"asset filePath.timeSamples = {{\n{lines}}}", header)


def write(folder: Path, *names: str) -> None:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ASSETS / "cloud.vdb", folder / name)


def said(report: StageReport, *codes: str) -> list[tuple[str, str | None, str, str | None]]:
    return [
        (finding.code, finding.site.frames, finding.message, finding.suggestion)
        for finding in report.findings
        if finding.code in (codes or CODES)
    ]


def frames(report: StageReport, code: str) -> list[str | None]:
    return [finding.site.frames for finding in report.findings if finding.code == code]
