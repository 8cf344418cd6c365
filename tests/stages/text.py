"""Stages with one Volume as text, the files beside them, and what was said of them."""

from __future__ import annotations

import zipfile
from pathlib import Path

from usdvol_lint.model import Finding, StageReport

CONTENT = b"x" * 2000


def volume(file_path: str, header: str = "") -> str:
    """A stage with one volume, whose one field names files as given."""
    return f"""#usda 1.0
{header}
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </cloud/density>

    def OpenVDBAsset "density"
    {{
        token fieldName = "density"
        token fieldDataType = "float"
        token fieldClass = "fogVolume"
        {file_path}
    }}
}}
"""


def findings(report: StageReport) -> list[Finding]:
    """Those of the rules about assets and stages, and what was not checked."""
    return [f for f in report.findings if f.code.startswith(("AST00", "AST014", "STG", "LNT"))]


def said(report: StageReport) -> list[str]:
    return [
        f"{finding.code} {finding.message}"
        + (f" -> {finding.suggestion}" if finding.suggestion else "")
        for finding in findings(report)
    ]


def only(report: StageReport) -> Finding:
    [finding] = findings(report)
    return finding


def write(folder: Path, *names: str) -> None:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(CONTENT)


def package(path: Path, stage: str, files: dict[str, bytes]) -> None:
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in {"root.usda": stage.encode(), **files}.items():
            archive.writestr(name, data)
