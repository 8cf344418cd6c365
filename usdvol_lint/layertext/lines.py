"""Finds the line and column of a USD spec in the text of a `.usda` layer, without USD."""

from __future__ import annotations

import math
import re
from array import array
from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from operator import le
from typing import NamedTuple

from usdvol_lint.layertext.excerpts import excerpt
from usdvol_lint.model import Excerpt

# The lexical elements in which brackets and separators have no meaning.  None of them can fail to
# match once it has begun (the closing mark is optional) and none backtracks, so that the time is
# linear for any text.
_BLOCK_COMMENT = rb"/\*[^*]*+(?:\*(?!/)[^*]*+)*+(?:\*/)?+"
_COMMENTS = (rb"#[^\n]*+", rb"//[^\n]*+", _BLOCK_COMMENT)
STRINGS = (
    rb'"""[^"\\]*+(?:(?:\\[\s\S]|"(?!""))[^"\\]*+)*+(?:""")?+',
    rb"'''[^'\\]*+(?:(?:\\[\s\S]|'(?!''))[^'\\]*+)*+(?:''')?+",
    rb'"[^"\\\r\n]*+(?:\\[^\r\n][^"\\\r\n]*+)*+"?+',
    rb"'[^'\\\r\n]*+(?:\\[^\r\n][^'\\\r\n]*+)*+'?+",
)
_ASSETS = (
    rb"@@@[^@\\\r\n]*+(?:(?:\\@@@|\\|@(?!@@))[^@\\\r\n]*+)*+(?:@{3,5})?+",
    rb"@[^@\r\n]*+@?+",
)
_PATHS = (rb"<[^<>\r\n]*+>?+",)
OPAQUE = (*STRINGS, *_ASSETS, *_COMMENTS, *_PATHS)


def _either(*patterns: bytes) -> bytes:
    return b"(?:" + b"|".join(patterns) + b")"


_STRING = _either(*STRINGS)
SPACE = _either(rb"[ \t]++", _BLOCK_COMMENT)
_PADDING = _either(rb"[\s;]++", *_COMMENTS) + b"*+"
_NAMED = SPACE + rb"++(?:[^\s\"'(){}=;,/]++" + SPACE + b"++)?+" + _STRING
_BRACE_VALUE = b"=" + SPACE + rb"*+\{"


def _tokens(*marked: bytes, plain: Iterable[bytes] = ()) -> re.Pattern[bytes]:
    """A pattern to search with; `lastindex` of a match is which of `marked` it is, from 1.

    The alternatives have to begin with a literal, so that `re` skips the bytes between two tokens
    by table look-up: hence their (empty) groups at the end.
    """
    return re.compile(b"|".join([*(pattern + b"()" for pattern in marked), *plain]))


_OPEN, _CLOSE, _OPEN_VALUE, _OPEN_VARIANT_SET, _PRIM, _, _, _TEXT = range(1, 9)
_STRUCTURE = _tokens(
    rb"\{",
    rb"\}",
    _BRACE_VALUE,
    b"variantSet" + SPACE + b"++" + _STRING + SPACE + b"*+" + _BRACE_VALUE,
    b"def" + _NAMED,
    b"over" + _NAMED,
    b"class" + _NAMED,
    *STRINGS,
    plain=(*_ASSETS, *_COMMENTS, *_PATHS),
)
_HEADER = re.compile(
    rb"(?:(?:def|over|class|variantSet)" + _NAMED.replace(_STRING, b"") + b")?+(" + _STRING + b")"
)
_BRACKETS = {
    opener: _tokens(rb"\%c" % opener, rb"\%c" % closer, plain=OPAQUE)
    for opener, closer in (b"()", b"[]", b"{}")
}
_STATEMENT = re.compile(_PADDING + rb"((?:[^=(;\r\n{}#/\"'@<]++|" + _BLOCK_COMMENT + rb")*+)")
_BREAK = _tokens(
    *(rb"\(", rb"\[", rb"\{"),
    *OPAQUE,
    plain=(rb"\)", rb"\]", rb"\}", b";", b"\n", b"\r"),
)
_COMMENT = re.compile(_BLOCK_COMMENT)
_ASSET = _tokens(*_ASSETS, *_PATHS, plain=(*STRINGS, *_COMMENTS))
_SAMPLES = re.compile(_BRACE_VALUE + _PADDING)
_ARRAY = rb"\[" + _either(rb"[^\]\"'@#/<]++", *OPAQUE) + b"*+"
_SAMPLE = re.compile(
    rb"([-.0-9i](?<![\w.].)(?:[0-9.]++|i?+nf)?+(?:[eE][-+]?+[0-9]++)?+)"
    + SPACE
    + b"*+:"
    + _either(rb"[^,\"'@#/<\[]++", _ARRAY, *OPAQUE)
    + b"*+,?+"
    + _PADDING
)
_ELEMENT = re.compile(r"\{[^{}]*\}|[^/{}]+")
_EQUALS = re.compile(rb"[ \t]*=[ \t]*(?=[^\s])")
_KEY = re.compile(rb"[^:\r\n]*:[ \t]*(?=[^\s])")
_BLOCK_SIZE = 1 << 12


