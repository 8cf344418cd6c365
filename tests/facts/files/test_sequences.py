"""Sequences, and where paths lead: what the rule pages can not show."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path
from zipfile import ZipFile

import pytest
from process import ASSETS

from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.folders import Listing
from usdvol_lint.facts.files.numbering import Numbering, find_numbering
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]
CODES = ("AST006", "AST007", "AST008", "AST009", "AST011", "AST012", "AST013", "AST015")


def field(body: str, header: str = "", kind: str = "OpenVDBAsset") -> str:
    return (
        f'#usda 1.0\n{header}\ndef {kind} "density"\n{{\n    token fieldName = "density"\n'
        f"    {body}\n}}\n"
    )


def sampled(samples: Iterable[tuple[float, str]], header: str = "") -> str:
    lines = "".join(f"{time}: @{path}@,\n" for time, path in samples)
    return field(f"asset filePath.timeSamples = {{\n{lines}}}", header)


def numbered(numbers: Iterable[float], times: Iterable[float], name: str = "./s.{:04}.vdb") -> str:
    return sampled([(time, name.format(n)) for time, n in zip(times, numbers, strict=True)])


def write(folder: Path, *names: str) -> None:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ASSETS / "cloud.vdb", folder / name)


def said(report: StageReport, *codes: str) -> list[tuple[str, str | None, str, str | None]]:
    return [
        (finding.code, finding.site.frames, finding.message, finding.suggestion)
        for finding in report.findings
        if finding.code in (codes or CODES)
    ]


def frames(report: StageReport, code: str) -> list[str | None]:
    return [finding.site.frames for finding in report.findings if finding.code == code]


@pytest.mark.parametrize(
    ("paths", "numbers", "groups"),
    [
        (["./s.0001.vdb", "./s.0002.vdb"], [1, 2], (0,)),
        (["./s.0010.vdb", "./s.0020.vdb"], [10, 20], (0,)),
        (["./s.9.vdb", "./s.10.vdb", "./s.11.vdb"], [9, 10, 11], (0,)),
        (["v2/s_v003.0001.vdb", "v2/s_v003.0002.vdb"], [1, 2], (2,)),
        (["s.0001.v2.vdb", "s.0002.v2.vdb"], [1, 2], (0,)),
        (["s2.1.5.vdb", "s2.2.5.vdb"], [1, 2], (1,)),
        (["s.-0001.vdb", "s.0000.vdb", "s.0001.vdb"], [-1, 0, 1], (0,)),
        (["s.0001.00.vdb", "s.0001.25.vdb", "s.0002.00.vdb"], [1, 1.25, 2], (0,)),
        (["f1/s.1.vdb", "f2/s.2.vdb", "f3/s.3.vdb"], [1, 2, 3], (0, 1)),
        (["s1", "s2", "s3"], [1, 2, 3], (0,)),
        (["s.vdb", "s.vdb"], None, ()),
        (["a.vdb", "b.vdb"], None, ()),
        (["a1.vdb", "b2.vdb"], None, ()),
        (["", ""], None, ()),
        (["s.1_0.vdb", "s.1_1.vdb"], [0, 1], (1,)),
        (["s.٣.vdb", "s.٤.vdb"], None, ()),
    ],
)
def test_frame_numbers(paths: list[str], numbers: list[float] | None, groups: tuple[int]) -> None:
    assert find_numbering(paths) == (None if numbers is None else Numbering(numbers, groups))


def test_frame_numbers_of_most() -> None:
    """A few names that are otherwise do no harm, many leave no sequence."""
    paths = ["rest.vdb", *(f"s.{frame:04}.vdb" for frame in range(1, 8))]
    found = find_numbering(paths)
    assert found is not None
    assert str(found.numbers) == "[nan, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]"
    assert find_numbering(["rest.vdb"] * 4 + paths) is None


def test_missing_samples_with_some_of_their_files(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "s.0005.vdb", "s.0009.vdb")
    there = [1, 2, 3, 4, 7, 8, 10, 11, 12, 13]
    [finding] = said(lint_text(numbered(there, there)), "AST011")
    assert finding == (
        "AST011",
        "5-6, 9",
        "no samples at 5-6, 9, in a run that is regular otherwise (3 missing, 10 there)",
        "add 5: @./s.0005.vdb@, 9: @./s.0009.vdb@ (2 of 3 files are there)",
    )


def test_missing_samples_in_the_time_of_their_layer(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 7)))
    there = [1, 2, 3, 5, 6]
    (tmp_path / "fx.usda").write_text(numbered(there, there))
    report = lint_text("#usda 1.0\n(\n    subLayers = [@./fx.usda@ (offset = 100; scale = 2)]\n)\n")
    [finding] = [finding for finding in report.findings if finding.code == "AST011"]
    assert (finding.site.layer, finding.site.line, finding.site.frames) == ("fx.usda", 9, "108")
    assert finding.suggestion == "add 4: @./s.0004.vdb@ (the file is there)"


def test_missing_samples_that_no_layer_could_take(lint_text: Lint) -> None:
    """Nobody here knows which files a server has."""
    there = [1, 2, 3, 5, 6]
    report = lint_text(numbered(there, there, "omniverse://host/s.{:04}.vdb"))
    assert [(f[1], f[3]) for f in said(report, "AST011")] == [
        ("4", "add the samples, or write the frames that are missing")
    ]


@pytest.mark.parametrize(
    ("times", "numbers", "expected"),
    [
        pytest.param([1, 2, 3, 5, 6], None, "4", id="one"),
        pytest.param([1, 2, 3, 4, 6], None, "5", id="before the last"),
        pytest.param([1, 3, 4, 5, 6], None, None, id="after a rest frame"),
        pytest.param([1, 2, 3, 5, 7, 9, 10], None, None, id="a run of its own"),
        pytest.param([*range(1, 10), 11, 13, 15, *range(16, 22)], None, None, id="a retime inside"),
        pytest.param([1, 2, 3, 5, 6], [6, 5, 4, 2, 1], "4", id="backwards"),
        pytest.param([1, 2, 3, 5, 6], [1, 2, 3, 4, 5], None, id="held"),
        pytest.param([1, 2, 3, 5, 6], [1, 1, 1, 1, 2], None, id="mostly held"),
        pytest.param([1, 2, 3, 4.5, 5.5], None, None, id="shifted"),
        pytest.param([1, 2, 3, 1001, 1002, 1003], None, None, id="two ranges"),
        pytest.param([1, 1.25, 1.5, 2, 2.25], None, "1.75", id="sub-frames"),
        pytest.param([0.1, 0.2, 0.3, 0.5, 0.6], [1, 2, 3, 5, 6], "0.4", id="tenths"),
        pytest.param([2, 4, 8, 10, 12], [1, 2, 4, 5, 6], "6", id="stretched"),
        pytest.param([1, 2, 4, 7, 11], None, None, id="irregular"),
        pytest.param([1, 2, 4, 5], None, None, id="too few"),
    ],
)
def test_gaps(
    times: list[float], numbers: list[int] | None, expected: str | None, lint_text: Lint
) -> None:
    report = lint_text(numbered(numbers or times, times, "./s.{}.vdb"))
    assert frames(report, "AST011") == ([expected] if expected else [])


def test_strays_of_a_long_sequence(lint_text: Lint, tmp_path: Path) -> None:
    """Swapped at the end, one far off, and one whose proper file is not there."""
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 41) if frame != 30))
    numbers = list(range(1, 41))
    numbers[9], numbers[29], numbers[38], numbers[39] = 20, 7, 40, 39
    [finding] = said(lint_text(numbered(numbers, range(1001, 1041))), "AST013")
    assert finding == (
        "AST013",
        "1010, 1039-1040",
        "'./s.0020.vdb' is out of the order that the other file numbers keep (3 of 40 samples)",
        "did you mean './s.0010.vdb'?",
    )


@pytest.mark.parametrize(
    ("numbers", "expected"),
    [
        pytest.param([1, 2, 3, 9, 5, 6], ["4"], id="typo"),
        pytest.param([1, 2, 3, 9, 5], [], id="too few in line"),
        pytest.param([1, 2, 3, 4, 5, 9], [], id="last"),
        pytest.param([9, 2, 3, 4, 5, 6], [], id="first"),
        pytest.param([2, 1, 3, 4, 5, 6, 7], ["1-2"], id="first two changed places"),
        pytest.param([1, 2, 3, 9, 8, 7, 7, 8, 9, 10], [], id="many"),
        pytest.param([1, 1, 1, 1, 1, 2, 1, 1], [], id="held but for one"),
    ],
)
def test_strays(numbers: list[int], expected: list[str], lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 11)))
    assert frames(lint_text(numbered(numbers, range(1, len(numbers) + 1))), "AST013") == expected


def test_strays_at_another_pace(lint_text: Lint, tmp_path: Path) -> None:
    """Thirds of a frame do not add up, and are no strays."""
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 41)))
    numbers = list(range(1, 41))
    times = [100_000 + number * 3 for number in numbers]
    assert frames(lint_text(numbered(numbers, times)), "AST013") == []
    numbers[19] = 3
    assert frames(lint_text(numbered(numbers, times)), "AST013") == ["100060"]
    times = [round(frame / 3, 9) for frame in range(1, 41)]
    assert frames(lint_text(numbered(numbers, times)), "AST013") == ["6.666667"]


def test_a_stray_that_may_be_anywhere(lint_text: Lint) -> None:
    report = lint_text(numbered([1, 2, 3, 9, 5, 6], range(1, 7), "omniverse://host/s.{:04}.vdb"))
    assert [(f[1], f[3]) for f in said(report, "AST013")] == [
        ("4", "did you mean 'omniverse://host/s.0004.vdb'?")
    ]


def test_the_range_in_words(lint_text: Lint) -> None:
    header = "(\n    startTimeCode = 1001\n    endTimeCode = 1100\n)"
    samples = [(float(frame), f"./s.{frame:04}.vdb") for frame in range(1, 101)]
    [outside] = said(lint_text(sampled(samples, header)), "AST012")
    assert outside[2:] == (
        "the samples are at 1-100, the stage's range is 1001-1100: one file is held throughout",
        "if they are to begin with the stage, move them by 1000 with the layer offset of the "
        "sublayer, reference or payload",
    )
    inside = [(1009 + time, path) for time, path in samples[:50]]
    [held] = said(lint_text(sampled(inside, header)), "AST012")
    assert held[2] == (
        "the samples are at 1010-1059, the stage's range is 1001-1100: the first file is held "
        "until 1010 and the last file is held from 1059 on"
    )


def test_a_range_that_ends_before_it_begins_is_none(lint_text: Lint) -> None:
    header = "(\n    startTimeCode = 10\n    endTimeCode = 1\n)"
    samples = [(float(frame), f"./s.{frame:04}.vdb") for frame in range(20, 23)]
    assert said(lint_text(sampled(samples, header)), "AST012") == []
    one_frame = header.replace("10", "1")
    assert len(said(lint_text(sampled(samples, one_frame)), "AST012")) == 1


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


def test_clips_have_times_of_their_own(lint_text: Lint, tmp_path: Path) -> None:
    """Gaps are those of the stage, and there is nothing to paste into one layer."""
    write(tmp_path, *(f"s.{frame:04}.vdb" for frame in range(1, 9)))
    there = [1, 2, 3, 4, 6, 7, 8]
    samples = "".join(f"{frame}: @./s.{frame:04}.vdb@,\n" for frame in there)
    (tmp_path / "clip.usda").write_text(
        f'#usda 1.0\nover "density"\n{{\n    asset filePath.timeSamples = {{\n{samples}}}\n}}\n'
    )
    report = lint_text(
        """#usda 1.0
def OpenVDBAsset "density" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./clip.usda@]
            string primPath = "/density"
            double2[] active = [(101, 0)]
            double2[] times = [(101, 1), (108, 8)]
        }
    }
)
{
}
"""
    )
    assert [(f[0], f[1], f[3]) for f in said(report)] == [
        ("AST011", "105", "add the samples, or write the frames that are missing")
    ]
