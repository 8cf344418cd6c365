"""What is inside the files that fields name: what the rule pages can not show."""

from __future__ import annotations

import os
import random
import zipfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
import vdbwriter as w
from process import SAMPLES

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.volumefile import VolumeFile, VolumeFileError, cache, read_volume_file, window
from usdvol_lint.volumefile.cache import Reading, VolumeFiles
from usdvol_lint.volumefile.package import NotInPlaceError, Package

Lint = Callable[..., StageReport]
FOG = {"class": w.string("fog volume"), **w.bounds((1, 1, 1), (8, 8, 8))}


def grid(name: str = "density", kind: str = "float", **metadata: tuple[str, bytes]) -> w.Grid:
    entries = {**FOG, **metadata, "name": w.string(name)}
    small = w.scale(0.1, 0.1, 0.1, "UniformScaleMap")
    return w.Grid(name, f"Tree_{kind}_5_4_3", metadata=entries, transform=small)


def field(name: str, *statements: str, kind: str = "OpenVDBAsset") -> str:
    lines = "\n".join(f"        {statement}" for statement in statements)
    return f"""    rel field:{name} = </cloud/{name}>
    def {kind} "{name}"
    {{
{lines}
    }}
"""


DENSITY = (
    'token fieldName = "density"',
    'token fieldDataType = "float"',
    'token fieldClass = "fogVolume"',
)


def stage(*fields: str) -> str:
    extent = "    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n"
    return f'#usda 1.0\ndef Volume "cloud"\n{{\n{extent}{"".join(fields)}}}\n'


def density(*paths: str, **more: str) -> str:
    """A field whose frames are the files at these paths."""
    samples = "".join(f"\n{frame}: @{path}@," for frame, path in enumerate(paths, start=1))
    return field("density", f"asset filePath.timeSamples = {{{samples}\n}}", *DENSITY)


def said(report: StageReport, *families: str) -> list[tuple[str, str | None, str]]:
    return [
        (finding.code, finding.site.frames, finding.message)
        for finding in report.findings
        if finding.code.startswith(families or ("GRD", "LNT", "FLD001"))
    ]


def reading(path: Path) -> Reading:
    return VolumeFiles().read(str(path))