@dataclass(frozen=True, slots=True, order=True)
class Position:
    """A position in a text, 1-based, and what stands there; the column counts characters."""

    line: int
    column: int
    excerpt: Excerpt | None = field(default=None, compare=False)


class _Span(NamedTuple):
    start: int
    stop: int


class _Statement(NamedTuple):
    """One statement about a property; `value` is the offset at which the declaration ends."""

    span: _Span
    value: int
    name: str
    suffix: str


class TextLayer:
    """The text of a `.usda` layer, UTF-8; finds specs by their paths."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._scopes: dict[int, _Scope] = {}
        self._enclosing: dict[str, _Scope | None] = {}
        self._lines_before_block = [0]

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
        mark = spec.value if isinstance(spec, _Property) else None
        sample = None
        if time is not None and isinstance(spec, _Property) and spec.samples:
            sample = spec.sample(time)
            offset = (sample or spec.samples.span).start
            mark = _end_of(_KEY, self._data, sample.start) if sample else None
        if asset is not None:
            assets = _assets(self._data, [sample]) if sample else spec.assets
            if asset in assets:
                offset = mark = assets[asset]
        return self._position(offset, mark)

    def heading(self, path: str) -> bytes:
        """What stands before the body of the prim or variant at `path`; empty if it is not here."""
        spec = self._spec(path)
        return self._data[spec.start : spec.body - 1] if isinstance(spec, _Scope) else b""

    def _spec(self, path: str) -> _Scope | _Property | None:
        path = path.partition("[")[0]
        enclosing, _, name = path.rpartition(".")
        if not enclosing or "}" in name:  # the point is one in the name of a variant
            enclosing, name = path, ""
        if enclosing not in self._enclosing:
            self._enclosing[enclosing] = self._scope_at(enclosing)
        scope = self._enclosing[enclosing]
        return scope.properties.get(name) if scope and name else scope

    def _scope_at(self, path: str) -> _Scope | None:
        """The scope at the path of a prim or variant, or of the layer."""
        if not path.startswith("/"):
            return None
        scope = self._scope(0)
        for element in _ELEMENT.findall(path):
            child = scope.children.get(element)
            if child is None:
                return None
            scope = self._scope(child)
        return scope

    def _scope(self, number: int) -> _Scope:
        if number not in self._scopes:
            self._scopes[number] = _Scope(self._outline, number)
        return self._scopes[number]

    @cached_property
    def _outline(self) -> _Outline:
        return _Outline(self._data)

    def _position(self, offset: int, mark: int | None) -> Position:
        """The position of an offset; `mark` is where its value begins, if that is in its line."""
        before = self._lines_before_block
        block = offset // _BLOCK_SIZE
        while len(before) <= block:
            start = (len(before) - 1) * _BLOCK_SIZE
            before.append(before[-1] + self._data.count(b"\n", start, start + _BLOCK_SIZE))
        line = before[block] + self._data.count(b"\n", block * _BLOCK_SIZE, offset)
        line_start = self._data.rfind(b"\n", 0, offset) + 1
        text = self._data[line_start:offset].decode("utf-8", "replace")
        column = len(text.removeprefix("\ufeff")) + 1
        return Position(line + 1, column, excerpt(self._data, line_start, mark or offset))


class _Outline:
    """The offsets of the prims, variant sets and variants of a text: scopes, numbered in order.

    Scope 0 is the layer.  `start` and `stop` enclose a scope, `body` is after its `{`.
    The offsets are in arrays and names are read on demand, so that the outline of a layer of a
    million prims stays small.
    """

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.start = array("q", [0])
        self.body = array("q", [0])
        self.stop = array("q", [len(data)])
        self.after = array("q", [0])
        """The number of the first scope that follows and is not inside."""
        self._read()

    def _read(self) -> None:
        open_scopes = [0]
        in_variant_set = False
        header: int | None = None
        open_values = 0
        for token in _STRUCTURE.finditer(self.data):
            kind = token.lastindex
            if kind is None:
                continue
            if kind >= _TEXT:
                if in_variant_set and header is None and not open_values:
                    header = token.start()
            elif kind >= _PRIM:
                header = token.start()
            elif kind == _CLOSE:
                if open_values:
                    open_values -= 1
                elif len(open_scopes) > 1:
                    self._close(open_scopes.pop(), token.end())
                    in_variant_set = self.is_variant_set(open_scopes[-1])
                    header = None
            elif kind == _OPEN_VARIANT_SET:
                open_scopes.append(self._open(token.start(), token.end()))
                in_variant_set = True
                header = None
            elif kind == _OPEN and header is not None:
                open_scopes.append(self._open(header, token.end()))
                in_variant_set = False
                header = None
            else:
                open_values += 1
        for number in open_scopes:
            self._close(number, len(self.data))

    def _open(self, start: int, body: int) -> int:
        number = len(self.start)
        self.start.append(start)
        self.body.append(body)
        self.stop.append(body)
        self.after.append(number + 1)
        return number

    def _close(self, number: int, stop: int) -> None:
        self.stop[number] = stop
        self.after[number] = len(self.start)

    def is_variant_set(self, number: int) -> bool:
        return number > 0 and self.data[self.start[number]] == ord("v")

    def name(self, number: int) -> str:
        header = _HEADER.match(self.data, self.start[number])
        literal = header[1] if header else b""
        return unquoted(literal)

    def inside(self, number: int) -> Iterator[int]:
        """The numbers of the scopes directly inside a scope."""
        inner = number + 1
        while inner < self.after[number]:
            yield inner
            inner = self.after[inner]

    def own(self, number: int, start: int) -> Iterator[_Span]:
        """The spans of a scope from `start` on that are outside of the scopes inside it."""
        for inner in self.inside(number):
            yield _Span(start, self.start[inner])
            start = self.stop[inner]
        yield _Span(start, self.stop[number])


class _Property:
    """The statements about one property in one scope."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._spans: list[_Span] = []
        self.value: int | None = None
        """Where the value of the first one begins, if that is in the line of the declaration."""
        self.samples: _Statement | None = None

    def add(self, statement: _Statement) -> None:
        if not self._spans:
            self.value = _end_of(_EQUALS, self._data, statement.value)
        self._spans.append(statement.span)
        if statement.suffix == "timeSamples":
            self.samples = statement

    @property
    def start(self) -> int:
        return self._spans[0].start

    @cached_property
    def assets(self) -> dict[str, int]:
        return _assets(self._data, self._spans)

    def sample(self, time: float) -> _Span | None:
        """The span of the time sample with that key, within rounding; None if there is none."""
        times, offsets = self._keys
        at = bisect_left(times, time)
        for i in sorted(
            range(max(at - 1, 0), min(at + 1, len(times))), key=lambda i: abs(times[i] - time)
        ):
            if math.isclose(times[i], time, rel_tol=1e-6):
                token = _SAMPLE.match(self._data, offsets[i])
                return _Span(*token.span()) if token else None
        return None

    @cached_property
    def _keys(self) -> tuple[array[float], array[int]]:
        """The keys of the time samples, ascending, and their offsets."""
        times: array[float] = array("d")
        offsets: array[int] = array("q")
        opening = self.samples and _SAMPLES.match(self._data, self.samples.value)
        if not self.samples or not opening:
            return times, offsets
        for token in _SAMPLE.finditer(self._data, opening.end(), self.samples.span.stop):
            try:
                times.append(float(token[1]))
            except ValueError:
                continue
            offsets.append(token.start())
        if not all(map(le, times, islice(times, 1, None))):
            order = sorted(range(len(times)), key=times.__getitem__)
            times = array("d", [times[i] for i in order])
            offsets = array("q", [offsets[i] for i in order])
        return times, offsets


