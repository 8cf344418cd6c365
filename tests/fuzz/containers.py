"""Zip packages and volume files that lie about themselves, or hold more than anyone writes."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Callable
from random import Random
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

import vdbwriter as vdb

from .layers import Files
from .model import STAGE, volume
from .numbers import INTEGERS, text

_LOCAL = struct.Struct("<4s5H3I2H")
_CENTRAL = struct.Struct("<4s6H3I5H2I")
_END = struct.Struct("<4s4H2IH")
_ZIP64 = struct.Struct("<HHQQQ")


def zipped(files: Files, method: int = ZIP_STORED) -> bytes:
    """A plain archive."""
    buffer = io.BytesIO()
    with ZipFile(buffer, "w", method) as archive:
        for name, data in files.items():
            archive.writestr(ZipInfo(name), data, method)  # without the time of day
    return buffer.getvalue()


def archive(
    files: list[tuple[bytes, bytes]],
    *,
    local: dict[str, int] | None = None,
    central: dict[str, int] | None = None,
    extra: bytes = b"",
    count: int | None = None,
    comment: bytes = b"",
) -> bytes:
    """An archive in which any number may be a lie; `extra` is what the directory has beside it."""
    data, directory = bytearray(), bytearray()
    for name, content in files:
        crc, size, start = zlib.crc32(content), len(content), len(data)
        said = {"needed": 10, "flags": 0, "method": 0, "packed": size, "size": size}
        one, other = ({**said, "start": start, **(lies or {})} for lies in (local, central))
        heads = (one["needed"], one["flags"], one["method"], 0, 0)
        data += _LOCAL.pack(b"PK\3\4", *heads, crc, one["packed"], one["size"], len(name), 0)
        data += name + content
        heads = (20, other["needed"], other["flags"], other["method"], 0, 0)
        sizes = (crc, other["packed"], other["size"], len(name), len(extra), 0, 0, 0, 0)
        directory += _CENTRAL.pack(b"PK\1\2", *heads, *sizes, other["start"]) + name + extra
    number = min(len(files) if count is None else count, 0xFFFF)
    end = (0, 0, number, number, len(directory), len(data), len(comment))
    return bytes(data + directory + _END.pack(b"PK\5\6", *end) + comment)


def built_package(rng: Random) -> Files:
    """A stage that names a volume file in a package, or that is one."""
    inner = rng.choice(("a.vdb", "x/a.vdb", "9" * 5000 + ".vdb"))
    layer = volume(inner.replace("x/", "./x/"))
    files = [(b"root.usda", layer), (inner.encode(), vdb.vdb(vdb.Grid()))]
    package = rng.choice(_PACKAGES)(rng, files)
    if rng.random() < 0.4:
        return {"stage.usdz": package}
    path = rng.choice((f"a.usdz[{inner}]", "a.usdz[nowhere.vdb]", f"a.usdz[{text(rng)}]"))
    return {STAGE: volume(path), "a.usdz": package}


_Entries = list[tuple[bytes, bytes]]


def _lying(rng: Random, files: _Entries) -> bytes:
    name = rng.choice(("needed", "flags", "method", "packed", "size", "start"))
    top = 0xFFFF if name in ("needed", "flags", "method") else 0xFFFFFFFF
    lie = {name: rng.choice((255, 63, 8, 1, 9, *INTEGERS)) % (top + 1)}
    return archive(files, **{rng.choice(("local", "central")): lie})  # type: ignore[arg-type]


def _zip64(rng: Random, files: _Entries) -> bytes:
    numbers = [rng.choice(INTEGERS) % 2**64 for _ in range(3)]
    whole = dict.fromkeys(("packed", "size", "start"), 0xFFFFFFFF)
    return archive(files, central=whole, extra=_ZIP64.pack(1, 24, *numbers))


def _names(rng: Random, files: _Entries) -> bytes:
    odd = rng.choice(
        (b"\xff\xfe.vdb", b"a\0b.vdb", b"../../x.vdb", b"/abs.vdb", b"n" * 60_000, b"")
    )
    return archive([*files, (odd, b"x" * 100)] if rng.random() < 0.5 else [(odd, files[0][1])])


def _many(rng: Random, files: _Entries) -> bytes:
    count = rng.choice((300, 20_000))
    return archive([*files, *((b"f.%04d.vdb" % n, b"") for n in range(count))])


def _overlapping(rng: Random, files: _Entries) -> bytes:
    return archive([*files, *((b"o%d.vdb" % n, b"x") for n in range(9))], central={"start": 0})


def _bomb(rng: Random, files: _Entries) -> bytes:
    return zipped({"root.usda": files[0][1], "a.vdb": bytes(30_000_000)}, ZIP_DEFLATED)


def _extras(rng: Random, files: _Entries) -> bytes:
    extra = rng.choice((b"\1\0\xff\xff", b"\1", struct.pack("<HHI", 1, 4, 3), b"\x86\x19\x02\0ab"))
    return archive(files, extra=extra, comment=b"PK\5\6" * rng.choice((1, 9000)))


def _counts(rng: Random, files: _Entries) -> bytes:
    return archive(files, count=rng.choice((0, 1, 9, 65535)))


_PACKAGES: tuple[Callable[[Random, _Entries], bytes], ...] = (
    *(_lying, _lying, _zip64, _names, _many, _overlapping, _bomb, _extras, _counts),
)


def built_volume(rng: Random) -> Files:
    """A stage that names a volume file which is one by its first bytes."""
    return {STAGE: volume("a.vdb"), "a.vdb": rng.choice(_VOLUMES)(rng)}


def _many_metadata(rng: Random) -> bytes:
    count, size = rng.choice(((2000, 3000), (40, 1 << 20), (60_000, 1)))
    entries = {f"m{n}": vdb.string(b"x" * size) for n in range(count)}
    if rng.random() < 0.5:
        return vdb.vdb(vdb.Grid(), metadata_bytes=vdb.metadata(entries))
    return vdb.vdb(vdb.Grid(metadata={"name": vdb.string("density"), **entries}))


def _many_grids(rng: Random) -> bytes:
    return vdb.vdb(*(vdb.Grid(f"density\x1e{n}") for n in range(rng.choice((20, 3000)))))


def _odd_names(rng: Random) -> bytes:
    name = rng.choice((b"", b"\xff", b"\0", b"d" * 65_000, b"density\x1e" + b"9" * 5000, b"\x1e"))
    return vdb.vdb(vdb.Grid(name), vdb.Grid(text(rng), parent=text(rng)))


def _lying_offsets(rng: Random) -> bytes:
    lies = tuple((rng.choice(INTEGERS) + 2**63) % 2**64 - 2**63 for _ in range(3))
    return vdb.vdb(vdb.Grid(), vdb.Grid("b", offsets=lambda *_: (lies[0], lies[1], lies[2])))


def _odd_maps(rng: Random) -> bytes:
    def odd() -> float:
        return rng.choice((0.0, 1.0, -1.0, 1e308, -1e308, 5e-324, float("nan"), float("inf")))

    corners = ((odd(), odd(), odd()), (odd(), odd(), odd()))
    made = rng.choice(
        (
            vdb.frustum(*corners, odd(), odd()),
            vdb.affine(*(odd() for _ in range(16))),
            vdb.translation(odd(), odd(), odd()),
            vdb.frustum(*corners, odd(), odd(), vdb.frustum(*corners, 1, 1)),
        )
    )
    far = 2**31 - 1
    entries = {"name": vdb.string("density"), **vdb.bounds((-far, 0, 0), (far, far, far))}
    return vdb.vdb(vdb.Grid(transform=made, metadata=entries))


def _odd_header(rng: Random) -> bytes:
    version = rng.choice((0, 221, 222, 226, 2**32 - 1))
    return vdb.vdb(vdb.Grid(), version=version, count=rng.choice((0, 1, -1, 100_000, 2**31 - 1)))


_VOLUMES: tuple[Callable[[Random], bytes], ...] = (
    *(_many_metadata, _many_grids, _odd_names, _lying_offsets, _odd_maps, _odd_header),
)
