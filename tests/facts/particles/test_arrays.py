"""The arrays of particle fields beyond what pages show: any field, any size, any defect."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from process import ROOT, run
from pxr import Sdf, Usd, Vt

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.particles import chunks, matches, ranges
from usdvol_lint.facts.particles.arrays import Misfits
from usdvol_lint.facts.particles.reading import chosen_times
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.usd.values import Value
from usdvol_lint.model import Finding, StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

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


# --- any valid field, and one defect in it --------------------------------------------------------


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


def _set(row: int, value: float) -> Callable[[Array], Array]:
    def change(array: Array) -> Array:
        array[row % len(array), ...] = value
        return array

    return change


def _first_column(row: int, value: float) -> Callable[[Array], Array]:
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
    "NaN": ("ARR007 error", tuple(TYPES), lambda row: _first_column(row, np.nan)),
    "infinity": ("ARR007 error", tuple(TYPES), lambda row: _first_column(row, np.inf)),
    "minus infinity": ("ARR007 error", tuple(TYPES), lambda row: _first_column(row, -np.inf)),
    "opacity": ("ARR008 error", ("opacities",), lambda row: _set(row, 1.25)),
    "low opacity": ("ARR008 error", ("opacities",), lambda row: _set(row, -0.5)),
    "negative scales": ("ARR009 error", ("scales",), lambda row: lambda array: -array),
    "no orientation": ("ARR010 error", ("orientations",), lambda row: _set(row, 0)),
    "long orientation": ("ARR011 warning", ("orientations",), lambda row: _set(row, 0.75)),
    "far out": ("ARR013 warning", ("positions",), lambda row: _first_column(row, -1500)),
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
    assert f"{finding.code} {finding.severity.label}" == expected, finding.message
    animated = len(particles.frames) > 1
    assert finding.site.times == ((FRAMES[frame],) if animated else ())
    if array in (*SMALL, SH):
        assert finding.site.property == (f"{array}h" if array in particles.half else array)


# --- reductions against what NumPy says without them ----------------------------------------------


@AS_IT_IS
@given(
    count=st.integers(1, 3000),
    width=st.sampled_from([1, 3, 4]),
    dtype=st.sampled_from([np.float16, np.float32]),
    seed=st.integers(0, 2**32 - 1),
    sprinkled=st.lists(
        st.sampled_from([np.nan, np.inf, -np.inf, 0.0, -0.0, 65504.0, -65504.0, 6e-8]), max_size=6
    ),
    chunk=st.sampled_from([1, 7, 1000, 1 << 17]),
    threads=st.booleans(),
)
def test_reductions_agree_with_the_obvious(
    count: int,
    width: int,
    dtype: Any,
    seed: int,
    sprinkled: list[float],
    chunk: int,
    threads: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(chunks, "_CHUNK", chunk * width)
    monkeypatch.setattr(chunks.fold, "__defaults__", (chunk * width,))
    monkeypatch.setattr(chunks, "_WORTH_THREADS", 0 if threads else 1 << 40)
    random = np.random.default_rng(seed)
    rows = (random.standard_normal((count, width)) * 100).astype(dtype)
    for value in sprinkled:
        rows[random.integers(count), random.integers(width)] = value
    rows = rows[random.integers(count, size=count)]  # some of them twice
    finite = np.isfinite(rows).all(axis=1)
    bad = None
    if not finite.all():
        first = int((~finite).argmax())
        bad = matches.Matches(int((~finite).sum()), first, tuple(rows[first].tolist()))
    extremes = None, None
    if finite.any():
        extremes = tuple(rows[finite].min(axis=0)), tuple(rows[finite].max(axis=0))
    flags = bool(np.isinf(rows).any()), bool(np.isnan(rows).any())

    for measured in (ranges.column_range(rows), ranges.counted_column_range(rows)):
        assert (measured.low, measured.high) == extremes
        assert_same_matches(measured.non_finite, bad)
        assert (measured.has_infinity, measured.has_nan) == flags
    assert_same_matches(ranges.finiteness(rows).non_finite, bad)
    if width == 4:
        norms = (rows[finite].astype(np.float64) ** 2).sum(axis=1)
        measured = ranges.norm_range(rows)
        assert_same_matches(measured.non_finite, bad)
        if len(norms):
            assert measured.low == pytest.approx((norms.min(),), rel=1e-5)
            assert measured.high == pytest.approx((norms.max(),), rel=1e-5)
    bits = rows.view(f"i{rows.itemsize}")
    twice = (bits[1:] == bits[:-1]).all(axis=1)
    for keep in (matches.keep_repeated, matches.keep_alike) if count > 1 else ():
        left = np.ones(count - 1, np.bool_)
        keep(left, rows)
        assert left.tolist() == (twice & finite[1:]).tolist()


def assert_same_matches(one: matches.Matches | None, other: matches.Matches | None) -> None:
    """NaN is not equal to itself."""
    assert repr(one) == repr(other)


@pytest.mark.parametrize("dtype", [np.float16, np.float32])
@pytest.mark.parametrize("place", [0, 1, -1])
def test_large_arrays_go_through_threads(dtype: Any, place: int) -> None:
    rows = np.ones((chunks._WORTH_THREADS // 3 + 12345, 3), dtype)
    assert ranges.column_range(rows) == ranges.Range((1, 1, 1), (1, 1, 1))
    rows[place] = (2, -np.inf, 0.5)
    found = matches.Matches(1, place % len(rows), (2, -np.inf, 0.5))
    assert ranges.column_range(rows) == ranges.Range((1, 1, 1), (1, 1, 1), found, has_infinity=True)
    assert ranges.finiteness(rows) == ranges.Range(None, None, found, has_infinity=True)


def test_a_sum_that_overflows_is_no_infinity() -> None:
    rows = np.full((100_000, 3), 3e38, np.float32)
    assert ranges.finiteness(rows).non_finite is None
    assert ranges.norm_range(np.full((10, 4), 3e38, np.float32)).high == pytest.approx((3.6e77,))


# --- times ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("policy", "expected"),
    [
        ("all", [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]),
        ("first", [0]),
        ("ends", [0, 9]),
        (1, [0]),
        (2, [0, 9]),
        (4, [0, 3, 6, 9]),
        (10, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]),
        (99, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]),
    ],
)
def test_chosen_times(policy: str | int, expected: list[int]) -> None:
    assert list(chosen_times(range(10), policy)) == expected
    assert list(chosen_times([], policy)) == []


@pytest.mark.parametrize(
    ("policy", "frames", "counted"),
    [("all", "1-2, 5", 3), ("first", "1", 1), ("ends", "1, 5", 2), (2, "1, 5", 2)],
)
def test_only_chosen_times_are_looked_at(
    policy: str | int, frames: str, counted: int, catalog: Catalog, tmp_path: Path
) -> None:
    particles = Field(tuple(splats(10) for _ in FRAMES), 0)
    for number in range(len(FRAMES)):
        particles = particles.changed("opacities", _set(3, 7), number)
    engine = Engine(catalog.rules, activate(Config(), catalog), Depth(times=policy))
    (finding,) = lint(engine, particles, tmp_path / "stage.usdc")
    assert finding.site.frames == frames
    assert finding.message == (
        f"{counted} of {counted * 10} opacities (10 %) outside of 0 to 1, "
        f"from {least(particles):.6g} to 7, first 7 at [3] ({counted} of 3 samples)"
    )


def least(particles: Field) -> float:
    return float(min(arrays["opacities"].min() for arrays in particles.frames))


def test_an_array_is_compared_at_the_times_of_the_positions_too(
    lint_text: Callable[[str], StageReport],
) -> None:
    report = lint_text(
        f"""#usda 1.0
