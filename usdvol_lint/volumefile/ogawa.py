"""Reads Field3D's groups from an Ogawa file: a tree of nameless groups and data."""

from __future__ import annotations

from struct import Struct

from usdvol_lint.volumefile.f3d import DEEPEST, LARGEST_VALUE, MOST, Group
from usdvol_lint.volumefile.model import Metadatum, VolumeFileError
from usdvol_lint.volumefile.signatures import OGAWA
from usdvol_lint.volumefile.window import Window

_ROOT_NAME = "f3droot"
_LONGEST_NAME = 1 << 16
_IS_DATA = 1 << 63  # set in the position of a child that is data, not a group
_GROUP, _ATTRIBUTE = 0, 1
_ATTRIBUTE_PARTS = 4
_TIMES_READ = 4  # a file may be read so many times over, as parts that are shared are

_HEADER = Struct("<5sB2sQ")
_CLOSED = 0xFF
_U64 = Struct("<Q")
_I32 = Struct("<i")
_TYPES: dict[int, tuple[str, Struct]] = {
    code: (name, Struct(form))
    for code, (name, form) in enumerate(
        (
            *(("int8", "<b"), ("uint8", "<B"), ("int16", "<h"), ("uint16", "<H")),
            *(("int32", "<i"), ("uint32", "<I"), ("int64", "<q"), ("uint64", "<Q")),
            *(("half", "<e"), ("float", "<f"), ("double", "<d")),
            *(("vec3h", "<3e"), ("vec3s", "<3f"), ("vec3d", "<3d"), ("vec3i", "<3i")),
            ("mat4d", "<16d"),
        )
    )
}
_STRING = 16


def read_ogawa(window: Window) -> Group:
    """The root group; raises VolumeFileError."""
    _, state, _, root = window.unpack(_HEADER)
    if state != _CLOSED or root == 0:
        raise VolumeFileError("truncated", "its writer never closed the file", len(OGAWA))
    reader = _Reader(window)
    name, kind = reader.head(reader.children(root, _ATTRIBUTE_PARTS), root)
    if (name, kind) != (_ROOT_NAME, _GROUP):
        raise _invalid("an Ogawa file, but not of Field3D", root)
    return reader.group(name, root, 1)


class _Reader:
    """Reads groups; `budget` is how many more bytes it may read."""

    def __init__(self, window: Window) -> None:
        self.window = window
        self.budget = _TIMES_READ * window.size

    def group(self, name: str, position: int, depth: int) -> Group:
        """The group at a position; after name and kind its children are attributes and groups."""
        group = Group(name)
        for child in self.children(position, None)[2:]:
            if child & _IS_DATA or not child:
                continue
            parts = self.children(child, _ATTRIBUTE_PARTS)
            child_name, kind = self.head(parts, child)
            if kind == _ATTRIBUTE:
                group.attributes[child_name] = self.attribute(parts, child)
            elif kind == _GROUP and depth < DEEPEST:
                group.groups.append(self.group(child_name, child, depth + 1))
        return group

    def children(self, position: int, most: int | None) -> tuple[int, ...]:
        """The positions of a group's first `most` children, or of all; data has `_IS_DATA` set."""
        window = self.window
        window.position = position
        (count,) = window.unpack(_U64)
        window.require(count * _U64.size)
        taken = count if most is None else min(count, most)
        if taken > MOST:
            raise _invalid(f"a group of {count}", position)
        return Struct(f"<{taken}Q").unpack(self.spend(taken * _U64.size))

    def spend(self, count: int) -> bytes:
        """The next bytes, within the budget: a file that exceeds it has loops or shared parts."""
        self.budget -= count
        if self.budget < 0:
            raise _invalid("parts that belong to several groups", self.window.position)
        return self.window.read(count)

    def data(self, child: int, longest: int) -> bytes | None:
        """The bytes of a child; None if they are more than `longest`."""
        if not child & _IS_DATA:
            raise _invalid("a group where data should be", child)
        position = child & ~_IS_DATA
        if position == 0:
            return b""
        window = self.window
        window.position = position
        (size,) = window.unpack(_U64)
        window.require(size)
        return self.spend(size) if size <= longest else None

    def head(self, children: tuple[int, ...], at: int) -> tuple[str, int]:
        """A group's name and kind, which are its first two children."""
        if len(children) < 2:
            raise _invalid("a group without name and kind", at)
        name = self.data(children[0], _LONGEST_NAME)
        kind = self.data(children[1], _I32.size)
        if name is None or kind is None or len(kind) != _I32.size:
            raise _invalid("a group without name and kind", at)
        return name.decode("utf-8", "surrogateescape"), int(_I32.unpack(kind)[0])

    def attribute(self, children: tuple[int, ...], at: int) -> Metadatum:
        if len(children) != _ATTRIBUTE_PARTS:
            raise _invalid("an attribute without type and value", at)
        kind = self.data(children[2], _I32.size)
        if kind is None or len(kind) != _I32.size:
            raise _invalid("an attribute without type and value", at)
        return self.value(int(_I32.unpack(kind)[0]), children[3], at)

    def value(self, kind: int, child: int, at: int) -> Metadatum:
        stored = self.data(child, LARGEST_VALUE)
        if stored is None:
            return Metadatum("unknown", None, LARGEST_VALUE)
        if kind == _STRING:
            return Metadatum("string", stored.decode("utf-8", "surrogateescape"), len(stored))
        if kind not in _TYPES:
            return Metadatum("unknown", None, len(stored))
        name, form = _TYPES[kind]
        if len(stored) != form.size:
            raise _invalid(f"{len(stored)} bytes of {name}, which takes {form.size}", at)
        values: tuple[float, ...] = form.unpack(stored)
        return Metadatum(name, values if len(values) > 1 else values[0], len(stored))


def _invalid(message: str, offset: int) -> VolumeFileError:
    return VolumeFileError("not-a-volume-file", message, offset & ~_IS_DATA)
