"""Prims that are alike, in tables with a column for each fact that is found of many in one go."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from usdvol_lint import schema
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import get_path
from usdvol_lint.facts.usd.kinds import KindKey, PrimKinds

if TYPE_CHECKING:
    from usdvol_lint.facts.found import Wing, column
    from usdvol_lint.facts.prims.attributes import Authored, AuthoredReader, Shape

_T = TypeVar("_T")
_W = TypeVar("_W", bound="Wing")

_MOST_PRIMS = 1024
"""So many are asked one question after the other: then what is found of them is cached."""


class NotTogetherError(Exception):
    """Of one of some prims it is known that something can't be read: ask for each by itself."""


class Unread:
    """Stands for what is authored on a prim where USD raised: who asks for it has USD raise again.

    The error is not kept: its traceback has the frames of all callers, and so the stage.
    """

    __slots__ = ("read_alone",)

    def __init__(self, read_alone: Callable[[Any], Authored]) -> None:
        self.read_alone = read_alone


class Table:
    """Prims of one kind on which the same properties are authored.

    `batch` gives USD's answers about them; what is found of them is kept by what declares it.
    """

    __slots__ = ("_alone", "_authored", "_columns", "_failed", "batch")

    def __init__(self, batch: PrimBatch, authored: Authored | Unread) -> None:
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
        """What is authored on them; raises what USD raises where it can't be read."""
        if isinstance(self._authored, Unread):
            return self._authored.read_alone(self.prims[0])
        return self._authored

    def cells(self, declared: column[_W, _T], wing: _W) -> Sequence[_T]:
        """A fact of each prim; raises where that of one can't be found."""
        if declared not in self._columns:
            if declared in self._failed:
                raise NotTogetherError
            try:
                self._columns[declared] = declared.find(wing, self)
            except Exception:
                if len(self.prims) > 1:
                    self._failed.add(declared)
                raise
        return self._columns[declared]

    def cell(self, row: int, declared: column[_W, _T], wing: _W) -> _T:
        """A fact of one prim, whether or not that of others can be found."""
        found: Sequence[_T] | None = self._columns.get(declared)
        if found is None and len(self.prims) > 1:
            # Whatever is raised for all of them is raised again by the prim that it is about.
            with suppress(Exception):
                found = self.cells(declared, wing)
            if found is None:
                return self.alone(row).cells(declared, wing)[0]
        return self.cells(declared, wing)[0] if found is None else found[row]

    def readable(
        self, declared: column[_W, _T], wing: _W, unreadable: list[tuple[Any, Exception]]
    ) -> Iterator[tuple[Any, _T]]:
        """The prims with a fact of each; those of which it can't be found become `unreadable`."""
        found: Sequence[_T] | None = None
        try:
            found = self.cells(declared, wing)
        except Exception as error:  # as in `cell`
            if len(self.prims) == 1:
                unreadable.append((self.prims[0], error))
                return
        if found is not None:
            yield from zip(self.prims, found, strict=True)
            return
        # Not where the error was caught: what is raised there refers to it, and it to the stage.
        for row in range(len(self.prims)):
            yield from self.alone(row).readable(declared, wing, unreadable)

    def alone(self, row: int) -> Table:
        """A table of one of the prims."""
        if row not in self._alone:
            self._alone[row] = Table(self.batch.of((row,)), self._authored)
        return self._alone[row]


class Chunk:
    """Some prims of one kind that the walk met in a row, in tables once these are asked for."""

    __slots__ = ("_rows", "prims", "tables")

    def __init__(self, prims: Sequence[Any]) -> None:
        self.prims = prims
        self.tables: list[Table] = []
        self._rows: dict[Any, tuple[Table, int]] = {}

    @property
    def slots(self) -> Iterator[Slot]:
        return ((self, row) for row in range(len(self.prims)))

    def find(self, row: int) -> tuple[Table, int]:
        """The table of one of the prims, and its row there."""
        if len(self.tables) == 1:
            return self.tables[0], row
        if not self._rows:
            for table in self.tables:
                self._rows.update((prim, (table, row)) for row, prim in enumerate(table.prims))
        return self._rows[self.prims[row]]


Slot: TypeAlias = tuple["Chunk", int]
"""A chunk, and which of its prims is meant."""


