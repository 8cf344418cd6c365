"""What is inside packages, and inside files of other formats."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
import vdbwriter as w
from gridtexts import DENSITY, Lint, density, field, grid, said, stage
from process import SAMPLES

from usdvol_lint.volumefile.package import NotInPlaceError, Package


def test_files_in_a_package_are_read_in_place(lint_text: Lint, tmp_path: Path) -> None:
    fields = density("./good.vdb", "./cut.vdb", "./other.vdb", "./text.vdb", "./pointer.vdb")
    with zipfile.ZipFile(tmp_path / "shot.usdz", "w") as archive:
        archive.writestr("root.usda", stage(fields))
        archive.writestr("good.vdb", w.vdb(grid()))
        archive.writestr("cut.vdb", w.vdb(grid())[:-10])
        archive.writestr("other.vdb", w.vdb(grid("smoke")))
        archive.writestr("text.vdb", b"just a note")
        archive.writestr("pointer.vdb", b"version https://git-lfs.github.com/spec/v1\n")
    size = len(w.vdb(grid()))
    report = lint_text("#usda 1.0\n(\n    subLayers = [@shot.usdz@]\n)\n")
    assert sorted(said(report, "GRD", "AST005")) == [
        (
            "AST005",
            "5",
            "'./pointer.vdb' is a Git-LFS pointer, not the file itself (1 of 5 samples)",
        ),
        (
            "GRD001",
            "4",
            "'./text.vdb' is not a volume file: its first bytes are not those of OpenVDB, NanoVDB "
            "or Field3D (1 of 5 samples)",
        ),
        (
            "GRD002",
            "2",
            f"'./cut.vdb' is cut off: grid 'density' ends at byte {size}, the file at {size - 10} "
            "(1 of 5 samples)",
        ),
        ("GRD003", "3", "no grid 'density' in './other.vdb', which holds 'smoke' (1 of 5 samples)"),
    ]


def test_what_is_not_stored_as_it_is_can_not_be_read(lint_text: Lint, tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "inner.usdz", "w") as archive:
        archive.writestr("a.vdb", w.vdb(grid()))
    with zipfile.ZipFile(tmp_path / "shot.usdz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("root.usda", "#usda 1.0\n", zipfile.ZIP_STORED)
        archive.writestr("packed.vdb", w.vdb(grid("smoke")))
        archive.write(tmp_path / "inner.usdz", "inner.usdz", zipfile.ZIP_STORED)
    report = lint_text(stage(density("./shot.usdz[packed.vdb]", "./shot.usdz[inner.usdz[a.vdb]]")))
    assert said(report, "GRD", "LNT", "AST005") == [
        (
            "AST005",
            "1",
            "'./shot.usdz[packed.vdb]' is compressed or encrypted in its package, where USD can't "
            "read it (1 of 2 samples)",
        ),
        (
            "LNT005",
            "2",
            "'./shot.usdz[inner.usdz[a.vdb]]' was not looked into: it lies in a package inside of "
            "its package (1 of 2 samples)",
        ),
    ]


def test_a_package_that_lies(tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("a.vdb", b"content")
    content = path.read_bytes()
    assert Package(str(path)).locate("a.vdb") == (30 + len("a.vdb"), len(b"content"))
    for name, broken in (
        ("b.vdb", content),
        ("a.vdb", content.replace(b"PK\3\4", b"PK\3\5")),
        ("a.vdb", content[:-10]),
        ("a.vdb", b""),
    ):
        path.write_bytes(broken)
        with pytest.raises(NotInPlaceError):
            Package(str(path)).locate(name)


@pytest.mark.parametrize(
    ("purpose", "expected"),
    [
        (
            "cloud",
            [
                (
                    "GRD005",
                    "fieldDataType is 'matrix3d', but grid 'density' in './a.f3d' holds float",
                ),
                (
                    "GRD009",
                    "'./a.f3d' holds 2 grids named 'density', and the field has no fieldIndex",
                ),
            ],
        ),
        (
            "nope",
            [
                (
                    "GRD003",
                    "no grid 'density' of 'nope' in './a.f3d', which holds 'cloud:density', "
                    "'cloud:temperature', 'cloud:heat', 'cloud:density', 'smoke:v', 'smoke:vh', "
                    "'smoke:vd'",
                )
            ],
        ),
    ],
)
def test_field3d(
    purpose: str, expected: list[tuple[str, str]], lint_text: Lint, tmp_path: Path
) -> None:
    """A partition is what fieldPurpose names, a layer what fieldName does."""
    (tmp_path / "a.f3d").write_bytes((SAMPLES / "f3d_ogawa.f3d").read_bytes())
    layer = (
        "asset filePath = @./a.f3d@",
        'token fieldName = "density"',
        'token fieldDataType = "matrix3d"',
        f'token fieldPurpose = "{purpose}"',
    )
    report = lint_text(stage(field("density", *layer, kind="Field3DAsset")))
    assert said(report) == [(code, None, message) for code, message in expected]


@pytest.mark.parametrize(
    ("name", "purpose", "suggestion"),
    [
        ("density", "clouds", "did you mean fieldPurpose 'cloud'?"),
        ("v", "cloud", "did you mean fieldPurpose 'smoke'?"),
        ("densty", "cloud", "did you mean 'density'?"),
    ],
)
def test_a_grid_of_another_purpose(
    name: str, purpose: str, suggestion: str | None, lint_text: Lint, tmp_path: Path
) -> None:
    (tmp_path / "a.f3d").write_bytes((SAMPLES / "f3d_ogawa.f3d").read_bytes())
    layer = (f'token fieldName = "{name}"', f'token fieldPurpose = "{purpose}"')
    more = ("asset filePath = @./a.f3d@", 'token fieldDataType = "float"', *layer)
    report = lint_text(stage(field("density", *more, kind="Field3DAsset")))
    [finding] = [each for each in report.findings if each.code == "GRD003"]
    assert finding.suggestion == suggestion


def test_field3d_without_h5py(
    lint_text: Lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "h5py", None)
    (tmp_path / "a.f3d").write_bytes((SAMPLES / "f3d_hdf5.f3d").read_bytes())
    report = lint_text(
        stage(field("density", "asset filePath = @./a.f3d@", *DENSITY[:2], kind="Field3DAsset"))
    )
    [(code, _, message)] = said(report, "GRD", "LNT")
    assert code == "LNT005"
    assert message.startswith("'./a.f3d' was not looked into: ")


def test_nanovdb_by_its_own_extension(lint_text: Lint, tmp_path: Path) -> None:
    """It is not what the schema asks for, which the extension says already."""
    (tmp_path / "a.nvdb").write_bytes((SAMPLES / "type_all_z.nvdb").read_bytes())
    report = lint_text(stage(field("density", "asset filePath = @./a.nvdb@", *DENSITY)))
    assert said(report, "GRD") == [
        (
            "GRD003",
            None,
            "no grid 'density' in './a.nvdb', which holds 'b', 'd', 'f', 'i32', 'i64', 'mask'",
        )
    ]