class _Scope:
    """A prim, variant set or variant, or the layer."""

    def __init__(self, outline: _Outline, number: int) -> None:
        self._outline = outline
        self._number = number
        self.start = outline.start[number]
        self.body = outline.body[number]

    @cached_property
    def assets(self) -> dict[str, int]:
        return _assets(self._outline.data, self._outline.own(self._number, self.start))

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

    @cached_property
    def properties(self) -> dict[str, _Property]:
        outline = self._outline
        found: dict[str, _Property] = {}
        for span in outline.own(self._number, self.body):
            for statement in _statements(outline.data, span):
                found.setdefault(statement.name, _Property(outline.data)).add(statement)
        return found


def _statements(data: bytes, span: _Span) -> Iterator[_Statement]:
    """The statements about properties in a span of a body that holds no prims."""
    position = span.start
    while position < span.stop:
        head = _STATEMENT.match(data, position, span.stop)
        if head is None:
            return
        position = _statement_stop(data, head.end(), span.stop)
        declaration, _, suffix = _COMMENT.sub(b" ", head[1]).partition(b".")
        words = declaration.rstrip(b"[ \t").decode("utf-8", "replace").split()
        # `reorder properties` orders names and declares none.
        if len(words) > 1 and words[:-1] != ["reorder"]:
            yield _Statement(
                _Span(head.start(1), position),
                head.end(),
                words[-1],
                suffix.strip().decode("utf-8", "replace"),
            )


