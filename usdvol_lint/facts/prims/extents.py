"""The values of `extent`: as boxes to compare with, and as authored to report."""

from __future__ import annotations

from collections.abc import Iterable
from math import inf, isfinite
from typing import Any, NamedTuple, TypeAlias

from pxr import Usd, Vt

from usdvol_lint.facts.prims.boxes import encloses, magnitude
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.facts.usd.values import Value, Values, read_values, values_of
from usdvol_lint.volumefile import Bounds

Corner: TypeAlias = tuple[float, float, float]

_ORIGIN = (0.0, 0.0, 0.0)
_LIKELY = 1e6
_LARGEST = 3.4028234663852886e38
_EMPTY_RANGE: Bounds = ((_LARGEST,) * 3, (-_LARGEST,) * 3)
"""What USD writes as the extent of nothing: its minimum is above its maximum, but it is valid."""


class Extent(NamedTuple):
    """One value of `extent`: its number of elements, and its corners, zeros unless it has two."""

    size: int
    low: Corner
    high: Corner

    @property
    def is_empty_range(self) -> bool:
        """Whether it is what USD writes as the extent of nothing."""
        return self.size == 2 and (self.low, self.high) == _EMPTY_RANGE

    @property
    def is_finite(self) -> bool:
        return all(map(isfinite, self.low + self.high))

    @property
    def in_order(self) -> str:
        """Its corners, with the lesser number of each axis first, as in a layer.

        Empty where numbers are so large that they hardly are corners.
        """
        if max(map(abs, self.low + self.high)) > _LIKELY:
            return ""
        corners = (map(choose, self.low, self.high) for choose in (min, max))
        written = (", ".join(f"{number:.7g}" for number in corner) for corner in corners)
        return f"[({next(written)}), ({next(written)})]"


class Limits:
    """The authored values of `extent` as boxes, in which a malformed value counts as None."""

    __slots__ = ("_default", "_get", "_samples", "are_malformed", "attribute")

    def __init__(self, attribute: Any, values: Iterable[tuple[Time, Any]]) -> None:
        self.attribute = attribute
        self.are_malformed = False
        self._default: Bounds | None = None
        self._samples: dict[float, Bounds | None] = {}
        for time, value in values:
            box = box_of(value)
            self.are_malformed = self.are_malformed or (box is None and value is not None)
            if time is None:
                self._default = box
            else:
                self._samples[time] = box
        self._get = Usd.AttributeQuery(attribute).Get if self._samples else None

    @property
    def times(self) -> Iterable[float]:
        """The times of the samples, in ascending order."""
        return self._samples.keys()

    @property
    def longest_side(self) -> float:
        """That of the first box; 0 without one."""
        box = self.at(next(iter(self.times), None))
        return max(end - begin for begin, end in zip(*box, strict=True)) if box else 0.0

    @property
    def are_authored(self) -> bool:
        """Whether at least one value is a box."""
        return self._default is not None or (bool(self._samples) and any(self._samples.values()))

    def at(self, time: Time) -> Bounds | None:
        """The value at a time, as USD resolves it: samples hide a default, and are interpolated."""
        if time is None or self._get is None:
            return self._default
        return self._samples[time] if time in self._samples else box_of(self._get(time))


def read_limits(batch: PrimBatch) -> list[Limits]:
    """The `extent` of each prim of a batch."""
    attributes, counts = batch.attributes("extent"), batch.counts("extent")
    return [
        Limits(attribute, read_values(attribute) if count else ((None, value),))
        for attribute, count, value in zip(attributes, counts, batch.values("extent"), strict=True)
    ]


def box_of(value: Any) -> Bounds | None:
    """The corners of a valid value of `extent`, which may be the empty range; else None."""
    if not isinstance(value, Vt.Vec3fArray) or len(value) != 2:
        return None
    corners: Any = memoryview(value).tolist()  # a tenth of the time that USD's own vectors take
    (a, b, c), (x, y, z) = corners
    ordered = -inf < a <= x < inf and -inf < b <= y < inf and -inf < c <= z < inf
    box = (a, b, c), (x, y, z)
    return box if ordered or box == _EMPTY_RANGE else None


def outside_box(box: Bounds, values: Iterable[Any], relative_slack: float) -> bool:
    """Whether one of the values of `extent` is a box that another one does not enclose."""
    boxes = (box_of(value) for value in values)
    return any(
        not encloses(box, other, relative_slack * magnitude(other)) for other in boxes if other
    )


def read_extents(attribute: Any) -> Values:
    """All values that are arrays of vectors, as `Extent`; USD takes no other for an extent."""
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
