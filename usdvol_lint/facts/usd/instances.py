"""Where a prim of a prototype appears on the stage, and how often."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import IntEnum
from functools import cache
from itertools import islice
from typing import Any, NamedTuple

from pxr import Sdf

_MOST_PATHS = 10_000


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


def shown(prim: Any) -> Shown:
    """Where a prim appears; outside prototypes, once, at its own path."""
    return _shown(prim, {})


def _shown(prim: Any, prototypes: dict[Any, Shown]) -> Shown:
    """As `shown`; `prototypes` keeps what is known, since many instances lead to the same one."""
    if not prim.IsInPrototype():
        return Shown(str(prim.GetPath()), 1)
    prototype = prototype_of(prim)
    if prototype not in prototypes:
        through = [_shown(instance, prototypes) for instance in instances_of(prototype)]
        prototypes[prototype] = Shown(
            min(instance.path for instance in through),
            sum(instance.instances for instance in through),
        )
    path, instances = prototypes[prototype]
    return Shown(path + path_in_prototype(prim), instances)


def as_shown(prims: Iterable[Any]) -> list[Any]:
    """Prims in the order of the paths at which they appear, each once.

    The paths of prototypes are no order: USD numbers these differently from run to run.
    """
    prototypes = cache(lambda prototype: shown(prototype).path)

    def path(prim: Any) -> Any:
        if not prim.IsInPrototype():
            return prim.GetPath()
        return Sdf.Path(prototypes(prototype_of(prim)) + path_in_prototype(prim))

    return sorted(dict.fromkeys(prims), key=path)


def shown_paths(prim: Any) -> list[str]:
    """The stage paths at which a prim appears, in ascending order; not all where it has very many.

    A few prototypes in one another can show a prim more often than a computer can count.
    """
    return sorted(islice(_paths(prim), _MOST_PATHS))


def _paths(prim: Any) -> Iterator[str]:
    if not prim.IsInPrototype():
        yield str(prim.GetPath())
        return
    below = path_in_prototype(prim)
    for instance in instances_of(prototype_of(prim)):
        yield from (path + below for path in _paths(instance))


def instances_of(prototype: Any) -> list[Any]:
    """The instances through which a prototype appears: those of the best standing."""
    standings = [(_standing_of(instance), instance) for instance in prototype.GetInstances()]
    best = min(standing for standing, _ in standings)
    return [instance for standing, instance in standings if standing is best]


def standing_of(prototype: Any) -> Standing:
    """The best standing of its instances."""
    best = Standing.ABSTRACT
    for instance in prototype.GetInstances():
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
    path = str(prim.GetPath())
    return path[len(str(prototype_of(prim).GetPath())) :] if prim.IsInPrototype() else path


def shown_path(stage: Any, path: Any) -> str:
    """A path, of a prim or of none, with a prototype replaced by the first of its instances."""
    root = path.GetPrefixes()[0] if path.pathElementCount else path
    prim = stage.GetPrimAtPath(root)
    if not prim or not prim.IsInPrototype():
        return str(path)
    return shown(prim).path + str(path)[len(str(root)) :]


def prototype_of(prim: Any) -> Any:
    """The root of the prototype that a prim is in."""
    while not prim.IsPrototype():
        prim = prim.GetParent()
    return prim


def on_stage(prim: Any) -> Any:
    """The prim where it appears first: what is above it there, a prototype does not have."""
    return prim.GetStage().GetPrimAtPath(shown(prim).path) if prim.IsInPrototype() else prim


def in_prototype(prim: Any) -> Any:
    """The prim of the prototype for an instance proxy; any other prim itself."""
    return prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
