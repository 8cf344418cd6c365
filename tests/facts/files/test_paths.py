"""Where paths lead: extensions, absolute and malformed paths, letter case, packages."""

from __future__ import annotations

import os
from pathlib import Path
from zipfile import ZipFile

import pytest
from fieldtexts import CODES, Lint, field, frames, said, sampled, write
from process import ASSETS

from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.folders import Listing


@pytest.mark.parametrize(
    ("name", "advice"),
    [
        ("vdb.vdb", []),
        ("VDB.VDB", []),
        ("f3d.f3d", ["name a '.vdb' file, or make the prim a Field3DAsset"]),
        ("nvdb.nvdb", ["write it as '.vdb' for renderers that read OpenVDB alone"]),
        ("abc.abc", ["name a '.vdb' file"]),
        ("plain", ["name a '.vdb' file"]),
    ],
)
def test_extensions(name: str, advice: list[str], lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, name)
    assert [
        f[3] for f in said(lint_text(field(f"asset filePath = @./{name}@")), "AST006")
    ] == advice


@pytest.mark.parametrize("name", ["vdb.vdb", "f3d.f3d", "nvdb.nvdb", "plain"])
def test_extensions_of_openvdb_files_on_a_field3d_field(
    name: str, lint_text: Lint, tmp_path: Path
) -> None:
    write(tmp_path, name)
    report = lint_text(field(f"asset filePath = @./{name}@", kind="Field3DAsset"))
    advice = [] if name == "f3d.f3d" else ["name a '.f3d' file, or make the prim an OpenVDBAsset"]
    assert [f[3] for f in said(report, "AST006")] == advice


def test_absolute_paths_below_their_layer(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "cache/a.vdb")
    path = (tmp_path / "cache" / "a.vdb").as_posix()
    assert said(lint_text(field(f"asset filePath = @{path}@"))) == [
        (
            "AST007",
            None,
            f"{path!r} is an absolute path",
            "name it in relation to the layer: './cache/a.vdb'",
        )
    ]


def test_names_that_only_look_malformed(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "my cache/my cloud.vdb", "~/a.vdb", "~b.vdb", "a.vdb~1.vdb")
    for path in ("./my cache/my cloud.vdb", "~/a.vdb", "~b.vdb", "./a.vdb~1.vdb"):
        assert said(lint_text(field(f"asset filePath = @{path}@"))) == []


@pytest.mark.skipif(os.name == "nt", reason="no such names on Windows")
def test_names_that_linux_alone_can_have(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "a\\b.vdb", "c.vdb ")
    for path in ("./a\\b.vdb", "./c.vdb "):
        assert "AST008" in [f[0] for f in said(lint_text(field(f"asset filePath = @{path}@")))]


@pytest.mark.parametrize(
    ("path", "message", "suggestion"),
    [
        (
            "C:\\x\\a.vdb ",
            "begins with a drive letter, which only Windows has, and has backslashes, which "
            "separate names on Windows alone, and begins or ends with a blank",
            "name it in relation to the layer, with '/' between names",
        ),
        (
            "\\\\server\\a.vdb",
            "has backslashes, which separate names on Windows alone",
            "name it in relation to the layer, with '/' between names",
        ),
        (
            "~bob/a.vdb",
            "begins with '~', which USD does not expand",
            "name it in relation to the layer, with '/' between names",
        ),
        (
            " x\\a.vdb",
            "has backslashes, which separate names on Windows alone, and begins or ends with a "
            "blank",
            "write it as 'x/a.vdb', where no file is either",
        ),
    ],
)
def test_what_is_malformed(path: str, message: str, suggestion: str, lint_text: Lint) -> None:
    found = said(lint_text(field(f"asset filePath = @{path}@")), "AST008")
    assert [(f[2], f[3]) for f in found] == [
        (f"'{path}' {message}, so no file is found", suggestion)
    ]


