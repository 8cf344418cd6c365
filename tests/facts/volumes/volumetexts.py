"""Volumes as text, with extents, files and transforms."""

from __future__ import annotations

from collections.abc import Callable

from usdvol_lint.model import Finding

Lint = Callable[..., list[Finding]]

OPS = {
    "move": "double3 xformOp:translate = (1, 2, 3)\n"
    ' uniform token[] xformOpOrder = ["xformOp:translate"]',
    "turn": 'float xformOp:rotateZ = 30\n uniform token[] xformOpOrder = ["xformOp:rotateZ"]',
    "size": 'double3 xformOp:scale = (2, 3, 4)\n uniform token[] xformOpOrder = ["xformOp:scale"]',
    "reset": "double3 xformOp:translate = (5, 0, 0)\n"
    ' uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate"]',
    "none": "uniform token[] xformOpOrder = []",
    "wander": "double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 3: (4, 0, 0) }\n"
    ' uniform token[] xformOpOrder = ["xformOp:translate"]',
}


def volume(extent: str, files: str = "asset filePath = @./cloud.vdb@", more: str = "") -> str:
    return f"""
def Volume "cloud" {{
    {extent}
    rel field:density = </cloud/density>
    def OpenVDBAsset "density" {{
        {files}
        token fieldName = "density"
        {more}
    }}
}}
"""


def samples(files: dict[float, str]) -> str:
    return (
        "asset filePath.timeSamples = {" + "".join(f"{t}: @{f}@," for t, f in files.items()) + "}"
    )


def only(findings: list[Finding]) -> Finding:
    (finding,) = findings
    return finding


SMALL = "./box_growing.0002.vdb"
LARGE = "./box_growing.0003.vdb"