class Tables:
    """The prims of a stage in tables, and what was found of them."""

    def __init__(
        self, kept: Mapping[KindKey, Sequence[Any]], kinds: PrimKinds, authored: AuthoredReader
    ) -> None:
        self._kinds = kinds
        self._authored = authored
        self._chunks = {key: list(_chunks(prims)) for key, prims in kept.items()}
        self._last: list[Table] = []
        self._asked: Any = None
        self._found: tuple[Table, int] | None = None
        self.unreadable: list[tuple[Any, Exception]] = []
        """Prims that facts about the whole stage do without, because USD raised for them."""

    def chunks(self, key: KindKey) -> list[Chunk]:
        """The prims of a kind, in the order of the walk."""
        return self._chunks[key]

    def prims(self, schema_name: str) -> list[Any]:
        """The prims that answer to a schema."""
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

        Where that can't be read, the prim becomes `unreadable`.
        """
        for table in self.of(*schemas):
            try:
                authored = table.authored
            except Exception as error:  # whatever it is, it is reported, and keeps no table back
                self.unreadable.append((table.prims[0], error))
            else:
                yield table.prims, authored

    def tables(self, chunk: Chunk) -> list[Table]:
        """The prims of a chunk in tables."""
        if not chunk.tables:
            chunk.tables = self._form(chunk.prims)
        return chunk.tables

    def find(self, prim: Any) -> tuple[Table, int]:
        """The table of a prim, and its row there; one of its own if the walk did not keep it."""
        if prim is not self._asked or self._found is None:
            # Several rules ask about one prim in turn, and to hash a prim takes a microsecond.
            self._asked, self._found = prim, self._look_up(prim)
        return self._found

    def _look_up(self, prim: Any) -> tuple[Table, int]:
        slot = self._places.get(prim)
        if slot is None:
            slot = self._places[prim] = Chunk((prim,)), 0
        return self.find_at(slot)

    def find_at(self, slot: Slot) -> tuple[Table, int]:
        """The table of the prim at a slot, and its row there."""
        chunk, row = slot
        self.tables(chunk)
        return chunk.find(row)

    @cached_property
    def fields(self) -> Mapping[Any, Slot]:
        """The slots of all live fields, by their paths."""
        kinds = [key for key in self._chunks if schema.FIELD in self._kinds.names(key)]
        return {
            path: slot
            for chunk in chain.from_iterable(self._chunks[key] for key in kinds)
            for path, slot in zip(map(get_path, chunk.prims), chunk.slots, strict=True)
        }

    @cached_property
    def _places(self) -> dict[Any, Slot]:
        """The slots of all prims; to find one is rare where nothing is wrong."""
        return {
            prim: slot
            for chunk in chain.from_iterable(self._chunks.values())
            for prim, slot in zip(chunk.prims, chunk.slots, strict=True)
        }

    def _form(self, prims: Sequence[Any]) -> list[Table]:
        """Puts those together that are alike; one that can't be read does not keep others back."""
        for table in self._last:
            table.batch.forget()
        formed = self._attempt(prims)
        if not formed and len(prims) > 1:
            return [table for prim in prims for table in self._form((prim,))]
        # USD raises once for a manifest of value clips that it can't open; from then on it goes
        # without, and the manifest is a finding by itself.
        formed = formed or self._attempt(prims)
        if not formed:
            return [Table(PrimBatch(prims), Unread(self._authored.read_alone))]
        self._last = formed
        return formed

    def _attempt(self, prims: Sequence[Any]) -> list[Table]:
        """The tables, or none where one of the prims can't be read."""
        try:
            return list(self._alike(PrimBatch(prims)))
        except Exception:  # whatever it is: whoever asks the table of that prim has it raised again
            return []

    def _alike(self, batch: PrimBatch) -> Iterator[Table]:
        key = self._kinds.key(batch.prims[0])
        shapes = self._authored.shapes(batch, key)
        if shapes.count(shapes[0]) == len(shapes):
            yield Table(batch, self._authored.read(batch.prims[0], key, shapes[0]))
            return
        rows: dict[Shape, list[int]] = defaultdict(list)
        for row, shape in enumerate(shapes):
            rows[shape].append(row)
        for shape, some in rows.items():
            yield Table(batch.of(some), self._authored.read(batch.prims[some[0]], key, shape))


def _chunks(prims: Sequence[Any]) -> Iterator[Chunk]:
    for start in range(0, len(prims), _MOST_PRIMS):
        yield Chunk(prims[start : start + _MOST_PRIMS])
