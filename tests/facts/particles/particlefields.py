"""Particle fields made of NumPy arrays, as layers, and what is found in them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import HealthCheck, settings
from pxr import Sdf, Vt

from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding, StageReport

SH = "radiance:sphericalHarmonicsCoefficients"
DEGREE = "radiance:sphericalHarmonicsDegree"
SPLAT = "ParticleField3DGaussianSplat"
TYPES = {
    "positions": ("point3f[]", Vt.Vec3fArray, "point3h[]", Vt.Vec3hArray),
    "orientations": ("quatf[]", Vt.QuatfArray, "quath[]", Vt.QuathArray),
    "scales": ("float3[]", Vt.Vec3fArray, "half3[]", Vt.Vec3hArray),
    "opacities": ("float[]", Vt.FloatArray, "half[]", Vt.HalfArray),
    SH: ("float3[]", Vt.Vec3fArray, "half3[]", Vt.Vec3hArray),
}
FRAMES = 1.0, 2.0, 5.0
AS_IT_IS = settings(
    deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture]
)

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Field:
    """A particle field: for each frame, or for all time, its arrays by their float names."""

    frames: tuple[dict[str, Array], ...]
    degree: int | None
    half: frozenset[str] = frozenset()
    extra: dict[str, tuple[str, Any]] = field(default_factory=dict)
    extent: tuple[tuple[float, ...], tuple[float, ...]] = ((-1000,) * 3, (1000,) * 3)

    def changed(self, name: str, change: Callable[[Array], Array], frame: int = 0) -> Field:
        frames = [dict(arrays) for arrays in self.frames]
        frames[frame][name] = change(frames[frame][name].copy())
        return replace(self, frames=tuple(frames))


def write(particles: Field, path: Path) -> None:
    layer = Sdf.Layer.CreateNew(str(path))
    prim = Sdf.PrimSpec(layer, "Splats", Sdf.SpecifierDef, SPLAT)
    for name, (single, single_array, half, half_array) in TYPES.items():
        is_half = name in particles.half
        type_name = Sdf.ValueTypeNames.Find(half if is_half else single)
        wrap = (half_array if is_half else single_array).FromNumpy
        dtype = np.float16 if is_half else np.float32
        if name not in particles.frames[0]:
            continue
        spec = Sdf.AttributeSpec(prim, f"{name}h" if is_half else name, type_name)
        for time, arrays in zip(FRAMES, particles.frames, strict=False):
            with np.errstate(over="ignore"):
                value = wrap(np.ascontiguousarray(arrays[name].astype(dtype)))
            if len(particles.frames) == 1:
                spec.default = value
            else:
                layer.SetTimeSample(spec.path, time, value)
    if particles.degree is not None:
        uniform = Sdf.VariabilityUniform
        spec = Sdf.AttributeSpec(prim, DEGREE, Sdf.ValueTypeNames.Int, uniform)
        spec.default = particles.degree
    Sdf.AttributeSpec(prim, "extent", Sdf.ValueTypeNames.Float3Array).default = Vt.Vec3fArray(
        particles.extent
    )
    for name, (type_name, value) in particles.extra.items():
        Sdf.AttributeSpec(prim, name, Sdf.ValueTypeNames.Find(type_name)).default = value
    layer.Save()


def lint(engine: Engine, particles: Field, path: Path) -> tuple[Finding, ...]:
    path.unlink(missing_ok=True)
    write(particles, path)
    return found(engine.lint(str(path)))


def found(report: StageReport) -> tuple[Finding, ...]:
    return tuple(finding for finding in report.findings if finding.code != "LNT004")


def codes(findings: tuple[Finding, ...]) -> list[str]:
    return [f"{finding.code} {finding.severity.label}" for finding in findings]


def splats(count: int, degree: int = 0, seed: int = 0) -> dict[str, Array]:
    """Valid particles, of which no two coincide."""
    random = np.random.default_rng(seed)
    quaternions = random.standard_normal((count, 4)) + np.array([0, 0, 0, 5])
    positions = random.uniform(-10, 10, (count, 3))
    positions[:, 0] = np.arange(count) % 1000
    return {
        "positions": positions,
        "orientations": quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True),
        "scales": random.uniform(0.001, 1, (count, 3)),
        "opacities": random.uniform(0.01, 1, count),
        SH: random.uniform(-2, 2, (count * (degree + 1) ** 2, 3)),
    }


def with_value(row: int, value: float) -> Callable[[Array], Array]:
    def change(array: Array) -> Array:
        array[row % len(array), ...] = value
        return array

    return change


def bare(body: str) -> str:
    return f"""#usda 1.0
def {SPLAT} "Splats"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    point3f[] positions = [(0, 0, 0), (1, 1, 1)]
    uniform int {DEGREE} = 0
    float3[] {SH} = [(1, 1, 1), (1, 1, 1)]
{body}
}}
"""