@pytest.mark.skipif(os.name == "nt", reason="finds the file in any case")
def test_a_file_that_is_missing_by_its_case_alone(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "Cache/v1/Smoke.0001.vdb", "Cache/v1/smoke.0002.vdb")
    for path, meant in {
        "./cache/V1/smoke.0001.VDB": "./Cache/v1/Smoke.0001.vdb",
        "cache/v1/Smoke.0001.vdb": "Cache/v1/Smoke.0001.vdb",
        "./x/../cache/v1/smoke.0002.vdb": "./x/../Cache/v1/smoke.0002.vdb",
        "./Cache/v1/SMOKE.0002.vdb:SDF_FORMAT_ARGS:a=b": "./Cache/v1/smoke.0002.vdb",
    }.items():
        report = lint_text(field(f"asset filePath = @{path}@"))
        assert [f[3] for f in said(report, "AST002", "AST009")] == [f"write it as {meant!r}"]


def test_case_where_the_file_system_ignores_it(
    lint_text: Lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As on Windows and macOS: what resolves is held against what the folders list."""
    write(tmp_path, "cache/smoke.0001.vdb", "cache/smoke.0002.vdb")
    listings = {
        str(tmp_path): ("Cache",),
        str(tmp_path / "cache"): ("smoke.0001.vdb", "Smoke.0002.vdb"),
        str(tmp_path / "Cache"): ("smoke.0001.vdb", "Smoke.0002.vdb"),
    }
    monkeypatch.setattr(Disk, "listing", lambda self, folder: Listing(listings.get(folder, ())))
    names = ["./cache/smoke.0001.vdb", "./cache/smoke.0002.vdb"]
    stage = sampled(enumerate(names, start=1))
    assert said(lint_text(stage)) == []
    monkeypatch.setattr(Disk, "ignores_case", lambda self, path: True)
    assert said(lint_text(stage)) == [
        (
            "AST009",
            "1-2",
            "'./cache/smoke.0001.vdb' is './Cache/smoke.0001.vdb' on disk, in another case "
            "(2 of 2 samples)",
            "write it as './Cache/smoke.0001.vdb'",
        )
    ]
    listings[str(tmp_path)] = ("cache",)
    assert frames(lint_text(stage), "AST009") == ["2"]


def test_a_folder_says_whether_it_ignores_case(tmp_path: Path) -> None:
    write(tmp_path, "a.vdb")
    other = (tmp_path / "A.VDB").exists()
    assert Disk().ignores_case(str(tmp_path / "a.vdb")) is other
    assert Disk().ignores_case("/nope/a.vdb") is False
    assert Disk().ignores_case("/nope/p.usdz[a.vdb]") is False


def test_packages(lint_text: Lint, tmp_path: Path) -> None:
    """A package as the stage: names inside it, outside it, and in another case."""
    write(tmp_path, "beside.vdb")
    for path, expected in {
        "./vdb/in.vdb": [],
        "vdb/in.vdb": [],
        "beside.vdb": ["AST015"],
        "../beside.vdb": ["AST015"],
        "/nope/absolute.vdb": ["AST015"],
        "./VDB/in.vdb": ["AST009"],
        "https://host/a.vdb": [],
        f"{tmp_path.as_posix()}/shot.usdz[vdb/in.vdb]": ["AST007"],
    }.items():
        with ZipFile(tmp_path / "shot.usdz", "w") as package:
            package.writestr("root.usda", field(f"asset filePath = @{path}@"))
            package.write(ASSETS / "cloud.vdb", "vdb/in.vdb")
        report = lint_text("#usda 1.0\n(\n    subLayers = [@./shot.usdz@]\n)\n")
        assert [f.code for f in report.findings if f.code in (*CODES, "AST002")] == expected


def test_what_a_package_stage_names_in_layers_outside_it(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "fx/cloud.vdb")
    (tmp_path / "fx" / "fx.usda").write_text(field("asset filePath = @./cloud.vdb@"))
    layer = (tmp_path / "fx" / "fx.usda").as_posix()
    with ZipFile(tmp_path / "shot.usdz", "w") as package:
        package.writestr("root.usda", f"#usda 1.0\n(\n    subLayers = [@{layer}@]\n)\n")
    lint_text("#usda 1.0\n", "other.usda")
    from usdvol_lint.config import Config
    from usdvol_lint.engine.engine import Engine
    from usdvol_lint.packs.activation import activate
    from usdvol_lint.packs.catalog import load

    catalog = load()
    engine = Engine(catalog.rules, activate(Config(select=("ALL",)), catalog))
    assert frames(engine.lint("shot.usdz"), "AST015") == [None]
