"""The prims of a stage in tables: one row for each prim, one column for each fact about it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.facts.prims.attributes import Authored, AuthoredReader, Shape
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import get_path
from usdvol_lint.facts.usd.kinds import KindKey, PrimKinds

if TYPE_CHECKING:
    from usdvol_lint.facts.found import Wing, column

_T = TypeVar("_T")
_W = TypeVar("_W", bound="Wing")

_CHUNK_SIZE = 1024
"""Few enough that what USD returned for a chunk stays in the processor's cache between queries."""


class ColumnFailedError(Exception):
    """Raised for a column that failed before: that of some prim can't be found, so ask by row."""


class Table:
    """Prims of one kind and shape, one in each row, and the columns computed for them.

    `batch` makes queries to USD about all of them.
    """

    __slots__ = ("_alone", "_authored", "_columns", "_failed", "batch")

    def __init__(self, batch: PrimBatch, authored: Authored | AuthoredReader) -> None:
        """A single prim whose authored properties can't be read has their reader as `authored`."""
        self.batch = batch
        self._columns: dict[column[Any, Any], Sequence[Any]] = {}
        self._authored = authored
        self._alone: dict[int, Table] = {}
        self._failed: set[column[Any, Any]] = set()

    @property
    def prims(self) -> Sequence[Any]:
        return self.batch.prims

    @property
    def authored(self) -> Authored:
        """What is authored on the prims; raises what USD raises if it can't be read."""
        if isinstance(self._authored, AuthoredReader):
            # Read again, so that USD raises again: to keep the error would keep the stage alive,
            # since its traceback refers to the frames of all callers.
            return self._authored.read_alone(self.prims[0])
        return self._authored

    def cells(self, declared: column[_W, _T], wing: _W) -> Sequence[_T]:
        """A column, with a value for each row; raises if that of one of the rows can't be found."""
        if declared not in self._columns:
            if declared in self._failed:
                raise ColumnFailedError
            try:
                self._columns[declared] = declared.find(wing, self)
            except Exception:
                if len(self.prims) > 1:
                    self._failed.add(declared)
                raise
        return self._columns[declared]

    def cell(self, row: int, declared: column[_W, _T], wing: _W) -> _T:
        """The value of one row; raises only what the prim of this row is to blame for."""
        values: Sequence[_T] | None = self._columns.get(declared)
        if values is None and len(self.prims) > 1:
            # One prim must not keep others back, whatever is raised for it: it is raised again
            # for the row of that prim, which is asked alone.
            with suppress(Exception):
                values = self.cells(declared, wing)
            if values is None:
                return self.alone(row).cells(declared, wing)[0]
        return self.cells(declared, wing)[0] if values is None else values[row]

    def readable(
        self, declared: column[_W, _T], wing: _W, unreadable: list[tuple[Any, Exception]]
    ) -> Iterator[tuple[Any, _T]]:
        """The prims and their values; one whose value can't be found is added to `unreadable`."""
        values: Sequence[_T] | None = None
        try:
            values = self.cells(declared, wing)
        except Exception as error:  # raised again for the row that is to blame, as in `cell`
            if len(self.prims) == 1:
                unreadable.append((self.prims[0], error))
                return
        if values is not None:
            yield from zip(self.prims, values, strict=True)
            return
        # Not inside `except`: errors of single rows would refer to this one, and so to the stage.
        for row in range(len(self.prims)):
            yield from self.alone(row).readable(declared, wing, unreadable)

    def alone(self, row: int) -> Table:
        """A table that has only the prim of this row."""
        if row not in self._alone:
            self._alone[row] = Table(self.batch.of((row,)), self._authored)
        return self._alone[row]


class Chunk:
    """Consecutive prims of one kind in the order of the walk; `tables` is empty until asked for."""

    __slots__ = ("_rows", "prims", "tables")

    def __init__(self, prims: Sequence[Any]) -> None:
        self.prims = prims
        self.tables: list[Table] = []
        self._rows: dict[Any, tuple[Table, int]] = {}

    @property
    def slots(self) -> Iterator[Slot]:
        """The slot of each prim."""
        return ((self, index) for index in range(len(self.prims)))

    def find(self, index: int) -> tuple[Table, int]:
        """The table of a prim of the chunk, and its row there, once there are `tables`."""
        if len(self.tables) == 1:
            return self.tables[0], index
        if not self._rows:
            for table in self.tables:
                self._rows.update((prim, (table, row)) for row, prim in enumerate(table.prims))
        return self._rows[self.prims[index]]


Slot: TypeAlias = tuple["Chunk", int]
"""A prim of the stage: its chunk, and its index there."""


