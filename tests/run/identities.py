"""Assets and shots that show their causes, and the causes of a run over them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.paths import canonical
from usdvol_lint.results import Cause
from usdvol_lint.run.causes import Causes, versions_in

Find = Callable[..., list[Cause]]

FILE = ("AST002",)
HEAD = "#usda 1.0\n"
META = 'upAxis = "Y"\nmetersPerUnit = 1\ntimeCodesPerSecond = 24\n'
LAYER = f'#usda 1.0\n(\ndefaultPrim = "tank"\n{META})\n'
STAGE = f"#usda 1.0\n(\n{META})\n"
CLEAN = """
def Volume "tank"
{
    float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]
    rel field:density = </tank/density>
    def OpenVDBAsset "density"
    {
        asset filePath = @./cloud.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
        token fieldClass = "fogVolume"
    }
}
"""
SPLATS = """
def ParticleField3DGaussianSplat "tank"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    point3f[] positions = [(0.2, 0.2, 0.2), (0.8, 0.8, 0.8)]
    quatf[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0)]
    float3[] scales = [(0.01, 0.01, 0.01), (0.01, 0.01, 0.01)]
    float[] opacities = [1, 1]
    uniform int radiance:sphericalHarmonicsDegree = 0
    float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1), (0.5, 0.5, 0.5)]
}
"""


def refers(name: str, path: str = "../assets/tank.usda", meta: str = "", inside: str = "") -> str:
    """A prim that refers to the default prim of a layer."""
    return f'def "{name}" (\n{meta}\nreferences = @{path}@\n)\n{{\n{inside}\n}}\n'


def finder(catalog: Catalog, folder: Path) -> Find:
    """The causes of a run over stages, whose layers go by a folder."""

    def call(
        *stages: str | Path,
        rules: tuple[str, ...] = FILE,
        root: str | Path = folder,
        selections: int = 0,
        versions: str | None = None,
    ) -> list[Cause]:
        active = activate(Config(select=rules), catalog)
        engine = Engine(catalog.rules, active, Depth(selections=selections))
        causes = Causes(canonical(str(root)), versions_in(versions))
        for number, stage in enumerate(stages):
            report = engine.lint(str(stage))
            assert report.status == "checked"
            causes.add(number, report.path, report.findings)
        return list(causes.result())

    return call
