"""Gaussian splats: float, half, animated, broken, few and many."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bench.case import Case, Make
from bench.measure import Command, gauged, linter, python

_SPLATS = 5_000_000
_FRAMES = 100
_DEGREE = 3
_CHUNK = 1 << 20

_OPEN = """
import sys
from time import perf_counter
import numpy
from pxr import Usd, UsdVol
stage = Usd.Stage.Open(sys.argv[1])
"""
_SUM = """
for prim in stage.Traverse():
    for attribute in prim.GetAuthoredAttributes():
        if attribute.GetTypeName().isArray: numpy.asarray(attribute.Get()).sum()
"""
_SUM_EACH = python(f"{_OPEN}{_SUM}")
_TIME_SUMS = python(
    f"{_OPEN}began = perf_counter(){_SUM}print(perf_counter() - began)", prints=True
)


def splats(folder: Path, scale: float) -> Path:
    """Writes 5 million splats of degree 3: 1.2 GB."""
    return _write(folder, _SPLATS * scale)


def tenth(folder: Path, scale: float) -> Path:
    """A tenth of the splats."""
    return _write(folder, _SPLATS * scale / 10)


def half_splats(folder: Path, scale: float) -> Path:
    """The splats in half precision."""
    return _write(folder, _SPLATS * scale, kind="f2")


def broken_splats(folder: Path, scale: float) -> Path:
    """The splats with one NaN, the last of all coefficients."""
    return _write(folder, _SPLATS * scale, broken=True)


def animated_splats(folder: Path, scale: float) -> Path:
    """100 frames of a fiftieth of the splats, which is a million at `--scale 10`."""
    return _write(folder, _SPLATS * scale / 50, times=range(_FRAMES))


def one_frame(folder: Path, scale: float) -> Path:
    """A fiftieth of the splats."""
    return splats(folder, scale / 50)


def a_million(folder: Path, scale: float) -> Path:
    """A fifth of the splats."""
    return splats(folder, scale / 5)


def _write(
    folder: Path,
    count: float,
    kind: str = "f4",
    times: Sequence[float | None] = (None,),
    broken: bool = False,
) -> Path:
    """Writes `count` splats; it saves after each array, so that only one is in memory."""
    import numpy as np
    from pxr import Gf, Usd, UsdVol, Vt

    size = max(1, round(count))
    path = folder / "splats.usdc"
    stage = Usd.Stage.CreateNew(str(path))
    prim = UsdVol.ParticleField3DGaussianSplat.Define(stage, "/Splats").GetPrim()
    prim.GetAttribute("extent").Set([Gf.Vec3f(-9), Gf.Vec3f(9)])
    prim.GetAttribute("radiance:sphericalHarmonicsDegree").Set(_DEGREE)
    suffix, letter = ("h", "h") if kind == "f2" else ("", "f")
    scalar = Vt.HalfArray if kind == "f2" else Vt.FloatArray
    vector, quaternion = (getattr(Vt, f"{name}{letter}Array") for name in ("Vec3", "Quat"))
    random = np.random.default_rng(0)

    def noise(width: int, count: int = size) -> Any:
        """Normally distributed numbers, none beyond 8."""
        values = np.empty((count, width), kind)
        for start in range(0, count, _CHUNK):
            part = values[start : start + _CHUNK]
            part[:] = random.standard_normal(part.shape, "f4").clip(-8, 8)
        return values

    def put(name: str, array: Any, values: Any, time: float | None) -> None:
        code = Usd.TimeCode.Default() if time is None else time
        prim.GetAttribute(name + suffix).Set(array.FromNumpy(values), code)
        stage.Save()

    for time in times:
        put("positions", vector, noise(3), time)
        turns = noise(4).astype("f4")
        turns /= np.linalg.norm(turns, axis=1, keepdims=True)
        put("orientations", quaternion, turns.astype(kind), time)
        put("scales", vector, np.exp(noise(3) * 0.5 - 4).astype(kind), time)
        put("opacities", scalar, (1 / (1 + np.exp(-noise(1)[:, 0]))).astype(kind), time)
        coefficients = noise(3, size * (_DEGREE + 1) ** 2)
        coefficients *= 0.2
        if broken:
            coefficients[-1, -1] = np.nan
        put("radiance:sphericalHarmonicsCoefficients", vector, coefficients, time)
        del coefficients
    return path


def _grown(name: str, make: Make, make_floor: Make, wanted: float) -> Case:
    """The seconds for facts and rules on more splats in relation to those on fewer."""
    command = gauged("check", linter())
    return Case(name, command, command, wanted, make, make_floor)


_PEER = Command(("omni_asset_validate", "--no-init-rules", "--requirement", "VG.035"), exit_code=1)
"""omniverse-asset-validator, which reports these splats as failing."""

_PEER_ALONE = f"""
import subprocess, sys, tempfile
from time import perf_counter
def seconds(path):
    began = perf_counter()
    subprocess.run([*{_PEER.words!r}, path], capture_output=True)
    return perf_counter() - began
with tempfile.NamedTemporaryFile("w", suffix=".usda") as empty:
    empty.write("#usda 1.0\\n")
    empty.flush()
    print(seconds(sys.argv[1]) - seconds(empty.name))
"""
_LINT_AGAIN = """
import sys
from usdvol_lint.packs.catalog import load
from usdvol_lint.config import Config
from usdvol_lint.packs.activation import activate
from usdvol_lint.engine.engine import Engine
catalog = load()
engine = Engine(catalog.rules, activate(Config(), catalog))
engine.lint(sys.argv[1])
print(sum(engine.lint(sys.argv[1]).seconds.values()))
"""

CASES = (
    Case(
        "splats-peer-warm",
        python(_LINT_AGAIN, prints=True),
        python(_PEER_ALONE, prints=True),
        1 / 30,
        a_million,
        needs=_PEER.words[0],
    ),
    Case("splats", linter(), _SUM_EACH, 1.6, splats),
    Case("splats-rules", gauged("check", linter()), _TIME_SUMS, 2.5, splats),
    Case("splats-memory", gauged("memory", linter()), None, 250, splats, unit="MB"),
    Case("splats-half", linter(), _SUM_EACH, 2.0, half_splats),
    Case("splats-broken", linter(exit_code=1), linter(), 2.0, broken_splats, splats),
    _grown("splats-growth", splats, tenth, 10.0),
    _grown("splats-frames", animated_splats, one_frame, _FRAMES),
    Case("splats-peer", linter(), _PEER, 0.25, a_million, needs=_PEER.words[0]),
)
