"""The outline of a layer's text: where its prims, variant sets and variants begin and end."""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator

from usdvol_lint.layertext.lexemes import (
    ASSETS,
    BRACE_VALUE,
    COMMENTS,
    NAMED,
    PATHS,
    SPACE,
    STRING,
    STRINGS,
    Span,
    tokens,
    unquoted,
)

_OPEN, _CLOSE, _OPEN_VALUE, _OPEN_VARIANT_SET, _PRIM, _, _, _TEXT = range(1, 9)
_STRUCTURE = tokens(
    rb"\{",
    rb"\}",
    BRACE_VALUE,
    b"variantSet" + SPACE + b"++" + STRING + SPACE + b"*+" + BRACE_VALUE,
    b"def" + NAMED,
    b"over" + NAMED,
    b"class" + NAMED,
    *STRINGS,
    plain=(*ASSETS, *COMMENTS, *PATHS),
)
_HEADER = re.compile(
    rb"(?:(?:def|over|class|variantSet)" + NAMED.replace(STRING, b"") + b")?+(" + STRING + b")"
)


class Outline:
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

    def own(self, number: int, start: int) -> Iterator[Span]:
        """The spans of a scope from `start` on that are outside of the scopes inside it."""
        for inner in self.inside(number):
            yield Span(start, self.start[inner])
            start = self.stop[inner]
        yield Span(start, self.stop[number])
