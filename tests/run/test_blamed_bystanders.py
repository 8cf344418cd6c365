"""Who adds something that makes nothing wrong is not to blame, wherever it stands."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from identities import CLEAN, HEAD, LAYER, SPLATS, STAGE, Find, refers
from process import write

from usdvol_lint.model import Source

NOTE = 'string note = "seen"'
FILES = ", ".join(f"{number}: @./puff/puff.{number:04}.vdb@" for number in (1, 2, 3))
SEQUENCE = f"asset filePath.timeSamples = {{ {FILES} }}"
MOVING = SPLATS.replace("tank", "splat").replace(
    "point3f[] positions = [(0.2, 0.2, 0.2), (0.8, 0.8, 0.8)]",
    "point3f[] positions.timeSamples = { 1: [(0, 0, 0), (1, 1, 1)], 2: [(1, 1, 1), (0, 0, 0)] }",
)
RATE = "timeCodesPerSecond = 25\n"
UNITS = 'metersPerUnit = 1\nupAxis = "Y"\n'
RANGE = "startTimeCode = 1001\nendTimeCode = 1003\ntimeCodesPerSecond = 24\n"
PLAYED = CLEAN.replace("asset filePath = @./cloud.vdb@", SEQUENCE)
STILL = "startTimeCode = 1\nendTimeCode = 7\ntimeCodesPerSecond = 24\n"
PACK = "".join(
    CLEAN.replace("tank", name).replace("cloud.vdb", f"puff/puff.{number:04}.vdb")
    for name, number in (("A", 4), ("B", 5))
)
SPACE = f"""def Xform "W" (
    prepend apiSchemas = ["ColorSpaceAPI"]
)
{{
    uniform token colorSpace:name = "sRGB"
    {SPLATS}
}}
"""


def clips(*names: str, more: str = "") -> str:
    paths = ", ".join(f"@./{name}.usda@" for name in names)
    return f"""clips = {{ dictionary default = {{
        asset[] assetPaths = [{paths}]
        {more}
    }} }}"""


WHOLE = """string primPath = "/tank"
        double2[] active = [(1, 0)]
        asset manifestAssetPath = @./manifest.usda@"""


def layer(metadata: str = "", *sublayers: str, said: str = "") -> str:
    paths = ", ".join(f"@./{name}.usda@" for name in sublayers)
    return f"{HEAD}(\n{metadata}subLayers = [{paths}]\n)\n{said}"


def over(path: str, inside: str = "", metadata: str = "") -> str:
    *above, name = path.split("/")
    said = f'over "{name}" (\n{metadata}\n)\n{{\n{inside}\n}}\n'
    for each in reversed(above):
        said = f'over "{each}"\n{{\n{said}}}\n'
    return said


CASES = {
    "inherited": (
        "ARR016",
        {"a": HEAD + SPACE},
        Source("a.usda", "/W", "colorSpace:name"),
        {
            "noted": layer("", "a", said=over("W", NOTE)),
            "noted_below": layer("", "a", said=over("W/tank", NOTE)),
        },
    ),
    "clips": (
        "ARR001",
        {
            "asset": LAYER + SPLATS,
            "clip": HEAD + over("tank", "point3f[] positions = [(0, 0, 0)]"),
            "manifest": HEAD + over("tank", "point3f[] positions"),
            "a": STAGE + refers("tank", "./asset.usda", meta=clips("clip", more=WHOLE)),
        },
        Source("a.usda", "/tank", "clips", ".positions"),
        {"noted": layer("", "a", said=over("tank", NOTE))},
    ),
    "rate": (
        "STG008",
        {"lib": HEAD + PLAYED, "a": layer(RATE, "lib")},
        Source("a.usda", "/", "filePath", "lib.usda"),
        {"again": layer(RATE, "a"), "twice": layer(RATE, "again")},
    ),
    "units": (
        "STG009",
        {"lib": HEAD + f"(\n{UNITS.replace('1', '0.01')})\n" + CLEAN, "a": layer(UNITS, "lib")},
        Source("a.usda", "/", None, "metersPerUnit lib.usda"),
        {"again": layer(UNITS, "a")},
    ),
    "clip paths": (
        "AST002",
        {
            "clip": HEAD + over("tank/density", "asset filePath.timeSamples = { 1: @./no.vdb@ }"),
            "manifest": HEAD + over("tank/density", "asset filePath"),
            "a": HEAD
            + CLEAN.replace("asset filePath = @./cloud.vdb@", "").replace(
                '"tank"', f'"tank" (\n{clips("clip", more=WHOLE)}\n)'
            ),
        },
        Source("a.usda", "/tank", "clips", "density.filePath"),
        {
            "paths": layer("", "a", said=over("tank", metadata=clips("clip"))),
            "all": layer("", "a", said=over("tank", metadata=clips("clip", more=WHOLE))),
        },
    ),
    "range": (
        "AST012",
        {"sim": STAGE + PLAYED, "a": layer(RANGE, "sim")},
        Source("a.usda", "/", "filePath", "./sim.usda"),
        {
            "again": layer(RANGE, "a", said=over("tank/density", SEQUENCE)),
            "ranged": layer(RANGE, "a"),
        },
    ),
    "frame": (
        "AST017",
        {
            "lib": HEAD + PACK,
            "a": f"{HEAD}(\n{STILL})\n" + refers("A", "./lib.usda@</A>").replace(">@\n", ">\n"),
        },
        None,
        {
            "again": layer(
                STILL, "a", said=over("A/density", "asset filePath = @./puff/puff.0004.vdb@")
            ),
        },
    ),
    "extent": (
        "VOL013",
        {"a": STAGE + CLEAN.replace("(0.65, 0.65, 0.65)", "(0.5, 0.5, 0.5)")},
        Source("a.usda", "/tank", "extent"),
        {"weak": layer("", "a", "weaker")},
    ),
    "over": (
        "STG010",
        {
            "lay": STAGE + CLEAN.replace("tank", "smoke"),
            "a": layer("", "lay", said=over("Smoke/density", "asset filePath = @./cloud.vdb@")),
            "note": HEAD + over("Smoke", NOTE),
        },
        Source("a.usda", "/Smoke"),
        {"noted": layer("", "a", "note")},
    ),
    "def": (
        "STG005",
        {
            "lay": STAGE + 'def Xform "World"\n{\n}\n',
            "a": layer("", "lay", said=over("World/FX", CLEAN.replace("/tank", "/World/FX/tank"))),
            "note": HEAD + over("World/FX", f"{NOTE}\n{over('tank', NOTE)}"),
        },
        Source("a.usda", "/World/FX"),
        {"noted": layer("", "a", "note")},
    ),
    "arc": (
        "ARR027",
        {
            "lib": LAYER + f'def Xform "tank"\n{{\n{MOVING}}}\n',
            "a": f"{HEAD}(\n{RANGE})\n" + refers("top", "./lib.usda", "instanceable = true"),
        },
        Source("a.usda", "/top", "positions"),
        {"again": layer(RANGE, "a", said=refers("top", "./lib.usda", "instanceable = true"))},
    ),
    "block": (
        "AST001",
        {"a": LAYER + CLEAN.replace("asset filePath = @./cloud.vdb@", "asset filePath")},
        Source("a.usda", "/tank/density", "filePath"),
        {
            "blocked": layer("", "a", said=over("tank/density", "asset filePath = None")),
            "referred": STAGE
            + refers("x", "./a.usda", inside=over("density", "asset filePath = None")),
        },
    ),
}
WEAKER = HEAD + over("tank", "float3[] extent = [(0.15, 0.15, 0.15), (0.5, 0.5, 0.5)]")


@pytest.fixture
def folder(tmp_path: Path, shots: Path) -> Path:
    for name in ("puff", "cloud.vdb"):
        source = shots.parent / "assets" / name
        (shutil.copytree if source.is_dir() else shutil.copy)(source, tmp_path / name)
    return tmp_path


@pytest.mark.parametrize(("code", "layers", "source", "bystanders"), CASES.values(), ids=CASES)
def test_who_makes_nothing_wrong_is_not_to_blame(
    code: str,
    layers: dict[str, str],
    source: Source | None,
    bystanders: dict[str, str],
    find: Find,
    folder: Path,
) -> None:
    write(folder, weaker=WEAKER, **layers, **bystanders)
    others = [f"{name}.usda" for name in layers if name != "a"]
    found = find("a.usda", *(f"{name}.usda" for name in bystanders), rules=(code,))
    if source is None:
        assert found == []
        return
    [cause] = found
    assert (cause.source, cause.count) == (source, 1 + len(bystanders))
    assert "by itself" not in cause.places[0].finding.message
    assert find(*others, rules=(code,)) == []