class Tables:
    """The prims that rules ask for, by kind, in chunks whose tables are made when asked for.

    `telling` are the codes of the rules in whose favour others are silent; None if all are.
    """

    def __init__(
        self,
        kept: Mapping[KindKey, Sequence[Any]],
        kinds: PrimKinds,
        authored: AuthoredReader,
        telling: frozenset[str] | None = None,
    ) -> None:
        self._telling = telling
        self._kinds = kinds
        self._authored = authored
        self._chunks = {key: list(_chunks(prims)) for key, prims in kept.items()}
        self._newest: list[Table] = []
        self._rows_of_newest = 0
        self._last_prim: Any = None
        self._last_found: tuple[Table, int] | None = None
        self.unreadable: list[tuple[Any, Exception]] = []
        """Prims that facts about the whole stage leave out, each with what was raised for it."""

    def ours(self) -> Iterator[Any]:
        """The live Volumes, fields and particle fields."""
        return chain.from_iterable(map(self.prims, schema.OURS))

    def tells(self, *codes: str) -> bool:
        """Whether one of these rules is in force, and no milder than it is on its own."""
        return self._telling is None or not self._telling.isdisjoint(codes)

    def chunks(self, key: KindKey) -> list[Chunk]:
        """The chunks of a kind, in the order of the walk."""
        return self._chunks[key]

    def prims(self, schema_name: str) -> list[Any]:
        """All prims that answer to a schema, by kind, in the order of the walk."""
        keys = (key for key in self._chunks if schema_name in self._kinds.names(key))
        chunks = chain.from_iterable(self._chunks[key] for key in keys)
        return [prim for chunk in chunks for prim in chunk.prims]

    def of(self, *schemas: str) -> Iterator[Table]:
        """The tables of all prims that answer to one of these schemas."""
        for key, chunks in self._chunks.items():
            if not self._kinds.names(key).isdisjoint(schemas):
                for chunk in chunks:
                    yield from self.tables(chunk)

    def authored(self, *schemas: str) -> Iterator[tuple[Sequence[Any], Authored]]:
        """The prims of each of these tables, with what is authored on them.

        A prim for which that can't be read is added to `unreadable`.
        """
        for table in self.of(*schemas):
            try:
                authored = table.authored
            except Exception as error:  # whatever it is: the engine reports it
                self.unreadable.append((table.prims[0], error))
            else:
                yield table.prims, authored

    def tables(self, chunk: Chunk) -> list[Table]:
        """The tables of a chunk, made now if they were not."""
        if not chunk.tables:
            chunk.tables = self._form(chunk.prims)
        return chunk.tables

    def find(self, prim: Any) -> tuple[Table, int]:
        """The table of a prim, and its row there; a new table if the walk did not keep the prim."""
        if prim is not self._last_prim or self._last_found is None:
            # Several rules ask about one prim in turn, and hashing a prim takes a microsecond.
            self._last_prim, self._last_found = prim, self._look_up(prim)
        return self._last_found

    def _look_up(self, prim: Any) -> tuple[Table, int]:
        slot = self._slots.get(prim)
        if slot is None:
            slot = self._slots[prim] = Chunk((prim,)), 0
        return self.find_at(slot)

    def find_at(self, slot: Slot) -> tuple[Table, int]:
        """The table of the prim at a slot, and its row there."""
        chunk, index = slot
        self.tables(chunk)
        return chunk.find(index)

    @cached_property
    def field_slots(self) -> Mapping[Any, Slot]:
        """The slots of all live fields, by path."""
        kinds = [key for key in self._chunks if schema.FIELD in self._kinds.names(key)]
        return {
            path: slot
            for chunk in chain.from_iterable(self._chunks[key] for key in kinds)
            for path, slot in zip(map(get_path, chunk.prims), chunk.slots, strict=True)
        }

    @cached_property
    def _slots(self) -> dict[Any, Slot]:
        """The slots of all prims, by prim; built only once a rule asks about a single prim."""
        return {
            prim: slot
            for chunk in chain.from_iterable(self._chunks.values())
            for prim, slot in zip(chunk.prims, chunk.slots, strict=True)
        }

    def _form(self, prims: Sequence[Any]) -> list[Table]:
        """The tables of some prims; one that can't be read gets a table of its own."""
        if self._rows_of_newest + len(prims) > _CHUNK_SIZE:
            self._forget()
        formed = self._attempt(prims)
        if not formed and len(prims) > 1:
            return [table for prim in prims for table in self._form((prim,))]
        # For a manifest of value clips that it can't open USD raises once, then does without it;
        # the manifest is reported by a rule.
        formed = formed or self._attempt(prims)
        if not formed:
            return [Table(PrimBatch(prims), self._authored)]
        self._newest += formed
        self._rows_of_newest += len(prims)
        return formed

    def _forget(self) -> None:
        """Lets go of the results of queries, which else would all stay in memory."""
        for table in self._newest:
            table.batch.forget()
        self._newest.clear()
        self._rows_of_newest = 0

    def _attempt(self, prims: Sequence[Any]) -> list[Table]:
        """The tables of some prims, or none if one of the prims can't be read."""
        try:
            return list(self._by_shape(PrimBatch(prims)))
        except Exception:  # whatever it is: `Table.authored` raises it again, for the one prim
            return []

    def _by_shape(self, batch: PrimBatch) -> Iterator[Table]:
        """A table for each shape that prims of a batch have."""
        key = self._kinds.key(batch.prims[0])
        shapes = self._authored.shapes(batch, key)
        if shapes.count(shapes[0]) == len(shapes):
            yield Table(batch, self._authored.read(batch.prims[0], key, shapes[0]))
            return
        rows: dict[Shape, list[int]] = defaultdict(list)
        for row, shape in enumerate(shapes):
            rows[shape].append(row)
        for shape, alike in rows.items():
            yield Table(batch.of(alike), self._authored.read(batch.prims[alike[0]], key, shape))


def _chunks(prims: Sequence[Any]) -> Iterator[Chunk]:
    for start in range(0, len(prims), _CHUNK_SIZE):
        yield Chunk(prims[start : start + _CHUNK_SIZE])
