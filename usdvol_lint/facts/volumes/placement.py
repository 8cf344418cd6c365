"""The placement of a field in the space of a Volume: the transforms between the two."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any, NamedTuple

from pxr import Gf, Usd

from usdvol_lint.facts.usd.calls import get_attribute, get_parent, get_value, is_in_prototype
from usdvol_lint.facts.usd.instances import shown_paths
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.volumefile.transform import IDENTITY, Matrix, finite, rows

_ROUNDING = 1e-6


class Displacement(NamedTuple):
    """How transforms move a field relative to its Volume, in words, and at which times.

    `times` are empty where nothing is animated; the words are for the first of them.
    `against` are the attributes of the transforms.
    """

    words: str
    times: tuple[float, ...]
    against: tuple[Any, ...] = ()


class Placement(NamedTuple):
    """The transformed prims between a field and a Volume, without those that move both.

    `up` leads from the field, and `down` from the Volume, each upward to the lowest prim above
    both; `times` are those at which these transforms have samples.
    """

    up: tuple[Any, ...]
    down: tuple[Any, ...]
    times: tuple[float, ...]

    def matrix(self, time: Time) -> Matrix | None:
        """From the field's space to the Volume's; None if not finite or not invertible.

        It is `IDENTITY` itself where no prim is transformed.
        """
        if not self.up and not self.down:
            return IDENTITY
        relative, volume = _product(self.up, time), _product(self.down, time)
        if self.down:
            if not abs(volume.GetDeterminant()) > 0:  # nor if it is NaN
                return None
            relative *= volume.GetInverse()
        numbers = tuple(relative[row][column] for row in range(4) for column in range(4))
        return rows(numbers) if finite(numbers) else None

    def displacement(self) -> Displacement | None:
        """In words what the matrix does, at the times at which it is not the identity."""
        moved = [(time, words) for time in self.times or (None,) if (words := self._words(time))]
        if not moved:
            return None
        times = tuple(time for time, _ in moved if time is not None)
        return Displacement(moved[0][1], times, self.attributes)

    @property
    def attributes(self) -> tuple[Any, ...]:
        """The attributes of the transforms, and those that say their order."""
        every = (*self.up, *self.down)
        ops = chain.from_iterable(each.GetOrderedXformOps() for each in every)
        return (*(op.GetAttr() for op in ops), *(each.GetXformOpOrderAttr() for each in every))

    def _words(self, time: Time) -> str:
        """In words what the matrix does; empty where it is the identity up to rounding."""
        matrix = self.matrix(time)
        if matrix is None or matrix is IDENTITY:
            return ""
        *axes, (x, y, z, _) = matrix
        turned = any(
            abs(number - (row == column)) > _ROUNDING
            for row, axis in enumerate(axes)
            for column, number in enumerate(axis)
        )
        magnitude = max(1.0, *map(abs, _product(self.up, time).ExtractTranslation()))
        moved = max(map(abs, (x, y, z))) > _ROUNDING * magnitude
        movement = f"moved by ({x:.6g}, {y:.6g}, {z:.6g})" if moved else ""
        return " and ".join(filter(None, ("rotated or scaled" if turned else "", movement)))


UNTRANSFORMED = Placement((), (), ())
"""The placement where nothing is transformed; code may test for its identity."""


def displacement(volume: Any, field: Any) -> Displacement | None:
    """How a field is moved relative to a Volume that binds it, in the first instance that is."""
    for path, placement in read_placements(volume, field):
        if moved := placement.displacement():
            return moved._replace(words=f"{moved.words} in <{path}>") if path else moved
    return None


def read_placements(volume: Any, field: Any) -> Iterator[tuple[str, Placement]]:
    """Reads the placement of a field for a Volume that binds it, with the path of the instance.

    There is one placement, and its path is empty, unless several instances show the Volume and the
    field is outside of them.
    """
    if not is_in_prototype(volume) or is_in_prototype(field):
        yield "", _read_placement(volume, field)
        return
    paths = shown_paths(volume)
    for path in paths:
        instance = volume.GetStage().GetPrimAtPath(path)
        yield path if len(paths) > 1 else "", _read_placement(instance, field)


def _read_placement(volume: Any, field: Any) -> Placement:
    up_count, down_count = _counts(volume, field)
    up, up_resets = _transformed(field, up_count)
    down, down_resets = _transformed(volume, down_count)
    if not up and not down:
        return UNTRANSFORMED
    if up_resets and not down_resets:  # what is above both moves the Volume alone
        down, _ = _transformed(volume, volume.GetPath().pathElementCount)
    elif down_resets and not up_resets:
        up, _ = _transformed(field, field.GetPath().pathElementCount)
    times = {time for xformable in (*up, *down) for time in xformable.GetTimeSamples()}
    return Placement(up, down, tuple(sorted(times)))


def _counts(volume: Any, field: Any) -> tuple[int, int]:
    """How many prims there are from each upward, without those above both."""
    if get_parent(field) == volume:  # nearly always
        return 1, 0
    from_field, from_volume = field.GetPath(), volume.GetPath()
    shared = from_field.GetCommonPrefix(from_volume).pathElementCount
    return from_field.pathElementCount - shared, from_volume.pathElementCount - shared


def _product(chain: Iterable[Any], time: Time) -> Any:
    code = Usd.TimeCode.Default() if time is None else Usd.TimeCode(time)
    product = Gf.Matrix4d(1)
    for xformable in chain:
        product *= xformable.GetLocalTransformation(code)
    return product


def _transformed(prim: Any, count: int) -> tuple[tuple[Any, ...], bool]:
    """The transformed ones of `count` prims from one upward, and whether the last of them resets.

    A prim that resets the transform stack ends the search.
    """
    transformed = []
    for _ in range(count):
        if get_value(get_attribute(prim, "xformOpOrder")):  # most prims have none
            from pxr import UsdGeom  # costs start-up time

            xformable = UsdGeom.Xformable(prim)
            if xformable:
                transformed.append(xformable)
                if xformable.GetResetXformStack():
                    return tuple(transformed), True
        prim = get_parent(prim)
    return tuple(transformed), False
