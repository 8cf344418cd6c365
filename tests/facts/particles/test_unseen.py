"""Particles that can't be seen, or that are copies: what depends on which samples are read."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

SPLATS = """#usda 1.0
def ParticleField3DGaussianSplat "Splats" {
float3[] extent = [(0, 0, 0), (9, 9, 9)]
point3f[] positions = [(3, 3, 3), (3, 3, 3), (6, 6, 6)]
float3[] scales = [(.1, .1, .1), (.1, .1, .1), (.1, .1, .1)]
quatf[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)]
OPACITIES
int radiance:sphericalHarmonicsDegree = 0
float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1), (1, 1, 1), (1, 0, 0)]
MORE
}
"""


def told(catalog: Catalog, path: Path, times: str | int = "all") -> Sequence[str]:
    active = activate(Config(select=("ARR013", "ARR014")), catalog)
    findings = Engine(catalog.rules, active, Depth(times=times)).lint(str(path)).findings
    return [finding.message for finding in findings]


@pytest.mark.parametrize(
    ("samples", "message"),
    [
        ("1: [0, .5, 1], 2: [0, .4, 1], 3: [0, .5, 1]", "1 of 3 particles (33.3 %) can't be seen"),
        ("1: [0, .5, 1], 2: [1, .4, 1], 3: [0, .5, 1]", ""),
        ("1: [.5, .5, 1], 2: [1, 1, 1], 3: [.5, .5, 1]", "1 of 3 particles (33.3 %) is like"),
        ("1: [.5, .5, 1], 2: [1, .9, 1], 3: [.5, .5, 1]", ""),
    ],
)
def test_nothing_is_said_where_samples_are_left_out(
    samples: str, message: str, catalog: Catalog, tmp_path: Path
) -> None:
    path = tmp_path / "stage.usda"
    text = SPLATS.replace("OPACITIES", f"float[] opacities.timeSamples = {{ {samples} }}")
    path.write_text(text.replace("MORE", ""))
    found = told(catalog, path)
    assert [line.startswith(message) for line in found] == [True] * bool(message)
    for times in ("first", "ends", 2):
        assert told(catalog, path, times) == []


@pytest.mark.parametrize(
    ("more", "is_told"),
    [
        ('token[] primvars:kind = ["a", "a", "b"]', True),
        ('token[] primvars:kind = ["a", "b", "b"]', False),
        (
            "matrix4d[] primvars:turn = [( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,0,1) ), "
            "( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,0,2) ), "
            "( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,0,1) )]",
            False,
        ),
        ("int[] primvars:skel:jointIndices = [1, 2, 1, 2, 3, 4]", True),
        ("int[] primvars:skel:jointIndices = [1, 2, 1, 3, 3, 4]", False),
        ("int[] other = [1, 2]", True),
        ("int[] other = []", True),
        ("int[] other.timeSamples = { 1: [5, 5, 5], 2: [5, 6, 7] }", False),
        ("half[] opacitiesh = [0, 1, 1]", True),
    ],
)
def test_other_attributes_tell_particles_apart(
    more: str, is_told: bool, catalog: Catalog, tmp_path: Path
) -> None:
    path = tmp_path / "stage.usda"
    path.write_text(
        SPLATS.replace("OPACITIES", "float[] opacities = [.5, .5, 1]").replace("MORE", more)
    )
    assert bool(told(catalog, path)) == is_told
