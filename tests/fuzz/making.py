"""A seed and a number become an input."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from process import ASSETS, ROOT, SAMPLES
from stages.generating import generate
from stages.usda import layer_text

from . import texts
from .containers import built_package, built_volume, zipped
from .crates import crate
from .layers import BUILDERS
from .model import STAGE, Input, Role, volume
from .mutating import mutated_bytes, mutated_layer

_TYPES = {"vdb": "OpenVDBAsset", "nvdb": "OpenVDBAsset", "f3d": "Field3DAsset"}


class Maker:
    """Makes inputs; `baseline` and `report` are what a run on a broken shot wrote."""

    def __init__(self, seed: int, baseline: bytes = b"", report: bytes = b"") -> None:
        self._seed = seed
        self._baseline = baseline
        self._report = report
        self._kinds = [kind for kind, weight in WEIGHTS.items() for _ in range(weight)]
        Random(f"kinds {seed}").shuffle(self._kinds)

    def make(self, number: int) -> Input:
        """The input with that number, which is the same each time."""
        rng = Random(f"{self._seed}:{number}")
        kind = self._kinds[number % len(self._kinds)]
        if kind in _STAGES:
            return _STAGES[kind](rng)
        if kind == "config":
            return self._beside(kind, texts.CONFIG, texts.configuration(rng), Role.CONFIG)
        if kind == "pyproject":
            return self._beside(kind, texts.PYPROJECT, texts.pyproject(rng), Role.PYPROJECT)
        real = self._baseline if kind == "baseline" else self._report
        data = (texts.baseline if kind == "baseline" else texts.report)(rng, real)
        return self._beside(kind, f"{kind}.json", data, Role.BASELINE)

    def _beside(self, kind: str, name: str, data: bytes, role: Role) -> Input:
        return Input(kind, {name: data, STAGE: volume("a.vdb")}, name, role)


def _layer(rng: Random) -> str:
    """A real layer: one of a random stage, or an example."""
    if rng.random() < 0.8:
        scene = generate(rng.randrange(1000), rng.randrange(1000)).scene
        inside = (layer for package in scene.packages.values() for layer in package.layers)
        return layer_text(rng.choice([*scene.layers, *inside])).replace("\0", "")
    return rng.choice(sorted((ROOT / "docs" / "examples").rglob("*.usda"))).read_text("utf-8")


def _usda(rng: Random) -> Input:
    layer = mutated_layer(rng, _layer(rng)).encode("utf-8", "surrogateescape")
    if rng.random() < 0.2:
        layer = mutated_bytes(rng, layer)
    return Input("usda", {STAGE: layer, **_around(rng)}, STAGE, is_layer=True)


def _around(rng: Random) -> dict[str, bytes]:
    """A file that the layer may name."""
    name = rng.choice(("cloud.vdb", "smoke.0001.vdb", "a.vdb", "shared/cloud.vdb"))
    return {name: (ASSETS / "cloud.vdb").read_bytes()}


def _usdc(rng: Random) -> Input:
    whole = crate(mutated_layer(rng, _layer(rng))) or crate(volume("a.vdb").decode())
    data = mutated_bytes(rng, whole) if rng.random() < 0.5 else whole
    return Input("usdc", {"stage.usdc": data}, "stage.usdc", is_layer=True)


def _usdz(rng: Random) -> Input:
    files = {"root.usda": _layer(rng).encode(), "cloud.vdb": (ASSETS / "cloud.vdb").read_bytes()}
    if rng.random() < 0.5:
        files["root.usda"] = mutated_layer(rng, files["root.usda"].decode()).encode()
        data = zipped(files)
    else:
        data = mutated_bytes(rng, zipped(files))
    return Input("usdz", {"stage.usdz": data}, "stage.usdz", is_layer=True)


def _volume_of(suffix: str) -> Callable[[Random], Input]:
    def make(rng: Random) -> Input:
        real = rng.choice(sorted(SAMPLES.glob(f"*.{suffix}"))).read_bytes()
        data = mutated_bytes(rng, real[:4000] if rng.random() < 0.2 else real)
        name = f"a.{suffix}"
        return Input(suffix, {STAGE: volume(name, _TYPES[suffix]), name: data}, STAGE)

    return make


def _built_layer(rng: Random) -> Input:
    name = rng.choice(sorted(BUILDERS))
    return Input(f"built {name}", BUILDERS[name](rng), STAGE, is_layer=True)


def _built_package(rng: Random) -> Input:
    files = built_package(rng)
    return Input("built packages", files, STAGE if STAGE in files else "stage.usdz")


def _built_volume(rng: Random) -> Input:
    return Input("built volumes", built_volume(rng), STAGE)


_STAGES: dict[str, Callable[[Random], Input]] = {
    "usda": _usda,
    "usdc": _usdc,
    "usdz": _usdz,
    **{suffix: _volume_of(suffix) for suffix in _TYPES},
    "layers": _built_layer,
    "packages": _built_package,
    "volumes": _built_volume,
}
WEIGHTS = {
    **{"usda": 22, "usdc": 9, "usdz": 9, "vdb": 9, "nvdb": 4, "f3d": 5},
    **{"layers": 22, "packages": 7, "volumes": 5},
    **{"config": 3, "pyproject": 1, "baseline": 2, "report": 2},
}
"""How many of a hundred inputs are of a kind."""