def {SPLAT} "Splats"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    point3f[] positions.timeSamples = {{
        1: [(0, 0, 0), (1, 1, 1)],
        4: [(0, 0, 0), (0.5, 0.5, 0.5), (1, 1, 1)],
    }}
    float[] opacities.timeSamples = {{
        1: [1, 1],
        3: [1, 1],
        5: [1, 1, 1],
    }}
    uniform int {DEGREE} = 0
    float3[] {SH}.timeSamples = {{
        0: [(1, 1, 1), (1, 1, 1)],
        4: [(1, 1, 1), (1, 1, 1), (1, 1, 1)],
    }}
}}
"""
    )
    (finding,) = found(report)
    assert (finding.code, finding.site.frames) == ("ARR002", "4")
    assert finding.message == "2 opacities for 3 particles (1 of 5 samples)"


@pytest.mark.parametrize(
    ("name", "sizes", "expected"),
    [
        ("opacities", (1, 2), "1 opacity for 2 particles"),
        ("opacities", (2, 1), "2 opacities for 1 particle"),
        ("opacities", (0, 1), "0 opacities for 1 particle"),
        ("scales", (1, 2), "1 scale for 2 particles"),
        ("orientations", (1, 1000), "1 orientation for 1,000 particles"),
        ("coefficients", (1, 1), "1 coefficient for 1 particle"),
    ],
)
def test_one_of_a_kind_is_named_in_the_singular(
    name: str, sizes: tuple[int, int], expected: str
) -> None:
    stage = Usd.Stage.CreateInMemory()
    attribute = stage.DefinePrim("/Splats").CreateAttribute(name, Sdf.ValueTypeNames.FloatArray)
    misfits = Misfits(attribute, (Value(None, sizes),), 0, name)
    assert misfits.words == expected


def test_value_clips_are_samples(tmp_path: Path, engine: Engine) -> None:
    for number, count in ((1, 4), (2, 5)):
        write(Field((splats(count),), 0), tmp_path / f"still.{number}.usda")
        layer = Sdf.Layer.FindOrOpen(str(tmp_path / f"still.{number}.usda"))
        clip = Sdf.Layer.CreateNew(str(tmp_path / f"clip.{number}.usda"))
        clip.TransferContent(layer)
        for name in TYPES:
            spec = clip.GetAttributeAtPath(f"/Splats.{name}")
            value = spec.default
            spec.ClearDefaultValue()
            if name == "opacities" and number == 2:
                value = Vt.FloatArray([2.0] * count)
            clip.SetTimeSample(spec.path, float(number), value)
        clip.Save()
    types = "".join(f"    {TYPES[name][0]} {name}\n" for name in TYPES)
    (tmp_path / "manifest.usda").write_text(f'#usda 1.0\nover "Splats"\n{{\n{types}}}\n')
    (tmp_path / "stage.usda").write_text(
        f"""#usda 1.0
