"""The nodes of a prim index: the places in layer stacks that a prim is composed of."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any


def nodes_of(index: Any) -> Iterator[Any]:
    """The nodes of a prim index, strongest first.

    The index lives as long as they are asked for: a node does not keep it alive.
    """
    waiting = [index.rootNode] if index.IsValid() else []  # the root of a prototype has none
    while waiting:
        node = waiting.pop()
        yield node
        waiting += node.children[::-1]
