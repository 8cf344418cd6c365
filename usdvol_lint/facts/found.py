"""How facts are declared in wings: computed when first asked for, and cached."""

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
    """The facts about one subject; `tables` hold the prims of the stage.

    A wing is given the objects that it builds on, and nothing that refers back to it: a reference
    cycle would keep the stage and its layers alive after the last question.
    """

    def __init__(self, tables: Tables) -> None:
        self.tables = tables
        self.cache: dict[Any, dict[fact[Any, Any], Any]] = defaultdict(dict)
        """By prim, the values of what is declared as a `fact`."""


class _Declared(Generic[_W]):
    """A declaration in the body of a wing; it knows the wing's class and its own name there."""

    def __set_name__(self, owner: type[_W], name: str) -> None:
        self.owner = owner
        self.name = name

    def __str__(self) -> str:
        return f"{self.owner.__name__}.{self.name}"


class column(_Declared[_W], Generic[_W, _T]):  # noqa: N801  (a decorator, as property is)
    """A fact that is computed for all prims of a table at once, and cached in the table.

    The decorated method takes a table and returns one value for each of its prims, in order.
    On a wing, the name is a `Column`.
    """

    def __init__(self, find: Callable[[_W, Table], Sequence[_T]]) -> None:
        self.find = find
        self.__doc__ = find.__doc__

    @overload
    def __get__(self, wing: None, owner: type[_W]) -> column[_W, _T]: ...
    @overload
    def __get__(self, wing: _W, owner: type[_W]) -> Column[_T]: ...
    def __get__(self, wing: _W | None, owner: type[_W]) -> column[_W, _T] | Column[_T]:
        # Made anew each time: cached in the wing, it would be a reference cycle.
        return self if wing is None else Column(self, wing)

    def keys(self, wing: _W, table: Table) -> Sequence[_T]:
        """What preconditions look at: the value for each prim of a table."""
        return table.cells(self, wing)


class Column(Generic[_T]):
    """A column of one wing.

    It is made at each access to the wing's attribute: loops should bind it to a local name first.
    """

    __slots__ = ("_declared", "_wing")

    def __init__(self, declared: column[Any, _T], wing: Wing) -> None:
        self._declared = declared
        self._wing = wing

    def __call__(self, prim: Any) -> _T:
        """The value for one prim; raises only what this prim is to blame for."""
        table, row = self._wing.tables.find(prim)
        return table.cell(row, self._declared, self._wing)

    def at(self, table: Table, row: int) -> _T:
        """The value for the prim in a row of a table, as for a prim."""
        return table.cell(row, self._declared, self._wing)

    def all(self, table: Table) -> Sequence[_T]:
        """The values for all prims of a table; raises if that for one of them can't be found."""
        return table.cells(self._declared, self._wing)

    def readable(self, *schemas: str) -> Iterator[tuple[Any, _T]]:
        """The prims that answer to one of these schemas, each with its value.

        Prims whose value can't be found are left out, and added to `Tables.unreadable`.
        """
        tables = self._wing.tables
        for table in tables.of(*schemas):
            yield from table.readable(self._declared, self._wing, tables.unreadable)


class summary(_Declared[_W], Generic[_W, _K]):  # noqa: N801  (a decorator, as property is)
    """Hashable keys, one for each prim of a table, that preconditions look at.

    They are asked for once for each table, so they are not cached.
    """

    def __init__(self, find: Callable[[_W, Table], Sequence[_K]]) -> None:
        self.find = find
        self.__doc__ = find.__doc__

    def keys(self, wing: _W, table: Table) -> Sequence[_K]:
        """The key of each prim of a table."""
        return self.find(wing, table)


class fact(_Declared[_W], Generic[_W, _T]):  # noqa: N801  (a decorator, as property is)
    """A fact that is computed for one prim at a time, and cached in the wing."""

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
        values = wing.cache[prim]
        if self not in values:
            values[self] = self.find(wing, prim)
        value: _T = values[self]
        return value
