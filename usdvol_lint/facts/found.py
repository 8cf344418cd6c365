"""The one mechanism for what is found once: declared in a wing, found when asked for, and kept."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

if TYPE_CHECKING:
    from usdvol_lint.facts.prims.tables import Table, Tables

_T = TypeVar("_T")
_K = TypeVar("_K", bound=Hashable)
_W = TypeVar("_W", bound="Wing")


class Wing:
    """The facts about one subject; `tables` are the prims of the stage.

    A wing is given the objects below it when it is made, and nothing that leads back to it: a
    circle of references would keep the stage and its layers alive after the last question.
    """

    def __init__(self, tables: Tables) -> None:
        self.tables = tables
        self.known: dict[Any, dict[fact[Any, Any], Any]] = defaultdict(dict)
        """What `fact` found, by prim."""


class _Declared(Generic[_W]):
    """What a wing declares, known by the wing's class and a name."""

    def __set_name__(self, owner: type[_W], name: str) -> None:
        self.owner = owner
        self.name = name

    def __str__(self) -> str:
        return f"{self.owner.__name__}.{self.name}"


class column(_Declared[_W], Generic[_W, _T]):  # noqa: N801  (a decorator, as property is)
    """A fact that is found for all prims of a table at once, and kept in the table."""

    def __init__(self, find: Callable[[_W, Table], Sequence[_T]]) -> None:
        self.find = find
        self.__doc__ = find.__doc__

    @overload
    def __get__(self, wing: None, owner: type[_W]) -> column[_W, _T]: ...
    @overload
    def __get__(self, wing: _W, owner: type[_W]) -> Column[_T]: ...
    def __get__(self, wing: _W | None, owner: type[_W]) -> column[_W, _T] | Column[_T]:
        # Made anew each time: kept in the wing it would be a circle.
        return self if wing is None else Column(self, wing)

    def keys(self, wing: _W, table: Table) -> Sequence[_T]:
        """What preconditions look at, of each prim of a table."""
        return table.cells(self, wing)


class Column(Generic[_T]):
    """A column of one wing; inside loops take it out of the wing first."""

    __slots__ = ("_declared", "_wing")

    def __init__(self, declared: column[Any, _T], wing: Wing) -> None:
        self._declared = declared
        self._wing = wing

    def __call__(self, prim: Any) -> _T:
        """The fact of one prim, whether or not that of others can be found."""
        table, row = self._wing.tables.find(prim)
        return table.cell(row, self._declared, self._wing)

    def at(self, table: Table, row: int) -> _T:
        """The same, by the place of the prim."""
        return table.cell(row, self._declared, self._wing)

    def all(self, table: Table) -> Sequence[_T]:
        """The whole column; raises where the fact of one prim can't be found."""
        return table.cells(self._declared, self._wing)

    def readable(self, *schemas: str) -> Iterator[tuple[Any, _T]]:
        """The prims that answer to a schema, with the fact of each.

        Prims that USD can't read are left out, and stand in `Tables.unreadable`.
        """
        tables = self._wing.tables
        for table in tables.of(*schemas):
            yield from table.readable(self._declared, self._wing, tables.unreadable)


class summary(_Declared[_W], Generic[_W, _K]):  # noqa: N801  (a decorator, as property is)
    """Hashable keys that preconditions look at: asked for once a table, and not kept."""

    def __init__(self, find: Callable[[_W, Table], Sequence[_K]]) -> None:
        self.find = find
        self.__doc__ = find.__doc__

    def keys(self, wing: _W, table: Table) -> Sequence[_K]:
        """The key of each prim of a table."""
        return self.find(wing, table)


class fact(_Declared[_W], Generic[_W, _T]):  # noqa: N801  (a decorator, as property is)
    """A fact that is found for one prim at a time, and kept."""

    def __init__(self, find: Callable[[_W, Any], _T]) -> None:
        self.find = find
        self.__doc__ = find.__doc__

    @overload
    def __get__(self, wing: None, owner: type[_W]) -> fact[_W, _T]: ...
    @overload
    def __get__(self, wing: _W, owner: type[_W]) -> Callable[[Any], _T]: ...
    def __get__(self, wing: _W | None, owner: type[_W]) -> fact[_W, _T] | Callable[[Any], _T]:
        return self if wing is None else partial(self._of, wing)

    def _of(self, wing: _W, prim: Any) -> _T:
        known = wing.known[prim]
        if self not in known:
            known[self] = self.find(wing, prim)
        found: _T = known[self]
        return found
