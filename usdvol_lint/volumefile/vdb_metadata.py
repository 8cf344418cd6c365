"""OpenVDB's metadata, of a file and of its grids: named values, each with its type and size."""

from __future__ import annotations

from collections.abc import Mapping
from struct import Struct
from typing import Final

from usdvol_lint.volumefile.model import (
    BOUNDS_NAMES,
    IndexBounds,
    MetadataValue,
    Metadatum,
    invalid,
)
from usdvol_lint.volumefile.window import Window

LONGEST_NAME: Final = 1 << 16
LONGEST_TYPE: Final = 1 << 10
MOST: Final = 100_000
"""More entries, or grids, than any writer writes."""

_LARGEST_VALUE = 1 << 16
_ASKED_FOR = frozenset(("name", "class", "vector_type"))
_ENTRY_KEPT = 64
"""What an entry takes beside its texts, by a low estimate."""
_SMALLEST_ENTRY = 12
_U32 = Struct("<I")
_VALUES = {
    "bool": Struct("<?"),
    "int32": Struct("<i"),
    "int64": Struct("<q"),
    "float": Struct("<f"),
    "double": Struct("<d"),
    "ptidx32": Struct("<I"),
    "ptidx64": Struct("<Q"),
    **{
        f"vec{length}{letter}": Struct(f"<{length}{code}")
        for length in (2, 3, 4)
        for letter, code in (("i", "i"), ("s", "f"), ("d", "d"))
    },
    "mat4s": Struct("<16f"),
    "mat4d": Struct("<16d"),
}


def read_metadata(window: Window) -> dict[str, Metadatum]:
    """The entries at the window's position, without OpenVDB's internal ones.

    Values that may differ between frames are noted for `volumefile.recall`.
    """
    at = window.position
    (count,) = window.unpack(_U32)
    if count > MOST:
        raise invalid(f"{count} metadata entries", at)
    window.require(count * _SMALLEST_ENTRY)
    entries: dict[str, Metadatum] = {}
    for _ in range(count):
        at = window.position
        name = window.string(LONGEST_NAME)
        if not name:
            raise invalid("metadata without a name", at)
        value_type = window.string(LONGEST_TYPE)
        (size,) = window.unpack(_U32)
        window.keep(_ENTRY_KEPT)
        value = _read_value(window, name, value_type, size)
        if value_type in _VALUES and value_type != "bool":
            is_corner = value_type == "vec3i" and name in BOUNDS_NAMES
            window.note(name if is_corner else "number", size)
        elif value_type not in ("bool", "string"):
            window.note("skipped", size)
        if not value_type.startswith("__"):
            entries[name] = Metadatum(value_type, value, size)
    return entries


def _read_value(window: Window, name: str, value_type: str, size: int) -> MetadataValue:
    form = _VALUES.get(value_type)
    if form is not None:
        if size != form.size:
            message = f"{size} bytes of {value_type}, which takes {form.size}"
            raise invalid(message, window.position - _U32.size)
        values: tuple[float, ...] = window.unpack(form)
        return values if len(values) > 1 else values[0]
    is_text = value_type == "string" and size <= _LARGEST_VALUE
    if is_text and (name in _ASKED_FOR or window.has_room(size)):
        window.keep(size)
        return window.read(size).decode("utf-8", "surrogateescape")
    window.skip(size)
    return None


def text(metadata: Mapping[str, Metadatum], name: str) -> str:
    """The value of an entry; empty if the entry is missing or of another type."""
    entry = metadata.get(name)
    return entry.value if entry is not None and isinstance(entry.value, str) else ""


def flag(metadata: Mapping[str, Metadatum], name: str) -> bool:
    """Whether an entry is true; False if it is missing or of another type."""
    entry = metadata.get(name)
    return entry is not None and entry.value is True


def index_bounds(metadata: Mapping[str, Metadatum]) -> IndexBounds | None:
    """The bounds as stored: in a grid without voxels, the lowest are above the highest."""
    low, high = map(metadata.get, BOUNDS_NAMES)
    if low is None or high is None or not low.type == high.type == "vec3i":
        return None
    return low.value, high.value  # type: ignore[return-value]