def {SPLAT} "Splats" (
    clips = {{
        dictionary default = {{
            double2[] active = [(1, 0), (2, 1)]
            asset[] assetPaths = [@./clip.1.usda@, @./clip.2.usda@]
            asset manifestAssetPath = @./manifest.usda@
            string primPath = "/Splats"
            double2[] times = [(1, 1), (2, 2)]
        }}
    }}
)
{{
    float3[] extent = [(-1000, -1000, -1000), (1000, 1000, 1000)]
    uniform int {DEGREE} = 0
{types}}}
"""
    )
    (finding,) = found(engine.lint(str(tmp_path / "stage.usda")))
    assert (finding.code, finding.site.frames) == ("ARR008", "2")
    assert finding.message.startswith("5 of 5 opacities (100 %)")


# --- what exporters write -------------------------------------------------------------------------

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
    particles = particles.changed("positions", _first_column(7, 61234.5))
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


# --- bad input ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("opacities", "hint"),
    [
        ("[1.15, 2.4, 3.89]", "logits"),
        ("[-2.3, 1.9, 3.9]", "logits"),
        ("[0, 128, 255]", "bytes"),
        ("[0.5, 0.6, 1.5]", "clamp"),
    ],
)
def test_the_remedy_for_opacities(
    opacities: str, hint: str, lint_text: Callable[[str], StageReport]
) -> None:
    """The logits of an opaque scan are all positive: they are no bytes for that."""
    positions = "point3f[] positions = [(0, 0, 0), (1, 1, 1), (2, 2, 2)]"
    body = f"{positions}\nfloat[] opacities = {opacities}"
    findings = [each for each in lint_text(bare(body)).findings if each.code == "ARR008"]
    assert [hint in (each.suggestion or "") for each in findings] == [True]


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


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("= 0", "= -2147483648", ["ARR005 error"]),
        ("= 0", "= 1000000000", ["ARR004 error"]),
        ("uniform int", "uniform token", None),
        (f"uniform int {DEGREE} = 0", f'uniform string {DEGREE} = "0"', ["SCH003 error"]),
        (f"uniform int {DEGREE} = 0", f"uniform int {DEGREE} = None", ["ARR004 error"]),
        ("point3f[] positions", "double3[] positions", ["SCH003 error"]),
        ("point3f[] positions", "float3[] positions", ["SCH003 warning"]),
        (f"float3[] {SH}", f"double3[] {SH}", ["SCH003 error"]),
        ("positions = [(0, 0, 0), (1, 1, 1)]", "positions = None", ["ARR001 warning"]),
        ("positions = [(0, 0, 0), (1, 1, 1)]", "positions", ["ARR001 warning"]),
        ("    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n", "", ["SCH007 warning"]),
        ("[(1, 1, 1), (1, 1, 1)]\n", "None\n", ["ARR017 warning"]),
    ],
)
def test_strange_values(
    old: str, new: str, expected: list[str] | None, lint_text: Callable[[str], StageReport]
) -> None:
    text = bare("")
    assert old in text
    report = lint_text(text.replace(old, new, 1))
    if expected is None:  # not even a layer
        assert codes(report.findings) == ["LNT001 error"]
    else:
        assert codes(found(report)) == expected


def test_strange_types_of_optional_arrays(lint_text: Callable[[str], StageReport]) -> None:
    body = """
    double[] opacities = [7, nan, 3]
    string scales = "none"
    quatd[] orientations = [(0, 0, 0, 0)]
    half opacitiesh = 3
    half3[] scalesh = [(0.1, 0.1, 0.1), (0.1, 0.1, 0.1)]
