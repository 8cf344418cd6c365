"""Value clips that USD does not use: the layers that they name, wherever these lie."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from stages import package, said

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]

CLIP = """#usda 1.0
over "splat"
{
    point3f[] positions.timeSamples = { 1: [(0, 0, 0), (1, 0, 0)], 2: [(0, 0, 0), (2, 0, 0)] }
}
"""
SPLAT = """#usda 1.0
def ParticleField "splat" (
    prepend apiSchemas = [
        "ParticleFieldPositionAttributeAPI",
        "ParticleFieldKernelGaussianSurfletAPI",
        "ParticleFieldSphericalHarmonicsAttributeAPI",
        "ParticleFieldOrientationAttributeAPI",
    ]
    clips = {
        dictionary default = {
            string primPath = "%s"
            string templateAssetPath = "%sclip.###.usda"
            double templateStartTime = 1
            double templateEndTime = 2
            double templateStride = %s
        }
    }
)
{
    float3[] extent = [(0, 0, 0), (9, 0, 0)]
    point3f[] positions
    quatf[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0)]
    float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1), (2, 2, 2)]
    uniform int radiance:sphericalHarmonicsDegree = 0
}
"""
NOWHERE = (
    "AST016 the clip set 'default' has the primPath '/nowhere', which no clip has: USD does not "
    "use it, and positions has no value -> did you mean '/splat'?"
)
STANDING = (
    "AST016 the clip set 'default' has the templateStride 0, which must be above 0: USD does not "
    "use it, and positions has no value -> author the frames from one clip to the next"
)


@pytest.mark.parametrize("start", ["", "./"])
@pytest.mark.parametrize(
    ("packages", "prim_path", "stride", "expected"),
    [
        *((packages, "/splat", "1", []) for packages in (0, 1, 2)),
        *((packages, "/nowhere", "1", [NOWHERE]) for packages in (0, 1, 2)),
        *((packages, "/splat", "0", [STANDING]) for packages in (0, 1)),
    ],
)
def test_clips_that_a_template_names(
    packages: int,
    prim_path: str,
    stride: str,
    expected: list[str],
    start: str,
    lint_text: Lint,
    tmp_path: Path,
) -> None:
    """On disk, in a package, and in a package in that, whose names only USD can list."""
    text = SPLAT % (prim_path, start, stride)
    files = {"clip.001.usda": CLIP.encode()}
    for _ in range(packages):
        package(tmp_path / "shot.usdz", text, files)
        files = {"shot.usdz": (tmp_path / "shot.usdz").read_bytes()}
        text = "#usda 1.0\n(\n    subLayers = [@./shot.usdz@]\n)\n"
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    found = [each for each in lint_text(text).findings if each.code != "LNT004"]
    assert [f"{each.code} {each.message} -> {each.suggestion}" for each in found] == expected


@pytest.mark.parametrize("folder", ["", "clips/"])
def test_a_clip_of_a_template_is_called_as_the_template_would(
    folder: str, lint_text: Lint, tmp_path: Path
) -> None:
    text = SPLAT.replace("clip.###", f"{folder}clip.###") % ("/splat", "./", "1")
    package(tmp_path / "shot.usdz", text, {f"{folder}clip.001.usda": b"#usda 1.0\n)"})
    report = lint_text("#usda 1.0\n(\n    subLayers = [@./shot.usdz@]\n)\n")
    [found] = [each for each in said(report) if each.startswith("STG001")]
    assert found.startswith(f"STG001 the clip './{folder}clip.001.usda' can't be read: ")
