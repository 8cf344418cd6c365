"""Transform ops that are not there, or not finite."""

from __future__ import annotations

from itertools import permutations
from typing import Any, NamedTuple

from pxr import Vt

from usdvol_lint.facts.usd.values import Values, values_of
from usdvol_lint.nearest import closest_match

_NAMESPACE = "xformOp:"
_RESET = "!resetXformStack!"
_INVERSE = "!invert!"


_AXES = ("", "X", "Y", "Z")
_OP_TYPES = frozenset(
    [f"{kind}{axis}" for kind in ("translate", "scale") for axis in _AXES]
    + [f"rotate{''.join(axes)}" for count in (1, 3) for axes in permutations("XYZ", count)]
    + ["orient", "transform"]
)
"""The union over all USD versions: translation and scale along one axis are new in 26."""


class MissingOp(NamedTuple):
    """A name in `order`, the attribute `xformOpOrder`, of no op, and the op probably intended.

    `is_there`: whether an attribute has that name, which is that of no op all the same.
    """

    order: Any
    name: str
    intended: str | None
    is_there: bool


class TransformFaults(NamedTuple):
    """What is wrong with a prim's transform; of ops that are `not_finite`, the values that are."""

    missing: tuple[MissingOp, ...] = ()
    not_finite: tuple[Values, ...] = ()


def transform_faults(prim: Any) -> TransformFaults:
    """The faults of the ops that count: those after the last reset of the transform stack."""
    names = _ordered(prim)
    if _RESET in names:
        names = names[len(names) - names[::-1].index(_RESET) :]
    ops = list(dict.fromkeys(name.removeprefix(_INVERSE) for name in names))
    there = [name for name in ops if prim.HasAttribute(name) and _is_op(name)]
    order = prim.GetAttribute("xformOpOrder")
    missing = (
        MissingOp(order, op, _intended(prim, op, ops), bool(prim.HasAttribute(op)))
        for op in ops
        if op not in there
    )
    values = (values_of(prim.GetAttribute(name)) for name in there)
    not_finite = (group for each in values for _, group in each.grouped(_is_not_finite))
    return TransformFaults(tuple(missing), tuple(not_finite))


def resets(prim: Any) -> bool:
    """Whether no transform from above a prim counts for it."""
    return _RESET in _ordered(prim)


def _ordered(prim: Any) -> list[str]:
    value = prim.GetAttribute("xformOpOrder").Get()
    return list(value) if isinstance(value, Vt.TokenArray) else []


def _intended(prim: Any, missing: str, ordered: list[str]) -> str | None:
    """The op of the prim that is in no order and has nearly that name."""
    names = prim.GetAuthoredPropertyNames()
    unused = sorted(name for name in names if _is_op(name) and name not in ordered)
    in_full = f"{_NAMESPACE}{missing}"
    return in_full if in_full in unused else closest_match(missing, unused)


def _is_op(name: str) -> bool:
    """Whether a name is that of an op: of a type of UsdGeom's, with or without a suffix."""
    return name.startswith(_NAMESPACE) and name.split(":")[1] in _OP_TYPES


def _is_not_finite(value: Any) -> bool | None:
    """True for numbers, vectors, quaternions and matrices with NaN or infinity; else None."""
    try:
        difference = value - value
    except TypeError:
        return None  # a block, or another type, which is another rule's
    return None if difference == difference else True  # NaN alone differs from itself