"""
    assert set(codes(found(lint_text(bare(body))))) == {"SCH003 error"}


def test_no_particles_with_many_coefficients(engine: Engine, tmp_path: Path) -> None:
    """Nothing of what no particle has is looked at, not even NaN."""
    arrays = {"positions": np.zeros((0, 3)), SH: np.full((300_000, 3), np.nan)}
    findings = lint(engine, Field((arrays,), 3), tmp_path / "stage.usdc")
    assert codes(findings) == ["ARR001 warning"]


def test_sizes_beyond_any_integer(engine: Engine, tmp_path: Path) -> None:
    particles = Field((splats(3),), 2**31 - 1)
    (finding,) = lint(engine, particles, tmp_path / "stage.usdc")
    assert finding.message == (
        "3 coefficients for 3 particles, and degree 2147483647 takes "
        "4,611,686,018,427,387,904 for each"
    )
    assert finding.suggestion == f"author {DEGREE} = 0, which fits"


def test_a_truncated_crate_ends_no_run(tmp_path: Path) -> None:
    """Arrays that end beyond the file: USD raises, reads nothing, or dies of a bus error."""
    write(Field((splats(200_000, 1),), 1), tmp_path / "whole.usdc")
    data = (tmp_path / "whole.usdc").read_bytes()
    places = int.from_bytes(data[16:24], "little")
    for number, share in enumerate((0.3, 0.7)):
        # What is left out lies in the arrays: the tables at the end are kept, and still found.
        left_out = int(places * share) // 8 * 8
        short = bytearray(data[:88] + data[88 + left_out :])
        short[16:24] = struct.pack("<q", places - left_out)
        (tmp_path / f"short{number}.usdc").write_bytes(short)
    (tmp_path / "good.usda").write_text(bare(""))
    ran = run("--isolated", "--output-format", "concise", "--jobs", "1", ".", cwd=tmp_path)
    said = {line.partition(":")[0] for line in ran.out.splitlines() if "LNT004" not in line}
    assert said == {"short0.usdc", "short1.usdc"}
    assert ran.code in (1, 2), ran.err


# --- cost -----------------------------------------------------------------------------------------


def test_memory_does_not_grow_with_the_particles(engine: Engine, tmp_path: Path) -> None:
    """Arrays are views on the mapped file: what is allocated is a chunk or two."""
    write(Field((splats(300_000, 2),), 2), tmp_path / "stage.usdc")
    assert (tmp_path / "stage.usdc").stat().st_size > 40_000_000
    engine.lint(str(tmp_path / "stage.usdc"))
    tracemalloc.start()
    try:
        assert found(engine.lint(str(tmp_path / "stage.usdc"))) == ()
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 12_000_000


def test_numpy_is_imported_for_particles_alone(tmp_path: Path) -> None:
    (tmp_path / "volume.usda").write_text(
        '#usda 1.0\ndef Volume "v"\n{\n    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n}\n'
        'def ParticleField "p"\n{\n}\n'
    )
    program = """