def _statement_stop(data: bytes, position: int, stop: int) -> int:
    while token := _BREAK.search(data, position, stop):
        if token.lastindex is None:
            return token.end()
        opens = token.lastindex <= len(_BRACKETS)
        position = _bracket_stop(data, token.start(), stop) if opens else token.end()
    return stop


def _bracket_stop(data: bytes, position: int, stop: int) -> int:
    """The offset after the bracket that closes the one at `position`."""
    depth = 0
    for token in _BRACKETS[data[position]].finditer(data, position, stop):
        if token.lastindex == 1:
            depth += 1
        elif token.lastindex == 2:
            depth -= 1
            if depth == 0:
                return token.end()
    return stop


def _end_of(pattern: re.Pattern[bytes], data: bytes, position: int) -> int | None:
    """Where a pattern that begins at `position` ends; None if it is not there."""
    found = pattern.match(data, position)
    return found.end() if found else None


def _assets(data: bytes, spans: Iterable[_Span]) -> dict[str, int]:
    """The offset of the first occurrence of each asset path, and of each with a prim path."""
    found: dict[str, int] = {}
    for span in spans:
        asset, start, stop = "", span.start, -1
        for token in _ASSET.finditer(data, *span):
            if token.lastindex and token.lastindex <= len(_ASSETS):
                asset, start, stop = _asset_path(token[0]), *token.span()
                found.setdefault(asset, start)
            elif token.lastindex:
                follows = token.start() == stop
                target = token[0].decode("utf-8", "replace")
                key = f"{asset}{target}" if follows else target
                found.setdefault(key, start if follows else token.start())
    return found


def unquoted(literal: bytes) -> str:
    """A string without its marks."""
    marks = 3 if literal.startswith((b'"""', b"'''")) else 1
    return literal[marks:-marks].decode("utf-8", "replace")


def _asset_path(literal: bytes) -> str:
    if literal.startswith(b"@@@"):
        literal = literal[3:-3].replace(rb"\@@@", b"@@@")
    else:
        literal = literal[1:-1]
    return literal.decode("utf-8", "replace")
