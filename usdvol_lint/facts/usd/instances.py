"""Where a prim of an instancing prototype shows on the stage, and how often."""

from __future__ import annotations

from typing import Any, NamedTuple


class Shown(NamedTuple):
    """The first stage path that shows a prim, and by how many instances it is shown."""

    path: str
    instances: int


def shown(prim: Any) -> Shown:
    """A prim outside prototypes shows at its own path, once."""
    if not prim.IsInPrototype():
        return Shown(str(prim.GetPath()), 1)
    below = path_in_prototype(prim)
    places = [shown(instance) for instance in _prototype(prim).GetInstances()]
    return Shown(
        min(place.path for place in places) + below, sum(place.instances for place in places)
    )


def shown_paths(prim: Any) -> list[str]:
    """Every stage path that shows a prim, in their order."""
    if not prim.IsInPrototype():
        return [str(prim.GetPath())]
    below = path_in_prototype(prim)
    instances = _prototype(prim).GetInstances()
    return sorted(path + below for instance in instances for path in shown_paths(instance))


def path_in_prototype(prim: Any) -> str:
    """The path below the prototype, which is the same for each instance; else the prim's own."""
    path = str(prim.GetPath())
    return path[len(str(_prototype(prim).GetPath())) :] if prim.IsInPrototype() else path


def shown_path(stage: Any, path: Any) -> str:
    """A path as the stage shows it, also where no prim is."""
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
    """The prim that the walk meets in place of an instance proxy."""
    return prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