import sys
from usdvol_lint.packs.catalog import load
from usdvol_lint.config import Config, Depth
from usdvol_lint.packs.activation import activate
from usdvol_lint.engine.engine import Engine
catalog = load()
Engine(catalog.rules, activate(Config(), catalog)).lint(sys.argv[1])
sys.exit("numpy" in sys.modules)
"""
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "volume.usda")],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=False,
    )
    assert done.returncode == 0


# --- statistics -----------------------------------------------------------------------------------


@pytest.mark.parametrize("half", [frozenset[str](), frozenset(TYPES)], ids=["float", "half"])
def test_statistics(half: frozenset[str], catalog: Catalog, tmp_path: Path) -> None:
    engine = Engine(catalog.rules, activate(Config(), catalog), Depth(statistics=True))
    arrays = splats(5000, 1)
    arrays["opacities"][:400] = 0.001
    write(Field((arrays,), 1, half), tmp_path / "stage.usdc")
    (stats,) = engine.lint(str(tmp_path / "stage.usdc")).particle_fields or ()
    assert (stats.prim, stats.count, stats.sh_degree) == ("/Splats", 5000, 1)
    assert stats.bytes == 5000 * (3 + 4 + 3 + 1 + 12) * (2 if half else 4)
    assert stats.precision == ("half" if half else "float")
    assert stats.bounds
    assert stats.bounds[0] == pytest.approx(arrays["positions"].min(axis=0), rel=1e-3)
    assert stats.bounds[1] == pytest.approx(arrays["positions"].max(axis=0), rel=1e-3)
    assert stats.transparent == pytest.approx(0.08)
    for named, numbers in ((stats.opacity, arrays["opacities"]), (stats.scale, arrays["scales"])):
        assert named
        shares = {"min": 0, "p01": 1, "p10": 10, "p50": 50, "p90": 90, "p99": 99, "max": 100}
        assert list(named) == list(shares)
        for name, share in shares.items():
            assert named[name] == pytest.approx(np.percentile(numbers, share), rel=0.02)


def test_statistics_of_next_to_nothing(catalog: Catalog, tmp_path: Path) -> None:
    engine = Engine(catalog.rules, activate(Config(), catalog), Depth(statistics=True))
    (tmp_path / "stage.usda").write_text(
        f'#usda 1.0\ndef {SPLAT} "b"\n{{\n}}\ndef {SPLAT} "a"\n{{\n'
        "    point3h[] positionsh = [(nan, 0, 0)]\n    float[] opacities = [nan]\n}\n"
    )
    a, b = engine.lint(str(tmp_path / "stage.usda")).particle_fields or ()
    assert (a.prim, a.count, a.precision, a.bounds, a.opacity) == ("/a", 1, "mixed", None, None)
    assert (b.prim, b.count, b.precision, b.bounds, b.opacity) == ("/b", 0, None, None, None)


# --- the command line and the configuration -------------------------------------------------------


def test_statistics_and_times_of_a_run(tmp_path: Path) -> None:
    particles = Field(tuple(splats(count) for count in (3, 4, 5)), 0)
    write(particles.changed("opacities", _set(0, 9), 1), tmp_path / "stage.usdc")
    options = ("--isolated", "--ignore", "LNT004", "--output-format", "json", "stage.usdc")
    (plain,) = run(*options, cwd=tmp_path).json["stages"]
    assert "particle_fields" not in plain
    assert [finding["code"] for finding in plain["findings"]] == ["ARR008"]
    ran = run("--times", "ends", "--statistics", *options, cwd=tmp_path)
    assert ran.json["settings"]["times"] == "ends"
    (stage,) = ran.json["stages"]
    assert stage["findings"] == []
    assert [each["count"] for each in stage["particle_fields"]] == [5]
    (tmp_path / "usdvol-lint.toml").write_text("times = 2\nstatistics = true\n")
    assert run(*options[1:], cwd=tmp_path).json["stages"][0].keys() == stage.keys()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("times = 0", "times must be all, first, ends or a whole number from 1, not 0"),
        ("times = true", "times must be all, first, ends or a whole number from 1, not True"),
        ("times = []", "times must be all, first, ends or a whole number from 1, not []"),
        ("statistics = 1", "statistics must be true or false, not 1"),
    ],
)
def test_settings_that_make_no_sense(text: str, expected: str, tmp_path: Path) -> None:
    (tmp_path / "usdvol-lint.toml").write_text(f"{text}\n")
    ran = run(".", cwd=tmp_path)
    assert (ran.code, ran.out) == (2, "")
    assert expected in ran.err


def test_times_that_make_no_sense(tmp_path: Path) -> None:
    ran = run("--times", "last", ".", cwd=tmp_path)
    assert (ran.code, ran.out) == (2, "")
    assert "--times must be all, first, ends or a whole number from 1, not 'last'" in ran.err


# --- a USD that knows no particle fields ----------------------------------------------------------


def test_an_old_usd_is_said_once_a_stage(lint_text: Callable[[str], StageReport]) -> None:
    report = lint_text(bare("").replace('"Splats"', '"One"') + bare("").partition("\n")[2])
    said = [finding for finding in report.findings if finding.code == "LNT004"]
    assert codes(report.findings) == codes(tuple(said))
    assert len(said) == (0 if PrimKinds().knows_particle_fields else 1)
    for finding in said:
        assert (finding.severity.label, finding.site.prim) == ("warning", None)


def test_an_old_usd_does_not_matter_without_particles(
    lint_text: Callable[[str], StageReport],
) -> None:
    report = lint_text('#usda 1.0\ndef Xform "x"\n{\n}\n')
    assert report.findings == ()


def test_an_old_usd_can_be_ignored(catalog: Catalog, tmp_path: Path) -> None:
    engine = Engine(catalog.rules, activate(Config(ignore=("LNT004",)), catalog))
    (tmp_path / "stage.usda").write_text(bare(""))
    assert engine.lint(str(tmp_path / "stage.usda")).findings == ()
