"""Where a prim of a prototype appears on the stage, and how often."""

from __future__ import annotations

from collections.abc import Generator, Iterable
from enum import IntEnum
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

from pxr import Sdf

from usdvol_lint.facts.usd.calls import (
    get_parent,
    get_path,
    get_stage,
    is_in_prototype,
    is_instance_proxy,
    is_prototype,
    prim_at,
)
from usdvol_lint.facts.usd.settled import settle

_MOST_PATHS = 10_000
_MOST_STEPS = 250_000
"""So many steps up from each prim above the paths of one prim, together: as many as USD takes.

It makes each prim above an instance anew, from the root of the stage.
"""


class Standing(IntEnum):
    """How an instance stands on the stage, the best first.

    Traversals visit it; or an `over` stands above that nothing defines, so that at most a
    PointInstancer draws it; or it is part of a `class`.
    """

    DEFINED = 0
    UNDEFINED = 1
    ABSTRACT = 2


class Shown(NamedTuple):
    """The first of the stage paths at which a prim appears, and through how many instances."""

    path: str
    instances: int


class _Prototypes:
    """What is known of the prototypes of a stage, as it is composed now."""

    def __init__(self) -> None:
        self.standings: dict[Any, Standing] = {}
        self.instances: dict[Any, list[Any]] = {}
        self.shown: dict[Any, Shown] = {}
        self.cut: dict[Any, str] = {}


_PROTOTYPE = "/__Prototype_"
"""How the paths of prototypes begin, and of what a user may call so."""
_PROTOTYPES: WeakKeyDictionary[Any, _Prototypes] = WeakKeyDictionary()


def forget_prototypes(stage: Any) -> None:
    """Says that a stage was composed in another way."""
    _PROTOTYPES.pop(stage, None)


def _known(prim: Any) -> _Prototypes:
    stage = get_stage(prim)
    if stage not in _PROTOTYPES:
        _PROTOTYPES[stage] = _Prototypes()
    return _PROTOTYPES[stage]


def shown(prim: Any) -> Shown:
    """Where a prim appears; outside prototypes, once, at its own path."""
    if not is_in_prototype(prim):
        return Shown(str(get_path(prim)), 1)
    path, instances = settle(prototype_of(prim), _find_shown, _known(prim).shown)
    return Shown(path + path_in_prototype(prim), instances)


def _find_shown(prototype: Any) -> Generator[Any, None, Shown]:
    """Instances are multiplied and not walked: each may be in a prototype with instances itself."""
    known = _known(prototype).shown
    first, count = "", 0
    for instance in instances_of(prototype):
        around = prototype_of(instance) if instance.IsInPrototype() else None
        if around and around not in known:
            yield around
        path, instances = shown(instance)
        first = min(first, path) if count else path
        count += instances
    return Shown(first, count)


def as_shown(prims: Iterable[Any]) -> list[Any]:
    """Prims in the order of the paths at which they appear, each once.

    The paths of prototypes are no order: USD numbers these differently from run to run.
    """

    def path(prim: Any) -> Any:
        return Sdf.Path(shown(prim).path) if prim.IsInPrototype() else prim.GetPath()

    return sorted(dict.fromkeys(prims), key=path)


def shown_paths(prim: Any) -> list[str]:
    """The stage paths at which a prim appears, in ascending order; not all where it has very many.

    A few prototypes in one another can show a prim more often than a computer can count.
    `cut_short` tells of which prims there are more.
    """
    found: list[str] = []
    waiting, left = [(prim, "")], _MOST_STEPS
    while waiting and len(found) < _MOST_PATHS and (left > 0 or not found):
        each, below = waiting.pop()
        if each.IsInPrototype():
            below = path_in_prototype(each) + below
            waiting += ((outer, below) for outer in reversed(instances_of(prototype_of(each))))
        else:
            found.append(f"{each.GetPath()}{below}")
            left -= found[-1].count("/") ** 2
    if waiting:
        tell_cut(
            prim,
            f"where it is and when it is visible was looked at for the first {len(found):,} of the "
            "instances that show it",
        )
    return sorted(found)


def tell_cut(prim: Any, words: str) -> None:
    """Says of a prim that not all of what shows it was looked at."""
    _known(prim).cut[prim] = words


def cut_short(stage: Any) -> list[tuple[Any, str]]:
    """The prims that are shown more often than what was looked at, and what that was."""
    return list(_PROTOTYPES[stage].cut.items()) if stage in _PROTOTYPES else []


def instances_of(prototype: Any) -> list[Any]:
    """The instances through which a prototype appears: those of the best standing."""
    known = _known(prototype).instances
    if prototype not in known:
        best = standing_of(prototype)
        every = prototype.GetInstances()
        known[prototype] = [each for each in every if _standing_of(each) is best]
    return known[prototype]


def standing_of(prototype: Any) -> Standing:
    """The best standing of its instances."""
    return settle(prototype, _find_standing, _known(prototype).standings)


def _find_standing(prototype: Any) -> Generator[Any, None, Standing]:
    known = _known(prototype).standings
    best = Standing.ABSTRACT
    for instance in prototype.GetInstances():
        around = prototype_of(instance) if instance.IsInPrototype() else None
        if around and around not in known:
            yield around
        best = min(best, _standing_of(instance))
        if best is Standing.DEFINED:
            break
    return best


def _standing_of(instance: Any) -> Standing:
    """Its own, or that of the prototype that it is in if that is worse."""
    if instance.IsAbstract():
        return Standing.ABSTRACT
    own = Standing.DEFINED if instance.IsDefined() else Standing.UNDEFINED
    around = instance.IsInPrototype()
    return max(own, standing_of(prototype_of(instance))) if around else own


def path_in_prototype(prim: Any) -> str:
    """The path relative to the prototype, equal for all instances; outside one, the whole path."""
    path = str(get_path(prim))
    return path[len(str(get_path(prototype_of(prim)))) :] if is_in_prototype(prim) else path


def shown_path(stage: Any, path: Any) -> str:
    """A path, of a prim or of none, with a prototype replaced by the first of its instances."""
    if not str(path).startswith(_PROTOTYPE):
        return str(path)
    root = path.GetPrefixes()[0] if path.pathElementCount else path
    prim = stage.GetPrimAtPath(root)
    if not prim or not prim.IsInPrototype():
        return str(path)
    return shown(prim).path + str(path)[len(str(root)) :]


def prototype_of(prim: Any) -> Any:
    """The root of the prototype that a prim is in."""
    while not is_prototype(prim):
        prim = get_parent(prim)
    return prim


def on_stage(prim: Any) -> Any:
    """The prim where it appears first: what is above it there, a prototype does not have."""
    return prim_at(get_stage(prim), shown(prim).path) if is_in_prototype(prim) else prim


def in_prototype(prim: Any) -> Any:
    """The prim of the prototype for an instance proxy; any other prim itself."""
    return prim.GetPrimInPrototype() if is_instance_proxy(prim) else prim
