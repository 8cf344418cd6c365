"""Layers that compose each other, written from what is in them."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

from process import ASSETS

from usdvol_lint.model import Finding, StageReport
from usdvol_lint.packs.catalog import USD_TOO_OLD

Files = dict[str, str]
Judge = Callable[..., list[str]]
PUFF = ASSETS / "puff"
EXTENT = "float3[] extent = [(-1, -1, -1), (3, 3, 3)]"
HEAD = '#usda 1.0\n(\n    upAxis = "Y"\n    metersPerUnit = 1\n%s\n)\n'


def layer(text: str, *lines: str) -> str:
    return HEAD % "\n".join(lines) + text


def sublayers(*names: str) -> str:
    return f"subLayers = [{', '.join(f'@./{name}.usda@' for name in names)}]"


def over(name: str, inside: str, meta: str = "", what: str = "over") -> str:
    return f'{what} "{name}" {meta}\n{{\n{inside}\n}}\n'


def field(inside: str = "", name: str = "density", what: str = "def OpenVDBAsset") -> str:
    data = '\ntoken fieldDataType = "float"\n' if "fieldDataType" not in inside else "\n"
    return over(name, f"{data}{inside}", what=what)


def volume(inside: str, name: str = "smoke", meta: str = "") -> str:
    return over(name, inside, meta, what="def Volume")


NAME = 'token fieldName = "density"'
FILE = "asset filePath = @./puff.0001.vdb@"
BOUND = f"{EXTENT}\nrel field:density = <density>\n"
BASE = volume(BOUND + field(NAME))
WHOLE = volume(BOUND + "\n" + field(f"{NAME}\n{FILE}"))
ROOT_PRIM = 'defaultPrim = "smoke"'
REFERENCE = "(prepend references = @./asset.usda@)"
SPLAT = "point3f[] positions = [(0, 0, 0), (1, 1, 1)]\nfloat[] opacities = [1, 1]\n"
DEGREE = "uniform int radiance:sphericalHarmonicsDegree = 0\n"
COLOUR = f"{DEGREE}float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1), (0, 1, 1)]\n"


def splats(inside: str, meta: str = "", what: str = "def ParticleField3DGaussianSplat") -> str:
    return over("splats", inside, meta, what=what)


APIS = tuple(
    f"ParticleField{name}API"
    for name in ("PositionAttribute", "KernelGaussianEllipsoid", "SphericalHarmonicsAttribute")
)


def fields(inside: str, *apis: str, what: str = "def ParticleField", meta: str = "") -> str:
    """A particle field with these APIs."""
    listed = ", ".join(f'"{api}"' for api in apis)
    applied = f"prepend apiSchemas = [{listed}]\n" if apis else ""
    return splats(inside, f"({applied}{meta})", what)


def clips(keys: str, what: str = "def", inside: str = "") -> str:
    return over("smoke", inside, f"(clips = {{ dictionary default = {{\n{keys}\n}} }})", what=what)


ACTIVE = "double2[] active = [(1, 0), (2, 1)]\ndouble2[] times = [(1, 1), (2, 2)]"
PATHS = 'asset[] assetPaths = [@./c1.usda@, @./c2.usda@]\nstring primPath = "/smoke"'
MANIFEST = "asset manifestAssetPath = @./manifest.usda@"
RANGE = ("startTimeCode = 1", "endTimeCode = 2", "timeCodesPerSecond = 24", "framesPerSecond = 24")


def clip(number: int, what: str = "def") -> str:
    samples = f"asset filePath.timeSamples = {{ {number}: @./puff.000{number}.vdb@ }}"
    types = ("def Volume", "def OpenVDBAsset") if what == "def" else ("over", "over")
    return layer(over("smoke", over("density", samples, what=types[1]), what=types[0]))


RIG_AND_CACHE = {
    "cache": layer(over("fx", field(f"{NAME}\n{FILE}"), what="def Scope")),
    "rig": layer(
        over("fx", volume(f"{EXTENT}\nrel field:density = </fx/density>"), what="def Scope")
    ),
    "shot": layer("", sublayers("cache", "rig")),
}
TWO_HALVES = {
    "one": layer(
        volume(f"{EXTENT}\nrel field:density = </smoke/density>", "smoke")
        + volume(field(f"{NAME}\n{FILE}"), "fire")
    ),
    "two": layer(
        over("smoke", field(f"{NAME}\n{FILE}"))
        + over("fire", f"{EXTENT}\nrel field:density = </fire/density>")
    ),
    "shot": layer("", sublayers("one", "two")),
}

VERSIONED = layer(
    volume(
        BOUND
        + field(NAME)
        + 'variantSet "version" = {\n"v1" {\n'
        + over("density", FILE)
        + "}\n}\n",
        meta='(prepend variantSets = "version")',
    ),
    ROOT_PRIM,
)
"""An asset whose variant `v1` names the file."""
SELECTING_SHOT = layer(
    over(
        "smoke",
        "",
        '(prepend references = @./asset.usda@\nvariants = { string version = "v1" })',
        what="def",
    )
)


def write(folder: Path, layers: Files) -> None:
    for file in PUFF.iterdir():
        shutil.copy(file, folder)
    for name, text in layers.items():
        (folder / f"{name}.usda").write_text(text, encoding="utf-8")


def told(
    stages: Sequence[StageReport], is_completed: Callable[[StageReport, Finding], bool]
) -> list[str]:
    return [
        f"{stage.path.removesuffix('.usda')} {each.code} {each.severity.label}"
        for stage in stages
        for each in stage.findings
        if each.code != USD_TOO_OLD.code and not is_completed(stage, each)
    ]


def check_completed(judge: Judge, layers: Files, absent: set[str]) -> None:
    """That what is absent in a layer is told of it alone, and not where another one brings it."""
    alone = [line for each in layers for line in judge(layers, [each])]
    assert absent <= set(alone)
    assert judge(layers) == []
    assert judge(layers, sorted(layers, reverse=True)) == []
