"""Asks USD itself: stages from text in memory, and what USD says of them."""

from __future__ import annotations

from collections import deque

import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdUtils

with_particles = pytest.mark.skipif(
    Usd.GetVersion() < (0, 26, 3), reason="this USD has no particle fields"
)

_kept: deque[Usd.Stage] = deque(maxlen=8)
"""A prim does not keep its stage."""


def stage(text: str, **layers: str) -> Usd.Stage:
    """The stage of a text, in which `@name@` stands for the layer of that name."""
    made = {name: layer(content) for name, content in layers.items()}
    for name, other in made.items():
        text = text.replace(f"@{name}@", f"@{other.identifier}@")
    _kept.append(Usd.Stage.Open(layer(text)))
    return _kept[-1]


def layer(text: str) -> Sdf.Layer:
    made = Sdf.Layer.CreateAnonymous(".usda")
    made.ImportFromString(f"#usda 1.0\n{text}")
    return made


def bounds(of: Usd.Stage, path: str) -> Gf.Range3d:
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_])
    return cache.ComputeWorldBound(of.GetPrimAtPath(path)).ComputeAlignedRange()


def finite(numbers: Gf.Range3d) -> bool:
    return all(abs(number) < float("inf") for corner in numbers_of(numbers) for number in corner)


def numbers_of(found: Gf.Range3d) -> tuple[Gf.Vec3d, Gf.Vec3d]:
    return found.GetMin(), found.GetMax()


class Said:
    """What USD warns of on the console while the block runs."""

    def __enter__(self) -> list[str]:
        self.texts: list[str] = []
        self._delegate = UsdUtils.CoalescingDiagnosticDelegate()
        return self.texts

    def __exit__(self, *_: object) -> None:
        self.texts += [one.commentary for one in self._delegate.TakeUncoalescedDiagnostics()]
        del self._delegate
