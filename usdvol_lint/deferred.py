"""Imports of modules that are carried out when something of a module is first asked for."""

from __future__ import annotations

import builtins
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any


class _Deferred:
    """Stands for a module that may not be imported yet; what was asked for once is kept."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        found = getattr(import_module(self._name), name)
        setattr(self, name, found)
        return found


class _Package:
    """What `from package import module` takes its modules from."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> _Deferred:
        return _Deferred(f"{self._name}.{name}")


@contextmanager
def deferred(importing: dict[str, Any]) -> Iterator[None]:
    """Inside, `from package import module` imports nothing yet, in a module with these globals.

    Most stages need few modules of facts, and rules must load where there is no pxr.
    An import in the function that needs it is looked up anew at each call, which costs as much as
    thirty calls.
    """
    plain = builtins.__import__

    def defer(name: str, whose: Any = None, *others: Any, **named: Any) -> Any:
        is_here = whose is importing  # and not in another thread
        return _Package(name) if is_here else plain(name, whose, *others, **named)

    builtins.__import__ = defer  # type: ignore[assignment]
    try:
        yield
    finally:
        builtins.__import__ = plain
