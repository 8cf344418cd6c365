"""The statistics of particle fields, and the settings for them and for time samples."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from particlefields import SPLAT, TYPES, Field, splats, with_value, write
from process import run

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog


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


def test_statistics_and_times_of_a_run(tmp_path: Path) -> None:
    particles = Field(tuple(splats(count) for count in (3, 4, 5)), 0)
    write(particles.changed("opacities", with_value(0, 9), 1), tmp_path / "stage.usdc")
    options = ("--isolated", "--ignore", "LNT004", "--output-format", "json", "stage.usdc")
    (plain,) = run(*options, cwd=tmp_path).stages
    assert "particle_fields" not in plain
    assert [finding["code"] for finding in plain["findings"]] == ["ARR008"]
    ran = run("--times", "ends", "--statistics", *options, cwd=tmp_path)
    assert ran.json["settings"]["times"] == "ends"
    (stage,) = ran.stages
    assert stage["findings"] == []
    assert [each["count"] for each in stage["particle_fields"]] == [5]
    (tmp_path / "usdvol-lint.toml").write_text("times = 2\nstatistics = true\n")
    assert run(*options[1:], cwd=tmp_path).stages[0].keys() == stage.keys()


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
