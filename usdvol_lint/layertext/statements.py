"""The statements of a body about properties, their time samples, and the assets they name."""

from __future__ import annotations

import math
import re
from array import array
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from operator import le
from typing import NamedTuple

from usdvol_lint.cached import cached_property
from usdvol_lint.layertext.lexemes import (
    ASSETS,
    BLOCK_COMMENT,
    BRACE_VALUE,
    COMMENTS,
    OPAQUE,
    PADDING,
    PATHS,
    SPACE,
    STRINGS,
    Span,
    either,
    runs,
    tokens,
)

_BRACKETS = {
    opener: tokens(rb"\%c" % opener, rb"\%c" % closer, plain=OPAQUE)
    for opener, closer in (b"()", b"[]", b"{}")
}
_HEAD = runs(rb"[^=(;\r\n{}#/\"'@<]", BLOCK_COMMENT)
_TAIL = runs(rb"[^()\[\]{};\r\n\"'@#/<]", *OPAQUE, b"/") + rb"[)\]};\r\n]"
_STATEMENT = re.compile(PADDING + b"(" + _HEAD + b")(" + _TAIL + b")?+")
"""The second group is not there where a bracket opens: then the end is to be searched for."""
_BREAK = tokens(
    *(rb"\(", rb"\[", rb"\{"),
    *OPAQUE,
    plain=(rb"\)", rb"\]", rb"\}", b";", b"\n", b"\r"),
)
_COMMENT = re.compile(BLOCK_COMMENT.decode())
_ASSET = tokens(*ASSETS, *PATHS, plain=(*STRINGS, *COMMENTS))
_SAMPLES = re.compile(BRACE_VALUE + PADDING)
_ARRAY = rb"\[" + either(rb"[^\]\"'@#/<]++", *OPAQUE) + b"*+"
_SAMPLE = re.compile(
    rb"([-.0-9i](?<![\w.].)(?:[0-9.]++|i?+nf)?+(?:[eE][-+]?+[0-9]++)?+)"
    + SPACE
    + b"*+:"
    + either(rb"[^,\"'@#/<\[]++", _ARRAY, *OPAQUE)
    + b"*+,?+"
    + PADDING
)
_EQUALS = re.compile(rb"[ \t]*=[ \t]*(?=[^\s])")
KEY = re.compile(rb"[^:\r\n]*:[ \t]*(?=[^\s])")


class Statement(NamedTuple):
    """One statement about a property; `value` is the offset at which the declaration ends."""

    start: int
    value: int
    stop: int
    name: str
    suffix: str

    @property
    def span(self) -> Span:
        return Span(self.start, self.stop)


class Property:
    """The statements about one property in one scope."""

    def __init__(self, data: bytes, statements: Sequence[Statement]) -> None:
        self._data = data
        self._statements = statements

    @property
    def start(self) -> int:
        return self._statements[0].start

    @property
    def value(self) -> int | None:
        """Where the value of the first one begins, if that is in the line of the declaration."""
        return end_of(_EQUALS, self._data, self._statements[0].value)

    @property
    def samples(self) -> Statement | None:
        """The last one with time samples."""
        found = [each for each in self._statements if each.suffix == "timeSamples"]
        return found[-1] if found else None

    @cached_property
    def assets(self) -> dict[str, int]:
        return asset_offsets(self._data, (statement.span for statement in self._statements))

    def sample(self, time: float) -> Span | None:
        """The span of the time sample with that key, within rounding; None if there is none."""
        times, offsets = self._keys
        at = bisect_left(times, time)
        for i in sorted(
            range(max(at - 1, 0), min(at + 1, len(times))), key=lambda i: abs(times[i] - time)
        ):
            if math.isclose(times[i], time, rel_tol=1e-6):
                token = _SAMPLE.match(self._data, offsets[i])
                return Span(*token.span()) if token else None
        return None

    @cached_property
    def _keys(self) -> tuple[array[float], array[int]]:
        """The keys of the time samples, ascending, and their offsets."""
        times: array[float] = array("d")
        offsets: array[int] = array("q")
        samples = self.samples
        opening = samples and _SAMPLES.match(self._data, samples.value)
        if not samples or not opening:
            return times, offsets
        for token in _SAMPLE.finditer(self._data, opening.end(), samples.stop):
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


def statements(data: bytes, span: Span) -> Iterator[Statement]:
    """The statements about properties in a span of a body that holds no prims."""
    position, stop = span
    while position < stop:
        head = _STATEMENT.match(data, position, stop)
        if head is None:
            return
        start, value = head.span(1)
        position = head.end() if head[2] else _statement_stop(data, value, stop)
        text = head[1].decode("utf-8", "replace")
        if "/" in text:
            text = _COMMENT.sub(" ", text)
        declaration, _, suffix = text.partition(".")
        words = declaration.rstrip("[ \t").split()
        # `reorder properties` orders names and declares none.
        if len(words) > 1 and (len(words) > 2 or words[0] != "reorder"):
            yield Statement(start, value, position, words[-1], suffix.strip())


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


def end_of(pattern: re.Pattern[bytes], data: bytes, position: int) -> int | None:
    """Where a pattern that begins at `position` ends; None if it is not there."""
    found = pattern.match(data, position)
    return found.end() if found else None


def asset_offsets(data: bytes, spans: Iterable[Span]) -> dict[str, int]:
    """The offset of the first occurrence of each asset path, and of each with a prim path."""
    found: dict[str, int] = {}
    for span in spans:
        asset, start, stop = "", span.start, -1
        for token in _ASSET.finditer(data, *span):
            if token.lastindex and token.lastindex <= len(ASSETS):
                asset, start, stop = _asset_path(token[0]), *token.span()
                found.setdefault(asset, start)
            elif token.lastindex:
                follows = token.start() == stop
                target = token[0].decode("utf-8", "replace")
                key = f"{asset}{target}" if follows else target
                found.setdefault(key, start if follows else token.start())
    return found


def _asset_path(literal: bytes) -> str:
    if literal.startswith(b"@@@"):
        literal = literal[3:-3].replace(rb"\@@@", b"@@@")
    else:
        literal = literal[1:-1]
    return literal.decode("utf-8", "replace")
