"""Real bytes and texts with a few things changed."""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from random import Random

from .numbers import INTEGERS, asset, number, quoted, text

_NUMBER = re.compile(r"(?<![\w.#])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w.])")
_STRING = re.compile(r'(?<=[=:\[,] )"[^"\n]*"')
_ASSET = re.compile(r"@[^@\n]*@")
_PATH = re.compile(r"</[^>\n]*>")
_WORD = re.compile(r"\b(?:float|int|token|asset|rel|def|over|class|double|half|uniform|custom)\b")
_WORDS = ("float", "int[]", "token", "asset", "rel", "def", "over", "class", "double", "string")
_PATHS = ("</>", "<..>", "<>", "</a.b>", "</a/b{c=d}e>", "</cloud>", "<" + "/a" * 400 + ">")

Change = Callable[[Random, bytearray], None]


def mutated_bytes(rng: Random, data: bytes) -> bytes:
    """The bytes with one to four changes."""
    changed = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 4))):
        if changed:
            rng.choice(_CHANGES)(rng, changed)
    return bytes(changed)


def _flip(rng: Random, data: bytearray) -> None:
    data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)


def _early(rng: Random, data: bytearray) -> None:
    """Headers are what readers believe."""
    data[rng.randrange(min(len(data), 400))] = rng.choice((0, 1, 127, 128, 255))


def _integer(rng: Random, data: bytearray) -> None:
    width, form = rng.choice(((2, "<H"), (4, "<I"), (8, "<Q")))
    at = rng.randrange(max(len(data) - width, 1))
    value = rng.choice(INTEGERS) % (1 << 8 * width)
    data[at : at + width] = struct.pack(form, value)


def _number(rng: Random, data: bytearray) -> None:
    at = rng.randrange(max(len(data) - 8, 1))
    value = rng.choice((float("nan"), float("inf"), -1e308, 1e-320))
    data[at : at + 8] = struct.pack("<d", value)


def _cut(rng: Random, data: bytearray) -> None:
    del data[rng.randrange(len(data)) :]


def _drop(rng: Random, data: bytearray) -> None:
    at = rng.randrange(len(data))
    del data[at : at + rng.choice((1, 4, 16, 200))]


def _repeat(rng: Random, data: bytearray) -> None:
    at, size = rng.randrange(len(data)), rng.choice((1, 8, 64, 4096))
    data[at:at] = data[at : at + size] * rng.choice((1, 3, 30))


def _odd(rng: Random, data: bytearray) -> None:
    at = rng.randrange(len(data))
    data[at:at] = rng.choice((b"\0", b"\xff\xfe", b"\xed\xa0\x80", b"\r", b"\x1b[2J", b'"', b"\n"))


_CHANGES: tuple[Change, ...] = (_flip, _flip, _early, _integer, _number, _cut, _drop, _repeat, _odd)


def mutated_layer(rng: Random, layer: str) -> str:
    """A USD text with one to four of its values or words replaced by hostile ones of their kind."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        pattern, replacement = rng.choice(
            (
                (_NUMBER, lambda: number(rng)),
                (_NUMBER, lambda: number(rng)),
                (_STRING, lambda: quoted(text(rng))),
                (_ASSET, lambda: asset(text(rng))),
                (_ASSET, lambda: asset(text(rng))),
                (_PATH, lambda: rng.choice(_PATHS)),
                (_WORD, lambda: rng.choice(_WORDS)),
            )
        )
        found = list(pattern.finditer(layer, layer.find("\n") + 1))
        if found:
            one = rng.choice(found)
            layer = layer[: one.start()] + replacement() + layer[one.end() :]
    return layer


def mutated_value(rng: Random, data: str) -> str:
    """A JSON or TOML text with one to three of its values replaced."""
    for _ in range(rng.choice((1, 1, 2, 3))):
        found = [*_NUMBER.finditer(data), *_STRING.finditer(data)]
        if found:
            one = rng.choice(found)
            data = data[: one.start()] + rng.choice(_VALUES)(rng) + data[one.end() :]
    return data


_VALUES: tuple[Callable[[Random], str], ...] = (
    number,
    lambda rng: quoted(text(rng)),
    lambda rng: "9" * 5000,
    lambda rng: "[" * rng.choice((1, 200, 3000)),
    lambda rng: "[]",
    lambda rng: "{}",
    lambda rng: "null",
    lambda rng: "NaN",
    lambda rng: '"\\ud800"',
    lambda rng: '"a\\u0000b"',
    lambda rng: '"0-999998, 0-999997, 0-999996"',
    lambda rng: f'"{"0-999990," * 300}1"',
    lambda rng: '"-inf-inf", true',
)
