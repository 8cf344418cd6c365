"""Where a field stands in the space of its Volume."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from pxr import Gf, Usd

from usdvol_lint.facts.usd.calls import get_attribute, get_parent, get_value, is_in_prototype
from usdvol_lint.facts.usd.instances import shown_paths
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.volumefile.transform import IDENTITY, Matrix, finite, rows

_ROUNDING = 1e-6


class Displacement(NamedTuple):
    """How a field is moved in relation to its Volume, in words, and when.

    `times` are empty where nothing is animated; else the words are those of the first.
    """

    words: str
    times: tuple[float, ...]


class Placement(NamedTuple):
    """The way from a field's space up to what it shares with its Volume, and down to that.

    `up` and `down` are the prims on it that have a transform, each from the bottom; what moves both
    together is left out.
    `times` are those at which these transforms have samples.
    """

    up: tuple[Any, ...]
    down: tuple[Any, ...]
    times: tuple[float, ...]

    def matrix(self, time: Time) -> Matrix | None:
        """From the field's space to the Volume's; None where the numbers allow none.

        It is `IDENTITY` itself where nothing on the way has a transform.
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
        """What the matrix does if it is not identity, at one time at least."""
        found = [(time, words) for time in self.times or (None,) if (words := self._words(time))]
        if not found:
            return None
        return Displacement(found[0][1], tuple(time for time, _ in found if time is not None))

    def _words(self, time: Time) -> str:
        """What the matrix does at a time; empty where it is identity but for rounding."""
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


AT_REST = Placement((), (), ())


def displacement(volume: Any, field: Any) -> Displacement | None:
    """How a field is moved in relation to a Volume that binds it, where it first is."""
    for path, placement in read_placements(volume, field):
        if found := placement.displacement():
            return found._replace(words=f"{found.words} in <{path}>") if path else found
    return None


def read_placements(volume: Any, field: Any) -> Iterator[tuple[str, Placement]]:
    """Reads the transforms between a field and a Volume that binds it.

    There are several where instances show the Volume and not the field; each of these is told by
    its path.
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
        return AT_REST
    if up_resets and not down_resets:  # what is above both moves the Volume alone
        down, _ = _transformed(volume, volume.GetPath().pathElementCount)
    elif down_resets and not up_resets:
        up, _ = _transformed(field, field.GetPath().pathElementCount)
    times = {time for xformable in (*up, *down) for time in xformable.GetTimeSamples()}
    return Placement(up, down, tuple(sorted(times)))


def _counts(volume: Any, field: Any) -> tuple[int, int]:
    """How many prims there are from the field, and from the Volume, up to what they share."""
    if get_parent(field) == volume:  # so it is nearly always
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
    """The transformed ones of so many prims from one upward; whether the last of them resets."""
    found = []
    for _ in range(count):
        if get_value(get_attribute(prim, "xformOpOrder")):  # most have none, and this costs least
            from pxr import UsdGeom  # costs start-up time

            xformable = UsdGeom.Xformable(prim)
            if xformable:
                found.append(xformable)
                if xformable.GetResetXformStack():
                    return tuple(found), True
        prim = get_parent(prim)
    return tuple(found), False
