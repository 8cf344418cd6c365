"""Where a prim of a prototype appears on the stage, and how often."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any, NamedTuple

from pxr import Sdf, Usd


class Shown(NamedTuple):
    """The first of the stage paths at which a prim appears, and through how many instances."""

    path: str
    instances: int


def shown(prim: Any) -> Shown:
    """Where a prim appears; outside prototypes, once, at its own path."""
    if not prim.IsInPrototype():
        return Shown(str(prim.GetPath()), 1)
    below = path_in_prototype(prim)
    through = [shown(instance) for instance in instances_of(_prototype(prim))]
    path = min(instance.path for instance in through)
    return Shown(path + below, sum(instance.instances for instance in through))


def as_shown(prims: Iterable[Any]) -> list[Any]:
    """Prims in the order of the paths at which they appear, each once.

    The paths of prototypes are no order: USD numbers these differently from run to run.
    """
    prototypes = cache(lambda prototype: shown(prototype).path)

    def path(prim: Any) -> Any:
        if not prim.IsInPrototype():
            return prim.GetPath()
        return Sdf.Path(prototypes(_prototype(prim)) + path_in_prototype(prim))

    return sorted(dict.fromkeys(prims), key=path)


def shown_paths(prim: Any) -> list[str]:
    """Every stage path at which a prim appears, in ascending order."""
    if not prim.IsInPrototype():
        return [str(prim.GetPath())]
    below = path_in_prototype(prim)
    instances = instances_of(_prototype(prim))
    return sorted(path + below for instance in instances for path in shown_paths(instance))


def instances_of(prototype: Any) -> list[Any]:
    """The instances through which a prototype appears; all of them if it appears through none."""
    instances: list[Any] = prototype.GetInstances()
    return list(filter(_appears, instances)) or instances


def appears(prototype: Any) -> bool:
    """Whether a prototype has an instance that is not part of a `class`, also in prototypes."""
    return any(map(_appears, prototype.GetInstances()))


def _appears(instance: Any) -> bool:
    if instance.IsInPrototype():
        return appears(_prototype(instance))
    return not instance.IsAbstract()


def path_in_prototype(prim: Any) -> str:
    """The path relative to the prototype, equal for all instances; outside one, the whole path."""
    path = str(prim.GetPath())
    return path[len(str(_prototype(prim).GetPath())) :] if prim.IsInPrototype() else path


def shown_path(stage: Any, path: Any) -> str:
    """A path, of a prim or of none, with a prototype replaced by the first of its instances."""
    root = path.GetPrefixes()[0] if path.pathElementCount else path
    prim = stage.GetPrimAtPath(root)
    if not prim or not prim.IsInPrototype():
        return str(path)
    return shown(prim).path + str(path)[len(str(root)) :]


def _prototype(prim: Any) -> Any:
    """The root of the prototype that a prim is in."""
    while not prim.IsPrototype():
        prim = prim.GetParent()
    return prim


def in_prototype(prim: Any) -> Any:
    """The prim of the prototype for an instance proxy; any other prim itself."""
    return prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim


def is_live(prim: Any) -> bool:
    """Whether a prim is active, loaded, defined and not abstract, as a traversal asks."""
    return bool(Usd.PrimDefaultPredicate(prim))


def live_prototypes(stage: Any) -> list[Any]:
    """The prototypes with an instance that a traversal visits, or that lies in a prototype."""
    return [each for each in stage.GetPrototypes() if any(map(is_live, each.GetInstances()))]
