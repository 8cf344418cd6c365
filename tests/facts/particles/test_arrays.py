"""The arrays of particle fields: any field, any one defect in it, and what exporters write."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from particlefields import (
    AS_IT_IS,
    FRAMES,
    SH,
    TYPES,
    Array,
    Field,
    codes,
    found,
    lint,
    splats,
    with_value,
)
from pxr import Sdf, Usd, Vt

from usdvol_lint.engine.engine import Engine


@st.composite
def valid(draw: st.DrawFn) -> Field:
    degree = draw(st.integers(0, 3))
    counts = draw(st.lists(st.integers(2, 300), min_size=1, max_size=len(FRAMES)))
    seed = draw(st.integers(0, 2**32 - 1))
    optional = draw(st.sets(st.sampled_from(["orientations", "scales", "opacities"])))
    frames = [splats(count, degree, seed + n) for n, count in enumerate(counts)]
    for arrays in frames:
        for name in optional:
            del arrays[name]
    shown = None if degree == 3 and draw(st.booleans()) else degree
    return Field(tuple(frames), shown, draw(st.frozensets(st.sampled_from(list(TYPES)))))


def with_first_column(row: int, value: float) -> Callable[[Array], Array]:
    def change(array: Array) -> Array:
        array.reshape(len(array), -1)[row % len(array), 0] = value
        return array

    return change


SMALL = "scales", "opacities", "orientations"
DEFECTS: dict[str, tuple[str, tuple[str, ...], Callable[[int], Callable[[Array], Array]]]] = {
    "short": ("ARR002 error", SMALL, lambda row: lambda array: array[:-1]),
    "long": ("ARR003 warning", SMALL, lambda row: lambda a: np.concatenate([a, a[:1]])),
    "few coefficients": ("ARR004 error", (SH,), lambda row: lambda array: array[:-1]),
    "many coefficients": (
        "ARR004 error",
        (SH,),
        lambda row: lambda array: np.concatenate([array, array[:1]]),
    ),
    "NaN": ("ARR007 error", tuple(TYPES), lambda row: with_first_column(row, np.nan)),
    "infinity": ("ARR007 error", tuple(TYPES), lambda row: with_first_column(row, np.inf)),
    "minus infinity": ("ARR007 error", tuple(TYPES), lambda row: with_first_column(row, -np.inf)),
    "opacity": ("ARR008 error", ("opacities",), lambda row: with_value(row, 1.25)),
    "low opacity": ("ARR008 error", ("opacities",), lambda row: with_value(row, -0.5)),
    "negative scales": ("ARR009 error", ("scales",), lambda row: lambda array: -array),
    "no orientation": ("ARR010 error", ("orientations",), lambda row: with_value(row, 0)),
    "long orientation": ("ARR011 warning", ("orientations",), lambda row: with_value(row, 0.75)),
    "far out": ("ARR013 warning", ("positions",), lambda row: with_first_column(row, -1500)),
}


@AS_IT_IS
@given(particles=valid())
def test_a_valid_field_is_clean(particles: Field, engine: Engine, tmp_path: Path) -> None:
    assert lint(engine, particles, tmp_path / "stage.usdc") == ()


@AS_IT_IS
@given(particles=valid(), name=st.sampled_from(sorted(DEFECTS)), data=st.data())
def test_one_defect_is_one_finding(
    particles: Field, name: str, data: st.DataObject, engine: Engine, tmp_path: Path
) -> None:
    expected, arrays, defect = DEFECTS[name]
    present = [each for each in arrays if each in particles.frames[0]]
    if not present:
        return
    array = data.draw(st.sampled_from(present))
    frame = data.draw(st.integers(0, len(particles.frames) - 1))
    row = data.draw(st.integers(0, 299))
    if name == "far out" and array in particles.half and len(particles.frames[frame][array]) <= 10:
        return  # one of so few, where halves are coarse, is more than a tenth: said as well
    broken = particles.changed(array, defect(row), frame)
    (finding,) = lint(engine, broken, tmp_path / "stage.usdc")
    if name == "many coefficients" and particles.frames[0].keys() == {"positions", SH}:
        expected = "ARR004 warning"  # no other array says which of the two is wrong
    assert f"{finding.code} {finding.severity.label}" == expected, finding.message
    animated = len(particles.frames) > 1
    assert finding.site.times == ((FRAMES[frame],) if animated else ())
    if array in (*SMALL, SH):
        assert finding.site.property == (f"{array}h" if array in particles.half else array)


SURFEL = [
    "ParticleFieldPositionAttributeAPI",
    "ParticleFieldOrientationAttributeAPI",
    "ParticleFieldScaleAttributeAPI",
    "ParticleFieldOpacityAttributeAPI",
    "ParticleFieldKernelGaussianSurfletAPI",
    "ParticleFieldSphericalHarmonicsAttributeAPI",
]


def test_the_layout_of_the_official_converters(engine: Engine, tmp_path: Path) -> None:
    """PLY in float and SPZ in half, with metadata, and an extent cut off at 50,000."""
    particles = Field((splats(100, 3),), 3, extent=((-1000,) * 3, (50000.0, 1000, 1000)))
    particles = particles.changed("positions", with_first_column(7, 61234.5))
    extra = {
        "projectionModeHint": ("token", "perspective"),
        "sortingModeHint": ("token", "zDepth"),
    }
    assert lint(engine, replace(particles, extra=extra), tmp_path / "ply.usdc") == ()
    halves = replace(particles, half=frozenset(TYPES) - {"positions"}, extra=extra)
    assert lint(engine, halves, tmp_path / "spz.usdc") == ()
    stage = Usd.Stage.Open(str(tmp_path / "ply.usdc"))
    coefficients = stage.GetPrimAtPath("/Splats").GetAttribute(SH)
    coefficients.SetMetadata("elementSize", 16)
    coefficients.SetMetadata("interpolation", "vertex")
    stage.Save()
    assert found(engine.lint(str(tmp_path / "ply.usdc"))) == ()
    coefficients.SetMetadata("elementSize", 25)
    stage.Save()
    assert codes(found(engine.lint(str(tmp_path / "ply.usdc")))) == ["ARR015 info"]


@pytest.mark.parametrize("half", [frozenset[str](), frozenset(TYPES)], ids=["float", "half"])
def test_the_layout_of_3dgrut(half: frozenset[str], engine: Engine, tmp_path: Path) -> None:
    arrays = splats(200, 3)
    low, high = arrays["positions"].min(axis=0), arrays["positions"].max(axis=0)
    particles = Field((arrays,), 3, half, extent=(tuple(low.tolist()), tuple(high.tolist())))
    assert lint(engine, particles, tmp_path / "stage.usdc") == ()
    stage = Usd.Stage.Open(str(tmp_path / "stage.usdc"))
    prim = stage.GetPrimAtPath("/Splats")
    prim.SetTypeName("ParticleField")
    prim.SetMetadata("apiSchemas", Sdf.TokenListOp.Create(prependedItems=SURFEL))
    scales = prim.GetAttribute("scalesh" if half else "scales")
    flat = np.array(scales.Get())
    flat[:, 2] = 0
    scales.Set((Vt.Vec3hArray if half else Vt.Vec3fArray).FromNumpy(flat))
    stage.Save()
    assert found(engine.lint(str(tmp_path / "stage.usdc"))) == ()


def test_the_columns_of_a_ply_file(engine: Engine, tmp_path: Path) -> None:
    """Logits, logarithms and raw quaternions: each has its hint."""
    particles = Field((splats(1000),), 0)
    particles = particles.changed("opacities", lambda a: np.log(a / (1.0001 - a)) * 2)
    particles = particles.changed("scales", np.log)
    particles = particles.changed("orientations", lambda array: array * 1.7)
    findings = lint(engine, particles, tmp_path / "stage.usdc")
    assert [finding.code for finding in findings] == ["ARR008", "ARR011", "ARR009"]
    hints = " ".join(finding.suggestion or "" for finding in findings)
    assert "sigmoid" in hints
    assert "exp(x)" in hints
    assert "divide each quaternion" in hints
