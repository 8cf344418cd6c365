"""Which fields are used: by a Volume, or by what something wrong with a Volume was meant to be."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.prims.tables import Slot
from usdvol_lint.facts.usd.instances import in_prototype, shown
from usdvol_lint.facts.usd.kinds import Kinds
from usdvol_lint.facts.volumes.bindings import FieldBindings
from usdvol_lint.facts.volumes.intended import FieldNames


class UsedFields:
    """The fields that are accounted for under any variant selection that was looked at, by path."""

    def __init__(self) -> None:
        self._paths: set[Any] = set()

    def add(self, paths: Iterable[Any]) -> None:
        self._paths.update(paths)

    def missing_of(self, paths: Iterable[Any]) -> set[Any]:
        """Those of some paths that are not accounted for yet."""
        return set(paths) - self._paths

    def never_get(self, path: Any) -> Callable[[], bool]:
        """Asks, once more selections were looked at, whether none of them accounts for a field."""
        paths = self._paths
        return lambda: path not in paths


def accounted_for(
    volume: Any, bindings: FieldBindings, kinds: Kinds, names: FieldNames
) -> Iterator[Any]:
    """The paths of unused fields for which something wrong with a Volume accounts.

    They lie below it, or a broken relationship was probably meant to target them.
    """
    if not bindings.is_sound:
        yield from (in_prototype(field).GetPath() for field in _fields_below(volume, kinds))
        yield from filter(None, map(names.meant_by, bindings.bindings))


def unbound_fields(
    volume: Any, kinds: Kinds, places: Mapping[Any, Slot], users: Mapping[Slot, int]
) -> list[Any]:
    """The field prims below a Volume that no Volume targets; `users` are counted by place."""
    below = _fields_below(volume, kinds)
    return [each for each in below if places.get(in_prototype(each).GetPath()) not in users]


def is_shared(
    volume: Any, field: Any, places: Mapping[Any, Slot], users: Mapping[Slot, int]
) -> bool:
    """Whether other Volumes target a field of this one too, or instances of this one do."""
    place = places.get(in_prototype(field).GetPath())
    if place and users[place] > 1:
        return True
    instanced = volume.IsInPrototype() and not field.IsInPrototype()
    return bool(instanced and shown(volume).instances > 1)


def _fields_below(volume: Any, kinds: Kinds) -> list[Any]:
    """The field prims below a Volume, those inside instances too."""
    below = Usd.PrimRange(volume, Usd.TraverseInstanceProxies())
    return [prim for prim in below if kinds.is_a(prim, schema.FIELD)]
