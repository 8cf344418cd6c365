"""Fields as text beside files written for them, and what is said of these."""

from __future__ import annotations

from collections.abc import Callable

import vdbwriter as w

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]
FOG = {"class": w.string("fog volume"), **w.bounds((1, 1, 1), (8, 8, 8))}


def grid(name: str = "density", kind: str = "float", **metadata: tuple[str, bytes]) -> w.Grid:
    entries = {**FOG, **metadata, "name": w.string(name)}
    small = w.scale(0.1, 0.1, 0.1, "UniformScaleMap")
    return w.Grid(name, f"Tree_{kind}_5_4_3", metadata=entries, transform=small)


def field(name: str, *statements: str, kind: str = "OpenVDBAsset") -> str:
    lines = "\n".join(f"        {statement}" for statement in statements)
    return f"""    rel field:{name} = </cloud/{name}>
    def {kind} "{name}"
    {{
{lines}
    }}
"""


DENSITY = (
    'token fieldName = "density"',
    'token fieldDataType = "float"',
    'token fieldClass = "fogVolume"',
)


def stage(*fields: str) -> str:
    extent = "    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n"
    return f'#usda 1.0\ndef Volume "cloud"\n{{\n{extent}{"".join(fields)}}}\n'


def density(*paths: str, **more: str) -> str:
    """A field whose frames are the files at these paths."""
    samples = "".join(f"\n{frame}: @{path}@," for frame, path in enumerate(paths, start=1))
    return field("density", f"asset filePath.timeSamples = {{{samples}\n}}", *DENSITY)


def said(report: StageReport, *families: str) -> list[tuple[str, str | None, str]]:
    return [
        (finding.code, finding.site.frames, finding.message)
        for finding in report.findings
        if finding.code.startswith(families or ("GRD", "LNT", "FLD001"))
    ]
