"""Transform ops that are not there, or not finite."""

from __future__ import annotations

from typing import Any, NamedTuple

from pxr import Vt

from usdvol_lint.facts.usd.values import Values, values_of
from usdvol_lint.nearest import closest_match

_RESET = "!resetXformStack!"
_INVERSE = "!invert!"


class MissingOp(NamedTuple):
    """A name in `order`, the attribute `xformOpOrder`, of no op, and the op probably intended."""

    order: Any
    name: str
    intended: str | None


class TransformFaults(NamedTuple):
    """What is wrong with a prim's transform; of ops that are `not_finite`, the values that are."""

    missing: tuple[MissingOp, ...] = ()
    not_finite: tuple[Values, ...] = ()


def transform_faults(prim: Any) -> TransformFaults:
    """The faults of the ops that count: those after the last reset of the transform stack."""
    order = prim.GetAttribute("xformOpOrder")
    value = order.Get()
    if not isinstance(value, Vt.TokenArray):
        return TransformFaults()
    names = list(value)
    if _RESET in names:
        names = names[len(names) - names[::-1].index(_RESET) :]
    ops = list(dict.fromkeys(name.removeprefix(_INVERSE) for name in names))
    there = [name for name in ops if prim.HasAttribute(name)]
    missing = (MissingOp(order, op, _intended(prim, op, ops)) for op in ops if op not in there)
    values = (values_of(prim.GetAttribute(name)) for name in there)
    not_finite = (group for each in values for _, group in each.grouped(_is_not_finite))
    return TransformFaults(tuple(missing), tuple(not_finite))


def _intended(prim: Any, missing: str, ordered: list[str]) -> str | None:
    """The op of the prim that is in no order and has nearly that name."""
    names = prim.GetAuthoredPropertyNames()
    unused = sorted(name for name in names if name.startswith("xformOp:") and name not in ordered)
    return closest_match(missing, unused)


def _is_not_finite(value: Any) -> bool | None:
    """True for numbers, vectors, quaternions and matrices with NaN or infinity; else None."""
    try:
        difference = value - value
    except TypeError:
        return None  # a block, or another type, which is another rule's
    return None if difference == difference else True  # NaN alone differs from itself
