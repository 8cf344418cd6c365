"""Layers as text."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator
from typing import Any

from .model import ABSENT, Attribute, Expression, File, Layer, Line, Prim, Relationship

_TEXTUAL = {"token", "string"}


def layer_text(layer: Layer) -> str:
    """The whole text of a layer."""
    folder = posixpath.dirname(layer.path)
    lines = ["#usda 1.0", *_metadata(layer.metadata, folder)]
    for prim in layer.prims:
        lines += ["", *_prim(prim, folder)]
    return "\n".join(lines) + "\n"


def _prim(prim: Prim, folder: str) -> Iterator[str]:
    type_name = f"{prim.type} " if prim.type else ""
    yield f'{prim.specifier} {type_name}"{prim.name}"'
    yield from _metadata(prim.metadata, folder)
    yield "{"
    yield from _indented(_properties(prim, folder))
    for child in prim.children:
        yield from _indented(_prim(child, folder))
    for name, variants in prim.variants.items():
        yield f'    variantSet "{name}" = {{'
        for variant, prims in variants.items():
            yield f'        "{variant}" {{'
            for child in prims:
                yield from _indented(_indented(_indented(_prim(child, folder))))
            yield "        }"
        yield "    }"
    yield "}"


def _properties(prim: Prim, folder: str) -> Iterator[str]:
    for name, each in prim.properties.items():
        if isinstance(each, Relationship):
            yield _relationship(name, each)
        else:
            yield from _attribute(name, each, folder)


def _relationship(name: str, relationship: Relationship) -> str:
    custom = "custom " if relationship.is_custom else ""
    if relationship.targets is None:
        return f"{custom}rel {name} = None"
    targets = ", ".join(f"<{target}>" for target in relationship.targets)
    if not targets:
        return f"{custom}rel {name}"
    return f"{custom}rel {name} = [{targets}]"


def _attribute(name: str, attribute: Attribute, folder: str) -> Iterator[str]:
    declared = f"{'uniform ' * attribute.is_uniform}{attribute.type} {name}"
    if attribute.value is not ABSENT or attribute.metadata or not attribute.samples:
        has_value = attribute.value is not ABSENT
        value = f" = {_value(attribute.type, attribute.value, folder)}" if has_value else ""
        first, *metadata = [f"{declared}{value}", *_metadata(attribute.metadata, folder)]
        yield f"{first} (" if metadata else first
        yield from metadata[1:]
    if attribute.samples:
        yield f"{declared}.timeSamples = {{"
        for time, sample in sorted(attribute.samples.items()):
            yield f"    {time!r}: {_value(attribute.type, sample, folder)},"
        yield "}"


def _value(type_name: str, value: Any, folder: str) -> str:
    scalar = type_name.removesuffix("[]")
    if value is None:
        return "None"
    if isinstance(value, list):
        return f"[{', '.join(_value(scalar, each, folder) for each in value)}]"
    if isinstance(value, File):
        return _asset(value, folder)
    if isinstance(value, Expression):
        return f'@`"{_relative(value.path, folder)}"`@'
    if isinstance(value, tuple):
        return f"({', '.join(_value(scalar, each, folder) for each in value)})"
    if scalar == "asset":
        return f"@{value}@"
    if isinstance(value, bool):
        return str(int(value))
    return f'"{value}"' if scalar in _TEXTUAL else repr(value)


def _asset(file: File, folder: str) -> str:
    return f"@{_relative(file.path, folder)}@"


def _relative(path: str, folder: str) -> str:
    path = posixpath.relpath(path, folder or ".")
    return path if path.startswith(".") else f"./{path}"


def _metadata(lines: Iterable[Line], folder: str) -> list[str]:
    texts = [
        "".join(_asset(part, folder) if isinstance(part, File) else part for part in line)
        for line in lines
    ]
    return ["(", *_indented(texts), ")"] if texts else []


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (f"    {line}" for line in lines)
