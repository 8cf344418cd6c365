"""Which time samples of arrays are looked at, and what is compared at which times."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from particlefields import (
    DEGREE,
    FRAMES,
    SH,
    SPLAT,
    TYPES,
    Field,
    found,
    lint,
    splats,
    with_value,
    write,
)
from pxr import Sdf, Usd, Vt

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.particles.arrays import Misfits
from usdvol_lint.facts.particles.reading import chosen_times
from usdvol_lint.facts.usd.values import Value
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog


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
        particles = particles.changed("opacities", with_value(3, 7), number)
    engine = Engine(catalog.rules, activate(Config(), catalog), Depth(times=policy))
    (finding,) = lint(engine, particles, tmp_path / "stage.usdc")
    assert finding.site.frames == frames
    first = "the one at [3]: 7" if counted == 1 else "first 7 at [3]"
    assert finding.message == (
        f"{counted} of {counted * 10} opacities (10 %) outside of 0 to 1, "
        f"from {least(particles):.6g} to 7, {first} ({counted} of 3 samples)"
    )


@pytest.mark.parametrize("policy", ["first", "all"])
def test_a_first_sample_without_particles_says_nothing_of_those_not_looked_at(
    policy: str, catalog: Catalog, tmp_path: Path
) -> None:
    path = tmp_path / "stage.usda"
    path.write_text(
        f"""#usda 1.0
def {SPLAT} "Splats"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    point3f[] positions = [(0, 0, 0)]
    point3f[] positions.timeSamples = {{
        1: [],
        2: [],
    }}
    uniform int {DEGREE} = 0
    float3[] {SH} = [(1, 1, 1)]
}}
"""
    )
    engine = Engine(catalog.rules, activate(Config(), catalog), Depth(times=policy))
    codes = [finding.code for finding in engine.lint(str(path)).findings]
    assert codes == (["ARR001"] if policy == "all" else [])


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
