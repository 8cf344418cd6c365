"""The lists of API schemas as they are written, which USD drops if a name stands in one twice."""

from __future__ import annotations

import re
from collections.abc import Iterator

from usdvol_lint.layertext.lexemes import OPAQUE, SPACE, STRINGS, unquoted

_SPACES = SPACE + b"*+"
_LIST = re.compile(
    rb"(?P<brace>[{}])|(?:\b(?P<how>\w++)"
    + SPACE
    + rb"++)?\bapiSchemas"
    + _SPACES
    + b"="
    + _SPACES
    + rb"(?P<opening>\[)|"
    + b"|".join(OPAQUE)
)
_ITEM = re.compile(b"(" + b"|".join(STRINGS) + rb")|(\])|" + b"|".join(OPAQUE))


def doubled_lists(heading: bytes) -> dict[str, tuple[str, ...]]:
    """The lists of `apiSchemas` in which a name stands twice, by the word before: `prepend`.

    `heading` is what stands before the body of a prim; of two lists with one word the last counts.
    """
    lists: dict[str, tuple[str, ...]] = {}
    depth = 0
    for token in _LIST.finditer(heading):
        if token["brace"]:
            depth += 1 if token["brace"] == b"{" else -1
        elif token["opening"] and not depth:
            lists[(token["how"] or b"").decode()] = tuple(_names(heading, token.end()))
    return {how: names for how, names in lists.items() if len({*names}) < len(names)}


def _names(heading: bytes, start: int) -> Iterator[str]:
    for token in _ITEM.finditer(heading, start):
        if token[2]:
            return
        if token[1]:
            yield unquoted(token[1])
