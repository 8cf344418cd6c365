"""Packages whose directories lie: what is asked of them is answered, and costs little."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import pytest
from fuzz.containers import archive
from process import ASSETS

from usdvol_lint.facts.grids.reader import ContentReader
from usdvol_lint.model import StageReport
from usdvol_lint.volumefile import package as packages
from usdvol_lint.volumefile.package import NotInPlaceError, Package

Lint = Callable[..., StageReport]

FILES = [(b"a.vdb", b"x" * 200)]
WHOLE = {"central": dict.fromkeys(("packed", "size", "start"), 0xFFFFFFFF)}
FAR = struct.pack("<HHQQQ", 1, 24, 200, 200, 2**62)
FORGED = {
    "an offset of 2^62": archive(FILES, **WHOLE, extra=FAR),
    "an offset of 2^64": archive(FILES, **WHOLE, extra=FAR[:20] + b"\xff" * 8),
    "a cut zip64 record": archive(FILES, **WHOLE, extra=FAR[:9]),
    "a newer zip": archive(FILES, central={"needed": 255}),
    "names that are no UTF-8": archive([(b"\xff\xfe.vdb", b"")]),
    "names in UTF-8 that are none": archive([(b"\xff.vdb", b"")], central={"flags": 0x800}),
    "a file over another": archive([*FILES, (b"b", b"")], central={"start": 3}),
    "compressed": archive(FILES, central={"method": 8}),
}
STAGE = """#usda 1.0
def OpenVDBAsset "a"
{
    asset filePath = @./shot.usdz[a.vdb]@
    token fieldName = "density"
}
def OpenVDBAsset "b"
{
    asset filePath = @./cloud.vdb@
    token fieldName = "gone"
}
"""


@pytest.mark.parametrize("content", FORGED.values(), ids=FORGED)
def test_a_forged_package_is_said_not_to_hold_it(
    content: bytes, lint_text: Lint, tmp_path: Path
) -> None:
    (tmp_path / "shot.usdz").write_bytes(content)
    (tmp_path / "cloud.vdb").write_bytes((ASSETS / "cloud.vdb").read_bytes())
    with pytest.raises(NotInPlaceError):
        Package(str(tmp_path / "shot.usdz")).locate("a.vdb")
    codes = [finding.code for finding in lint_text(STAGE).findings]
    assert "GRD003" in codes, "what is known of the other field is told"
    assert not {"LNT001", "LNT002"}.intersection(codes)


def test_a_directory_that_is_too_large_is_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.usdz").write_bytes(archive([(b"%09d" % n, b"") for n in range(50)]))
    assert len(Package(str(tmp_path / "a.usdz")).names) == 50
    monkeypatch.setattr(packages, "_LARGEST_DIRECTORY", 2000)
    package = Package(str(tmp_path / "a.usdz"))
    assert package.names == []
    with pytest.raises(NotInPlaceError, match="of more files than are looked through"):
        package.locate("000000007")


def test_what_a_reader_raises_takes_no_other_finding_along(
    lint_text: Lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def raises(*_: object) -> None:
        raise MemoryError("of\nno use")

    monkeypatch.setattr(ContentReader, "_read_packaged", raises)
    (tmp_path / "shot.usdz").write_bytes(archive(FILES))
    (tmp_path / "cloud.vdb").write_bytes((ASSETS / "cloud.vdb").read_bytes())
    told = [(each.code, each.message) for each in lint_text(STAGE).findings]
    said = "'./shot.usdz[a.vdb]' was not looked into: reading it failed, MemoryError: of no use"
    assert told.count(("LNT005", said)) == 1
    assert "GRD003" in [code for code, _ in told]
