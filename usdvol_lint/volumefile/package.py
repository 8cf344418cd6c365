"""The position of a file within its package, a zip archive."""

from __future__ import annotations

import io
from struct import Struct
from zipfile import ZIP_STORED, ZipFile, ZipInfo

_LOCAL_HEADER = Struct("<4s22xHH")
_SIGNATURE = b"PK\3\4"
_ENCRYPTED = 1
_LARGEST_DIRECTORY = 12 << 20
"""In bytes: 100,000 files with long names take less, and what is read of it five times as much."""


class NotInPlaceError(Exception):
    """Why a file can't be read from within its package: a predicate, as in `is compressed`."""


class Package:
    """The directory of a package; empty if the file is no readable zip archive."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._why_not = "is not listed in the directory of its package"
        try:
            members = _directory(path, "utf-8") or _directory(path, None)
        except _TooLargeError:
            members = []
            self._why_not = "lies in a package of more files than are looked through"
        self._members = {member.filename: member for member in members}

    @property
    def names(self) -> list[str]:
        """The paths of its members."""
        return list(self._members)

    def locate(self, inner: str) -> tuple[int, int]:
        """Offset and size of a member in bytes; raises NotInPlaceError if it can't be read so."""
        if inner.endswith("]"):
            raise NotInPlaceError("lies in a package inside of its package")
        member = self._members.get(inner)
        if member is None:
            raise NotInPlaceError(self._why_not)
        if member.compress_type != ZIP_STORED or member.flag_bits & _ENCRYPTED:
            raise NotInPlaceError("is compressed or encrypted in its package")
        header = self._read(member.header_offset)
        if len(header) < _LOCAL_HEADER.size or not header.startswith(_SIGNATURE):
            raise NotInPlaceError("is not where the directory of its package says")
        # The extra field, which aligns the data, has another size here than in the directory.
        _, name, extra = _LOCAL_HEADER.unpack(header)
        return member.header_offset + _LOCAL_HEADER.size + name + extra, member.file_size

    def _read(self, offset: int) -> bytes:
        """The local header at an offset, which may be one that no file has; empty if so."""
        try:
            with open(self._path, "rb") as file:
                file.seek(offset)
                return file.read(_LOCAL_HEADER.size)
        except (OSError, OverflowError, ValueError):
            return b""


def first_in(path: str) -> str:
    """The path of the first member of a package, which is the layer that USD opens; or ""."""
    return next(iter(Package(path).names), "")


class _TooLargeError(Exception):
    pass


class _Archive(io.FileIO):
    """An archive of which no more is read at once than a directory may take."""

    def read(self, size: int | None = -1, /) -> bytes:
        if size is not None and size > _LARGEST_DIRECTORY:
            raise _TooLargeError
        return super().read(_LARGEST_DIRECTORY if size is None or size < 0 else size) or b""


def _directory(path: str, encoding: str | None) -> list[ZipInfo]:
    """The members of a zip archive; none if it is not readable, which is reported for each.

    USD writes names in UTF-8 without saying so, for which `encoding` stands.
    """
    try:
        with _Archive(path) as file, ZipFile(file, metadata_encoding=encoding) as archive:
            return archive.infolist()
    except _TooLargeError:
        raise
    except Exception:  # of a forged one zipfile raises many types, such as struct.error
        return []
