"""100,000 findings in one run: of as many causes in one stage, or of a thousand in many shots."""

from __future__ import annotations

from pathlib import Path

from bench.case import Case
from bench.measure import gauged, linter

_HEAD = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Y"
)
"""
_VOLUME = """
    def Volume "volume_{number}"
    {{
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
{relationships}
{fields}
    }}
"""
_BOUND = """        rel field:{name} = </World/volume_{number}/{name}>
"""
_UNBOUND = """        rel field:no_{name} = </World/volume_{number}/no_{name}>
"""
_FIELD = """
        def OpenVDBAsset "{name}"
        {{
            token fieldDataType = "floats"
            token fieldName = "density"
            asset filePath = @./gone/{number}.{name}.vdb@
            token vectorDataRoleHint = "color"
        }}
"""
"""Three things are wrong with it: two values that are not allowed, and a file that is missing."""

_SHOT = """#usda 1.0
(
    defaultPrim = "Shot"
    metersPerUnit = 0.01
    upAxis = "Y"
)
def "Shot" (
    prepend references = @../asset.usda@
)
{
}
"""


def one_stage(folder: Path, scale: float) -> Path:
    """1,000 Volumes of 25 fields, each of them with four causes: 100,000."""
    return _write_asset(folder / "dense.usda", round(1000 * scale), 25, _BOUND + _UNBOUND)


def many_shots(folder: Path, scale: float) -> Path:
    """100 shots of an asset of 334 Volumes with three causes each: 100,200 of 1,002."""
    _write_asset(folder / "asset.usda", 334, 1, _BOUND)
    shots = folder / "shots"
    shots.mkdir()
    for number in range(max(1, round(100 * scale))):
        (shots / f"shot_{number:03}.usda").write_text(_SHOT, encoding="utf-8")
    return shots


def _write_asset(path: Path, volumes: int, fields: int, relationships: str) -> Path:
    names = [f"field_{number}" for number in range(fields)]
    with path.open("w", encoding="utf-8", newline="\n") as layer:
        layer.write(f'{_HEAD}def Xform "World"\n{{')
        for number in range(max(1, volumes)):
            given = [{"number": number, "name": name} for name in names]
            layer.write(
                _VOLUME.format(
                    number=number,
                    relationships="".join(relationships.format(**each) for each in given),
                    fields="".join(_FIELD.format(**each) for each in given),
                )
            )
        layer.write("}\n")
    return path


_OURS = linter("--isolated", "--output-format", "json", exit_code=1)
_MEMORY = gauged("memory", _OURS)

CASES = (
    Case("findings", _OURS, None, 10, one_stage),
    Case("findings-shared", _OURS, None, 10, many_shots),
    Case("findings-memory", _MEMORY, None, 250, many_shots, unit="MB"),
)
