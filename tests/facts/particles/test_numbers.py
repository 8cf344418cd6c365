"""What the numbers in arrays say of a thousand particles, which would not fit on a page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from particlefields import SH, Array, Field, codes, lint, splats, write
from pxr import Usd

import usdvol_lint.facts.particles.scales as scales_module
from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.particles.array import ArraySample, ParticleArray
from usdvol_lint.facts.particles.numbers import are_whole, mean_of, range_within, spacing
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import load

COUNT = 1000
EXTENT = ((-10.0,) * 3, (10.0,) * 3)


def scan(count: int = COUNT, **changed: Array) -> Field:
    arrays = splats(count)
    arrays["positions"][:, 0] = np.linspace(-8, 8, count)
    arrays["positions"][:, 1:] *= 0.8
    arrays["scales"] *= 0.5
    return Field(({**arrays, **changed},), 0, extent=EXTENT)


def uniform(low: float, high: float, count: int = COUNT) -> Array:
    return np.random.default_rng(1).uniform(low, high, (count, 3))


@pytest.fixture
def array_of(tmp_path: Path) -> Callable[[str, Field], ParticleArray]:
    """Writes a particle field and opens one of its arrays; the stages live as long as the test."""
    stages: list[Any] = []

    def read(name: str, field: Field) -> ParticleArray:
        path = tmp_path / f"splats{len(stages)}.usdc"
        write(field, path)
        stages.append(Usd.Stage.Open(str(path)))
        attribute = stages[-1].GetPrimAtPath("/Splats").GetAttribute(name)
        return ParticleArray(attribute, (ArraySample(None, len(attribute.Get())),), 0)

    return read


@pytest.mark.parametrize(
    ("count", "low", "high", "expected"),
    [
        (COUNT, 1.9, 2.3, ["ARR024 info"]),
        (COUNT, 1.7, 2.1, []),
        (COUNT - 1, 1.9, 2.3, []),
    ],
)
def test_mean_scale_above_a_tenth_of_the_extent(
    engine: Engine, tmp_path: Path, count: int, low: float, high: float, expected: list[str]
) -> None:
    field = scan(count, scales=uniform(low, high, count))
    found = lint(engine, field, tmp_path / "splats.usdc")
    assert [code for code in codes(found) if "ARR022" not in code] == expected


@pytest.mark.parametrize(
    ("scale", "expected"),
    [
        (-2.0, ["ARR009 warning"]),
        (nan, ["ARR007 error"]),
        (inf, ["ARR007 error"]),
    ],
    ids=["negative", "nan", "infinity"],
)
def test_scales_of_which_one_is_amiss_have_no_mean(
    engine: Engine, tmp_path: Path, scale: float, expected: list[str]
) -> None:
    scales = uniform(1.9, 2.3)
    scales[7, 1] = scale
    found = lint(engine, scan(scales=scales), tmp_path / "splats.usdc")
    assert [code for code in codes(found) if "ARR022" not in code] == expected


@pytest.mark.parametrize("opacity", [nan, inf], ids=["nan", "infinity"])
def test_squeezed_opacities_that_are_not_finite_are_told_once(
    engine: Engine, tmp_path: Path, opacity: float
) -> None:
    opacities = np.linspace(0.505, 0.73, COUNT)
    assert codes(lint(engine, scan(opacities=opacities), tmp_path / "splats.usdc")) == [
        "ARR019 warning"
    ]
    opacities[7] = opacity
    assert codes(lint(engine, scan(opacities=opacities), tmp_path / "splats.usdc")) == [
        "ARR007 error"
    ]


def test_exp_of_exp_is_told_once(
    engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It makes scales larger than a tenth of a small extent too; their mean is found once."""
    means: list[float] = []

    def counted(array: ParticleArray) -> float:
        means.append(mean_of(array))
        return means[-1]

    monkeypatch.setattr(scales_module, "mean_of", counted)
    field = scan(scales=np.exp(np.exp(uniform(-6, -2.5))))
    field.frames[0]["positions"][:] /= 8
    field = replace(field, extent=((-4.0,) * 3, (4.0,) * 3))
    found = lint(engine, field, tmp_path / "splats.usdc")
    assert codes(found) == ["ARR019 warning"]
    assert len(means) == 1
    catalog = load()
    others = Engine(catalog.rules, activate(Config(ignore=("ARR019", "ARR022")), catalog))
    assert codes(lint(others, field, tmp_path / "splats.usdc")) == ["ARR024 info"]


@pytest.mark.parametrize(
    ("count", "values", "expected"),
    [
        (COUNT, uniform(0, 1), ["ARR023 info"]),
        (COUNT - 1, uniform(0, 1, COUNT - 1), []),
        (COUNT, uniform(0, 1.01), []),
        (COUNT, uniform(-0.01, 1), []),
        (COUNT, uniform(0, 0.5), []),
        (COUNT, np.full((COUNT, 3), 0.75), []),
        (COUNT, np.tile([1.0, 0.5, 0.0], (COUNT, 1)), []),
    ],
)
@pytest.mark.parametrize("half", [frozenset(), frozenset({SH})])
def test_coefficients_that_are_colours(
    engine: Engine,
    tmp_path: Path,
    count: int,
    values: Array,
    expected: list[str],
    half: frozenset[str],
) -> None:
    field = scan(count, **{SH: values})
    field = Field(field.frames, 0, half, extent=EXTENT)
    assert codes(lint(engine, field, tmp_path / "splats.usdc")) == expected


def test_particles_without_size_are_not_lost(engine: Engine, tmp_path: Path) -> None:
    """Those of no size can't be seen, so most of the rest is all right."""
    positions = scan().frames[0]["positions"].copy()
    positions[:900, 0] = 5_000_000 + np.arange(900)
    for size, expected in ((0.0, 0), (0.01, 1)):
        scales = np.full((COUNT, 3), 0.5)
        scales[:900] = size
        field = Field(
            scan(positions=positions, scales=scales).frames, 0, extent=((-1e7,) * 3, (1e7,) * 3)
        )
        found = lint(engine, field, tmp_path / "splats.usdc")
        assert codes(found).count("ARR020 warning") == expected


def test_the_measures(array_of: Callable[[str, Field], ParticleArray]) -> None:
    field = scan(**{SH: np.tile([1.0, 2.0, 6.0], (COUNT, 1))})
    array = array_of(SH, field)
    assert mean_of(array) == 3
    assert are_whole(array)
    assert range_within(array, 0, 6) == ((1, 2, 6), (1, 2, 6))
    assert range_within(array, 0, 5) is None
    late = np.tile([1.0, 2.0, 6.0], (COUNT * 50, 1))
    late[-1] = 6.5
    array = array_of(SH, scan(COUNT * 50, **{SH: late}))
    assert not are_whole(array)
    assert range_within(array, 0, 6) is None


def test_spacing_leaves_out_an_axis_without_length(
    array_of: Callable[[str, Field], ParticleArray],
) -> None:
    places = scan().frames[0]["positions"].copy()
    places[:] = 0
    places[0] = (-2, -1, 0)
    places[1] = (2, 1, 0)
    array = array_of("positions", scan(positions=places))
    assert spacing(array, 8) == 1
    places[:] = 3
    assert spacing(array_of("positions", scan(positions=places)), 8) == 0
