"""Rotations and scales above prims, which make up for another up axis and other units."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from itertools import chain
from typing import Any

from pxr import Gf, Usd, UsdGeom

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.usd.settled import settle

_CLOSE = 1e-6
_MATRIX = UsdGeom.XformOp.TypeTransform
_SCALES = frozenset(
    getattr(UsdGeom.XformOp, name)
    for name in ("TypeScale", "TypeScaleX", "TypeScaleY", "TypeScaleZ")
    if hasattr(UsdGeom.XformOp, name)
)
_TRANSLATIONS = frozenset(
    getattr(UsdGeom.XformOp, name)
    for name in ("TypeTranslate", "TypeTranslateX", "TypeTranslateY", "TypeTranslateZ")
    if hasattr(UsdGeom.XformOp, name)
)


class Corrections:
    """Whether anything from a prim up to the root turns it, or scales it."""

    def __init__(self, stage: Any) -> None:
        self._stage = stage
        self._known: dict[tuple[Any, bool], bool] = {}

    def reach(self, prim: Any, is_rotation: bool) -> bool:
        """Whether a rotation, or else a scale, applies to a prim by itself or from above.

        For what is in a prototype that of one instance is enough, also of a PointInstancer's.
        """
        return settle((prim, is_rotation), self._find, self._known)

    def _find(self, key: tuple[Any, bool]) -> Generator[tuple[Any, bool], None, bool]:
        prim, is_rotation = key
        if prim.IsPseudoRoot():
            return False
        self._known[key] = False  # should instancers lead round in a circle
        for above in self._above(prim):
            around = above, is_rotation
            if around not in self._known:
                yield around
            if self._known[around]:
                return True
        return _corrects(prim, is_rotation)

    def _above(self, prim: Any) -> Iterator[Any]:
        if prim.IsPrototype():
            yield from prim.GetInstances()
        elif not _resets(prim):
            yield prim.GetParent()
        yield from self._instancers.get(prim.GetPath(), ())

    @cached_property
    def _instancers(self) -> dict[Any, list[Any]]:
        """The PointInstancers of the stage, by the paths of their prototypes."""
        found: dict[Any, list[Any]] = {}
        prototypes = map(Usd.PrimRange.AllPrims, self._stage.GetPrototypes())
        for prim in chain(self._stage.TraverseAll(), *prototypes):
            if prim.IsA(UsdGeom.PointInstancer):
                for path in UsdGeom.PointInstancer(prim).GetPrototypesRel().GetForwardedTargets():
                    found.setdefault(path, []).append(prim)
        return found


def changes_place(prim: Any) -> bool:
    """Whether an op of a prim takes it to other places over time; to turn on the spot does not."""
    moving = _TRANSLATIONS | {_MATRIX}
    return any(op.GetOpType() in moving and op.MightBeTimeVarying() for op in _ops(prim))


def resetting(prim: Any) -> Any | None:
    """The nearest prim, from this one upwards, that nothing above it moves, if one says so."""
    while prim and not _resets(prim):
        prim = prim.GetParent()
    return prim or None


def _resets(prim: Any) -> bool:
    xformable = _ordered(prim)
    return bool(xformable and xformable.GetResetXformStack())


def _corrects(prim: Any, is_rotation: bool) -> bool:
    if prim.IsA(UsdGeom.PointInstancer):
        names = ("orientations", "orientationsf") if is_rotation else ("scales",)
        if any(_has_value(prim.GetAttribute(name)) for name in names):
            return True
    return any(_op_corrects(op, is_rotation) for op in _ops(prim))


def _has_value(attribute: Any) -> bool:
    """Whether a prim has an attribute, with a value; older versions of USD lack some."""
    return bool(attribute and attribute.HasAuthoredValue())


def _ops(prim: Any) -> list[Any]:
    """The ops that count: those after a reset, if there is one."""
    xformable = _ordered(prim)
    return list(xformable.GetOrderedXformOps()) if xformable else []


def _ordered(prim: Any) -> Any | None:
    """A prim that has ops as their schema; None for all others."""
    xformable = _has_value(prim.GetAttribute("xformOpOrder")) and UsdGeom.Xformable(prim)
    return xformable or None


def _op_corrects(op: Any, is_rotation: bool) -> bool:
    """Whether an op rotates, or else scales; one that is animated does so at some time."""
    kind = op.GetOpType()
    if kind in _TRANSLATIONS or (kind in _SCALES and is_rotation):
        return False
    if kind != _MATRIX and kind not in _SCALES and not is_rotation:
        return False
    if op.MightBeTimeVarying():
        return True
    matrix = op.GetOpTransform(Usd.TimeCode.EarliestTime())
    axes = [matrix.GetRow3(row) for row in range(3)]
    if not is_rotation:
        return any(abs(axis.GetLength() - 1) > _CLOSE for axis in axes)
    units = (Gf.Vec3d.XAxis(), Gf.Vec3d.YAxis(), Gf.Vec3d.ZAxis())
    return not all(
        Gf.IsClose(axis.GetNormalized(), unit, _CLOSE)
        for axis, unit in zip(axes, units, strict=True)
    )
