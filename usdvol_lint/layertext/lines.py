"""Finds the line and column of a USD spec in the text of a `.usda` layer, without USD."""

from __future__ import annotations

import re
from array import array
from collections import defaultdict
from dataclasses import dataclass, field

from usdvol_lint.cached import cached_property
from usdvol_lint.layertext.excerpts import excerpt
from usdvol_lint.layertext.outline import Outline
from usdvol_lint.layertext.statements import (
    KEY,
    Property,
    Statement,
    asset_offsets,
    end_of,
    statements,
)
from usdvol_lint.model import Excerpt

_ELEMENT = re.compile(r"\{[^{}]*\}|[^/{}]+")
_NAME = re.compile(r"[^/{}]+")
_BLOCK_SIZE = 1 << 9


@dataclass(slots=True, order=True, unsafe_hash=True)  # frozen, each takes longer to make
class Position:
    """A position in a text, 1-based, and what stands there; the column counts characters."""

    line: int
    column: int
    excerpt: Excerpt | None = field(default=None, compare=False)


class TextLayer:
    """The text of a `.usda` layer, UTF-8; finds specs by their paths."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._scopes: dict[int, _Scope] = {}
        self._enclosing: dict[str, _Scope | None] = {}
        self._found: dict[tuple[str, float | None, str | None], Position | None] = {}
        self._lines_before_block = array("q", [0])

    def find(
        self, path: str, *, time: float | None = None, asset: str | None = None
    ) -> Position | None:
        """The position of the spec at `path`, or None if it is not in this text.

        That of a prim is its specifier, of a variant its name, of a property its first statement,
        of a target its property, and of `/` the top.  `time` asks for the key of the time sample,
        or for `timeSamples` where the text has no such key; `asset` asks for the first `@asset@`
        in the spec, or in that sample, or for `</prim>` or `@asset@</prim>` if it has a prim path
        in such brackets.  What is not found is replaced by what encloses it.
        """
        spec = self._spec(path)
        if spec is None:
            return None
        offset = spec.start
        mark = spec.value if isinstance(spec, Property) else None
        sample = None
        if time is not None and isinstance(spec, Property) and (samples := spec.samples):
            sample = spec.sample(time)
            offset = (sample or samples).start
            mark = end_of(KEY, self._data, sample.start) if sample else None
        if asset is not None:
            assets = asset_offsets(self._data, [sample]) if sample else spec.assets
            if asset in assets:
                offset = mark = assets[asset]
        return self._position(offset, mark)

    def find_once(self, path: str, time: float | None, asset: str | None) -> Position | None:
        """The same, kept for the other prims, and stages, that show what is there."""
        key = (path, time, asset)
        if key not in self._found:
            self._found[key] = self.find(path, time=time, asset=asset)
        return self._found[key]

    def heading(self, path: str) -> bytes:
        """What stands before the body of the prim or variant at `path`; empty if it is not here."""
        spec = self._spec(path)
        return self._data[spec.start : spec.body - 1] if isinstance(spec, _Scope) else b""

    def _spec(self, path: str) -> _Scope | Property | None:
        path = path.partition("[")[0]
        enclosing, _, name = path.rpartition(".")
        if not enclosing or "}" in name:  # the point is one in the name of a variant
            enclosing, name = path, ""
        if enclosing not in self._enclosing:
            self._enclosing[enclosing] = self._scope_at(enclosing)
        scope = self._enclosing[enclosing]
        return scope.property(name) if scope and name else scope

    def _scope_at(self, path: str) -> _Scope | None:
        """The scope at the path of a prim or variant, or of the layer."""
        above, _, name = path.rpartition("/")
        if not above or not _NAME.fullmatch(name):
            return self._top_down(path)
        if above not in self._enclosing:
            self._enclosing[above] = self._top_down(above)
        scope = self._enclosing[above]
        return self._child(scope, name) if scope else None

    def _top_down(self, path: str) -> _Scope | None:
        scope = self._scope(0) if path.startswith("/") else None
        for element in _ELEMENT.findall(path):
            scope = scope and self._child(scope, element)
        return scope

    def _child(self, scope: _Scope, element: str) -> _Scope | None:
        number = scope.children.get(element)
        return None if number is None else self._scope(number)

    def _scope(self, number: int) -> _Scope:
        if number not in self._scopes:
            self._scopes[number] = _Scope(self._outline, number)
        return self._scopes[number]

    @cached_property
    def _outline(self) -> Outline:
        return Outline(self._data)

    def _position(self, offset: int, mark: int | None) -> Position:
        """The position of an offset; `mark` is where its value begins, if that is in its line."""
        data = self._data
        start = data.rfind(b"\n", 0, offset) + 1
        if mark is None or data.find(b"\n", offset, mark) >= 0:
            mark = offset
        before = data[start:offset]
        if before.isascii():
            column = offset - start + 1
        else:
            column = len(before.decode("utf-8", "replace").removeprefix("\ufeff")) + 1
        return Position(self._line(offset), column, excerpt(data, start, mark))

    def _line(self, offset: int) -> int:
        before = self._lines_before_block
        block = offset // _BLOCK_SIZE
        while len(before) <= block:
            start = (len(before) - 1) * _BLOCK_SIZE
            before.append(before[-1] + self._data.count(b"\n", start, start + _BLOCK_SIZE))
        return before[block] + self._data.count(b"\n", block * _BLOCK_SIZE, offset) + 1


class _Scope:
    """A prim, variant set or variant, or the layer."""

    def __init__(self, outline: Outline, number: int) -> None:
        self._outline = outline
        self._number = number
        self.start = outline.start[number]
        self.body = outline.body[number]
        self._properties: dict[str, Property | None] = {}

    @cached_property
    def assets(self) -> dict[str, int]:
        return asset_offsets(self._outline.data, self._outline.own(self._number, self.start))

    @cached_property
    def children(self) -> dict[str, int]:
        """The numbers of the scopes inside, by element of a path: `prim`, `{set=variant}`."""
        outline = self._outline
        found: dict[str, int] = {}
        for inner in outline.inside(self._number):
            name = outline.name(inner)
            if not outline.is_variant_set(inner):
                found.setdefault(name, inner)
                continue
            found.setdefault(f"{{{name}=}}", inner)
            for variant in outline.inside(inner):
                found.setdefault(f"{{{name}={outline.name(variant)}}}", variant)
        return found

    def property(self, name: str) -> Property | None:
        """The statements about a property; None if there are none."""
        if name not in self._properties:
            about = self._statements.get(name)
            self._properties[name] = Property(self._outline.data, about) if about else None
        return self._properties[name]

    @cached_property
    def _statements(self) -> dict[str, list[Statement]]:
        data = self._outline.data
        found: dict[str, list[Statement]] = defaultdict(list)
        for span in self._outline.own(self._number, self.body):
            for statement in statements(data, span):
                found[statement.name].append(statement)
        return found
