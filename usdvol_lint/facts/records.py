"""What was found of each prim, by name: of one prim at a time, or of many in one go."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

Record: TypeAlias = dict[str, Any]
Read: TypeAlias = Callable[[str, Sequence[Any]], Sequence[Any]]
"""Finds what is kept under a name, for each of many prims of one kind."""


class Records:
    """A record for each prim; rules ask in a row, and to look a prim up is dear."""

    def __init__(self) -> None:
        self._records: dict[Any, Record] = {}
        self._prim: Any = None
        self._record: Record = {}
        self._prims: Sequence[Any] = ()
        self._of_prims: list[Record] = []
        self._columns: dict[str, list[Any]] = {}

    def of(self, prim: Any) -> Record:
        """What was found of one prim."""
        if prim is not self._prim:
            record = self._records.get(prim)
            if record is None:
                record = self._records[prim] = {}
            self._prim, self._record = prim, record
        return self._record

    def one(self, prim: Any, name: str, read: Read) -> Any:
        """What is kept under a name of one prim."""
        record = self.of(prim)
        if name not in record:
            (record[name],) = read(name, (prim,))
        return record[name]

    def each(self, prims: Sequence[Any], name: str, read: Read) -> list[Any]:
        """What is kept under a name, of each of many prims.

        To find it in one go takes half the time that one by one would take.
        """
        if prims is not self._prims:
            self._prims, self._of_prims, self._columns = prims, list(map(self.of, prims)), {}
        records, columns = self._of_prims, self._columns
        if name not in columns:
            if not all(name in record for record in records):
                for record, found in zip(records, read(name, prims), strict=True):
                    record.setdefault(name, found)
            columns[name] = [record[name] for record in records]
        return columns[name]