def engine(catalog: Catalog, content: str = "all") -> Engine:
    return Engine(catalog.rules, activate(Config(select=("ALL",)), catalog), Depth(content=content))


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each volume file was opened, and how often it was read from, by its name."""
    counts: Counter[str] = Counter()
    names: dict[int, str] = {}
    genuine_open, genuine_read = os.open, os.read

    def counting_open(path: str, flags: int) -> int:
        descriptor = genuine_open(path, flags)
        names[descriptor] = os.path.basename(path)
        counts[f"open {names[descriptor]}"] += 1
        return descriptor

    def counting_read(descriptor: int, count: int) -> bytes:
        counts[f"read {names[descriptor]}"] += 1
        return genuine_read(descriptor, count)

    monkeypatch.setattr(window.os, "open", counting_open)
    monkeypatch.setattr(window.os, "read", counting_read)
    return counts


# Each file once.


def test_a_file_is_read_once(catalog: Catalog, tmp_path: Path, opened: Counter[str]) -> None:
    """However many fields, frames and stages name it, and by whatever path."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid(), grid("heat")))
    (tmp_path / "link.vdb").symlink_to("a.vdb")
    heat = field("heat", "asset filePath = @./a.vdb@", 'token fieldName = "heat"', *DENSITY[1:])
    text = stage(density("./a.vdb", "./link.vdb", "./a.vdb"), heat)
    linter = engine(catalog)
    for name in ("one.usda", "two.usda"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        assert said(linter.lint(str(tmp_path / name))) == []
    assert opened["read a.vdb"] + opened["read link.vdb"] == 1
    assert opened == {"open a.vdb": 2, "open link.vdb": 2, "read a.vdb": 1}


def test_a_file_that_changed_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "a.vdb"
    files = VolumeFiles()
    path.write_bytes(w.vdb(grid()))
    first = files.read(str(path)).file
    path.write_bytes(w.vdb(grid("Density")))
    os.utime(path, ns=(1, 1))
    second = files.read(str(path)).file
    assert [file and file.grids[0].name for file in (first, second)] == ["density", "Density"]


def test_how_much_is_looked_into(catalog: Catalog, tmp_path: Path, opened: Counter[str]) -> None:
    for frame, name in enumerate(("Density", "density", "Density"), start=1):
        (tmp_path / f"{frame}.vdb").write_bytes(w.vdb(grid(name)))
    (tmp_path / "a.usda").write_text(stage(density("./gone.vdb", "./1.vdb", "./2.vdb", "./3.vdb")))
    found = {}
    for content in ("all", "first", "off"):
        found[content] = said(engine(catalog, content).lint(str(tmp_path / "a.usda")))
    message = "no grid 'density' in './1.vdb', which holds 'Density'"
    assert found == {
        "all": [
            ("GRD003", "2, 4", f"{message} (2 of 4 samples)"),
        ],
        "first": [("GRD003", "2", f"{message} (1 of 1 samples)")],
        "off": [],
    }
    assert opened["open 1.vdb"] == 2
    assert opened["open 2.vdb"] == 1


def test_without_a_look_nothing_is_known(catalog: Catalog, tmp_path: Path) -> None:
    """The only grid, which a field without a name misses, is named only where the file is read."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid()))
    unnamed = field("density", "asset filePath = @./a.vdb@", *DENSITY[1:])
    (tmp_path / "a.usda").write_text(stage(unnamed))
    for content, names_grid in (("all", True), ("first", True), ("off", False)):
        report = engine(catalog, content).lint(str(tmp_path / "a.usda"))
        [finding] = [each for each in report.findings if each.severity.label != "info"]
        assert (finding.code, "the only grid" in str(finding.suggestion)) == ("FLD001", names_grid)


# Recalled files.


def plainly(path: Path) -> VolumeFile | str:
    """What the reader itself says, as far as it is kept."""
    try:
        file = read_volume_file(str(path))
    except VolumeFileError as error:
        return str(error)
    grids = tuple(each._replace(metadata={}) for each in file.grids)
    return file._replace(uuid=None, metadata={}, grids=grids)


def as_kept(found: Reading) -> VolumeFile | str | None:
    return str(found.fault) if found.fault else found.file


def frame(number: int) -> bytes:
    low, high = (number, -number, 0), (number + 7, 7, number)
    stored = {
        **w.bounds(low, high),
        "file_delayed_load": ("__delayedload", bytes(number % 50)),
        "file_voxel_count": w.value("int64", number),
        "name": w.string("density"),
    }
    voxels = bytes(number % 13)
    return w.vdb(
        w.Grid("density", metadata=stored, voxels=voxels),
        w.Grid("heat", "Tree_float_5_4_3_HalfFloat", metadata={"name": w.string("heat")}),
        uuid=f"{number:036}".encode(),
        metadata_bytes=w.metadata({"creator": w.string("me"), "frame": w.value("int32", number)}),
    )


def test_frames_are_recalled_as_they_are(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    parsed = 0

    def counting(stretch: window.Window) -> VolumeFile:
        nonlocal parsed
        parsed += 1
        return genuine(stretch)

    genuine = cache.read_window
    monkeypatch.setattr(cache, "read_window", counting)
    layouts = set()
    for number in range(200):
        path.write_bytes(frame(number))
        found = files.read(str(path), 0, len(frame(number)))
        layouts.add(found.layout)
        assert as_kept(found) == plainly(path)
    assert parsed == 1
    assert len(layouts) == 1
    path.write_bytes(frame(-8))
    empty = files.read(str(path))
    assert as_kept(empty) == plainly(path)
    assert empty.file
    assert empty.file.grids[0].is_empty
    assert empty.layout not in layouts
    assert parsed == 1


def test_instances_have_the_bounds_of_their_own_frame(tmp_path: Path) -> None:
    """Also with other offsets than OpenVDB writes, by which instances are not recalled."""
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    for number in range(1, 4):
        shown = {"name": w.string("a"), **w.bounds((0, 0, 0), (number,) * 3)}
        instance = w.Grid("b", parent="a", offsets=lambda start, _, end: (start, end, end))
        path.write_bytes(w.vdb(w.Grid("a", metadata=shown), instance))
        os.utime(path, ns=(number, number))
        assert as_kept(files.read(str(path))) == plainly(path)


def test_bounds_may_be_told_twice(tmp_path: Path) -> None:
    """Those of the whole file are not those of its grid."""
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    for number in range(1, 4):
        own = {"name": w.string("a"), **w.bounds((0, 0, 0), (number,) * 3)}
        of_the_file = w.metadata(w.bounds((0, 0, 0), (5, 5, 5)))
        path.write_bytes(w.vdb(w.Grid("a", metadata=own), metadata_bytes=of_the_file))
        os.utime(path, ns=(number, number))
        assert as_kept(files.read(str(path))) == plainly(path)


def test_a_recalled_frame_may_lie(tmp_path: Path) -> None:
    """Whatever byte is another one, it is told as the reader tells it."""
    choose = random.Random(7)
    files, path = VolumeFiles(), tmp_path / "a.vdb"
    path.write_bytes(frame(3))
    files.read(str(path))
    for number in range(3000):
        content = bytearray(frame(choose.randrange(60)))
        for _ in range(choose.choice((1, 1, 2))):
            content[choose.randrange(len(content))] = choose.choice((0, 1, 0x7F, 0xFF))
        if choose.random() < 0.2:
            del content[choose.randrange(len(content)) :]
        path.write_bytes(content)
        os.utime(path, ns=(number, number))
        assert as_kept(files.read(str(path))) == plainly(path)


@pytest.mark.parametrize("path", sorted(SAMPLES.glob("*.[vnf]*")), ids=lambda path: path.name)
def test_samples_are_recalled_as_they_are(path: Path, tmp_path: Path) -> None:
    files = VolumeFiles()
    for copy in ("a", "b"):
        (tmp_path / copy).write_bytes(path.read_bytes())
        assert as_kept(files.read(str(tmp_path / copy))) == plainly(path)


# Packages.


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
            "'./text.vdb' is no volume file: it begins like no OpenVDB, NanoVDB or Field3D file "
            "(at byte 0) (1 of 5 samples)",
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


# Other formats.


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
        ("nothing", "cloud", None),
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


# Times.


def test_what_the_field_says_may_change_between_files(lint_text: Lint, tmp_path: Path) -> None:
    """A file holds until the next, and what the field says of it is held against it meanwhile."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid("a"), grid("b", "vec3s")))
    report = lint_text(
        stage(
            field(
                "density",
                "asset filePath = @./a.vdb@",
                'token fieldName.timeSamples = {\n1: "a",\n5: "b",\n9: "c",\n}',
                'token fieldDataType = "float"',
            )
        )
    )
    assert said(report) == [
        ("GRD003", "9", "no grid 'c' in './a.vdb', which holds 'a', 'b' (1 of 3 samples)"),
        (
            "GRD005",
            "5",
            "fieldDataType is 'float', but grid 'b' in './a.vdb' holds vec3s (1 of 3 samples)",
        ),
    ]


def test_one_fault_is_one_finding(lint_text: Lint, tmp_path: Path) -> None:
    """Numbers in what is wrong may differ from frame to frame."""
    whole = w.vdb(grid())
    for number in range(1, 101):
        (tmp_path / f"{number}.vdb").write_bytes(whole[: -number - 1] if number % 2 else whole)
    report = lint_text(stage(density(*(f"./{number}.vdb" for number in range(1, 101)))))
    [(code, frames, message)] = said(report)
    assert (code, frames) == ("GRD002", "1-99x2")
    assert message.endswith("(50 of 100 samples)")


def test_hostile_files_cost_neither_time_nor_memory(lint_text: Lint, tmp_path: Path) -> None:
    choose = random.Random(11)
    whole = w.vdb(grid(), grid("heat"))
    for number in range(300):
        content = bytearray(whole)
        content[choose.randrange(12, len(content) - 200)] = choose.randrange(256)
        (tmp_path / f"{number}.vdb").write_bytes(content)
    report = lint_text(stage(density(*(f"./{number}.vdb" for number in range(300)))))
    assert "LNT002" not in {finding.code for finding in report.findings}
    assert len(report.findings) < 60
    assert max(len(finding.message) for finding in report.findings) < 600


@pytest.mark.parametrize("index", ["bool fieldIndex = true", "double fieldIndex = 1"])
def test_an_index_that_is_no_integer_is_none(index: str, lint_text: Lint, tmp_path: Path) -> None:
    """Its type is a finding, and nobody looks for a second grid."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid("density")))
    text = stage(density("./a.vdb").replace("token fieldName", f"{index}\n token fieldName"))
    assert index in text
    assert said(lint_text(text), "GRD", "SCH003", "FLD003", "FLD007") == [
        (
            "SCH003",
            None,
            f"'{index.partition(' =')[0]}' where the schema declares 'int fieldIndex'",
        )
    ]


def test_names_of_any_bytes(lint_text: Lint, tmp_path: Path) -> None:
    """They are quoted, and the report can be written."""
    odd = w.Grid(b"d\xe9nsit\xe9", metadata={"name": w.string(b"d\xe9nsit\xe9")})
    (tmp_path / "a.vdb").write_bytes(w.vdb(odd, *(grid(f"g{n}" + "x" * 300) for n in range(20))))
    [(_, _, message)] = said(lint_text(stage(density("./a.vdb"))), "GRD003")
    assert "'d\\xe9nsit\\xe9'" in message
    assert message.encode()
    assert message.endswith("…', 14 more (1 of 1 samples)")


def test_third_party_fields_are_left_alone(lint_text: Lint, tmp_path: Path) -> None:
    """Nobody knows what files their types want."""
    (tmp_path / "a.nurec").write_bytes(b"nothing we know")
    report = lint_text(
        stage(field("density", "asset filePath = @./a.nurec@", kind="OmniNuRecFieldAsset"))
    )
    assert said(report, "GRD") == []
