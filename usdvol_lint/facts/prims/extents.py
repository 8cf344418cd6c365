"""The values of `extent`: as boxes for those that compare, as authored for those that show them."""

from __future__ import annotations

from collections.abc import Iterable
from math import inf
from typing import Any, NamedTuple, TypeAlias

from pxr import Usd, Vt

from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.facts.usd.values import Value, Values, read_values, values_of
from usdvol_lint.volumefile import Bounds

Corner: TypeAlias = tuple[float, float, float]

_ORIGIN = (0.0, 0.0, 0.0)
_LARGEST = 3.4028234663852886e38
_EMPTY_RANGE: Bounds = ((_LARGEST,) * 3, (-_LARGEST,) * 3)
"""What USD writes for an extent with nothing in it: no box, but not malformed."""


class Extent(NamedTuple):
    """One value of an `extent`: its corners if there are two, and how many elements it has."""

    size: int
    low: Corner
    high: Corner

    @property
    def is_empty_range(self) -> bool:
        """Whether it is what USD writes for nothing at all."""
        return self.size == 2 and (self.low, self.high) == _EMPTY_RANGE


class Limits:
    """The authored values of an extent, as boxes; one that is malformed counts as none."""

    __slots__ = ("_default", "_get", "_samples", "are_odd", "attribute")

    def __init__(self, attribute: Any, values: Iterable[tuple[Time, Any]]) -> None:
        self.attribute = attribute
        self.are_odd = False
        self._default: Bounds | None = None
        self._samples: dict[float, Bounds | None] = {}
        for time, value in values:
            box = box_of(value)
            self.are_odd = self.are_odd or (box is None and value is not None)
            if time is None:
                self._default = box
            else:
                self._samples[time] = box
        self._get = Usd.AttributeQuery(attribute).Get if self._samples else None

    @property
    def times(self) -> Iterable[float]:
        return self._samples.keys()

    @property
    def are_authored(self) -> bool:
        return self._default is not None or (bool(self._samples) and any(self._samples.values()))

    def at(self, time: Time) -> Bounds | None:
        """The value as USD gives it: samples hide a default, and are interpolated between."""
        if time is None or self._get is None:
            return self._default
        return self._samples[time] if time in self._samples else box_of(self._get(time))


def read_limits(batch: PrimBatch) -> list[Limits]:
    """Every `extent` of many prims as boxes."""
    attributes, counts = batch.attributes("extent"), batch.counts("extent")
    return [
        Limits(attribute, read_values(attribute) if count else ((None, value),))
        for attribute, count, value in zip(attributes, counts, batch.values("extent"), strict=True)
    ]


def box_of(value: Any) -> Bounds | None:
    """The corners of an extent, if it is one or the empty range."""
    if not isinstance(value, Vt.Vec3fArray) or len(value) != 2:
        return None
    corners: Any = memoryview(value).tolist()  # a tenth of the time that USD's own vectors take
    (a, b, c), (x, y, z) = corners
    ordered = -inf < a <= x < inf and -inf < b <= y < inf and -inf < c <= z < inf
    box = (a, b, c), (x, y, z)
    return box if ordered or box == _EMPTY_RANGE else None


def read_extents(attribute: Any) -> Values:
    """Every value that is an array of vectors: what else there may be is no extent to USD."""
    values = values_of(attribute)
    extents = [
        Value(time, _extent(value))
        for time, value in values.samples
        if isinstance(value, Vt.Vec3fArray)
    ]
    return Values(attribute, tuple(extents), values.total)


def _extent(value: Any) -> Extent:
    if len(value) != 2:
        return Extent(len(value), _ORIGIN, _ORIGIN)
    return Extent(2, tuple(value[0]), tuple(value[1]))
