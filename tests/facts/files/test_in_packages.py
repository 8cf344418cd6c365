"""Files in packages: a package is a tree of folders, in which one looks as on disk."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from zipfile import ZipFile

import pytest
from process import ASSETS

from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding, StageReport

Lint = Callable[..., StageReport]
WRITE = "write or copy it there, or name a file that is there"
PUFF = (ASSETS / "puff/puff.0001.vdb").read_bytes()
ROOT = """#usda 1.0
(
    endTimeCode = 5
    startTimeCode = 1
)
def Volume "smoke"
{{
    float3[] extent = [(-9, -9, -9), (9, 9, 9)]
    rel field:density = </smoke/density>

    def OpenVDBAsset "density"
    {{
        asset filePath{value}
        token fieldName = "density"
        token fieldDataType = "float"
    }}
}}
"""


def pack(folder: Path, value: str, *names: str) -> str:
    """Writes a package in which a field has a value, beside volume files of these names."""
    with ZipFile(folder / "shot.usdz", "w") as archive:
        archive.writestr("root.usda", ROOT.format(value=value))
        for name in names:
            archive.writestr(name, PUFF)
    return str(folder / "shot.usdz")


def five(folder: str = "") -> list[str]:
    return [f"{folder}puff.{number:04}.vdb" for number in range(1, 6)]


def of_code(report: StageReport, code: str) -> list[Finding]:
    return [finding for finding in report.findings if finding.code == code]


@pytest.mark.parametrize("folder", ["", "caches/", "take/"])
def test_a_frame_that_is_held_in_a_package(folder: str, engine: Engine, tmp_path: Path) -> None:
    package = pack(tmp_path, f" = @./{folder}puff.0003.vdb@", *five(folder))
    [finding] = of_code(engine.lint(package), "AST017")
    path = f"./{folder}puff"
    assert (finding.severity.label, finding.message, finding.suggestion) == (
        "warning",
        f"'{path}.0003.vdb' is held at all times, though the files 1-5 lie beside it "
        "and the stage's range is 1-5",
        f"author filePath.timeSamples = {{ 1: @{path}.0001.vdb@, 2: @{path}.0002.vdb@, "
        f"3: @{path}.0003.vdb@, 4: @{path}.0004.vdb@, 5: @{path}.0005.vdb@ }}",
    )


def test_samples_that_all_name_one_file_of_a_package(engine: Engine, tmp_path: Path) -> None:
    samples = ".timeSamples = { 1: @./c/puff.0001.vdb@, 2: @./c/puff.0001.vdb@ }"
    [finding] = of_code(engine.lint(pack(tmp_path, samples, *five("c/"))), "AST017")
    assert finding.message.startswith("all samples name './c/puff.0001.vdb', though the files 1-5")


def test_a_path_into_a_package(lint_text: Lint, tmp_path: Path) -> None:
    pack(tmp_path, " = @./a/puff.0001.vdb@", *five("a/"))
    text = ROOT.format(value=" = @./shot.usdz[a/puff.0001.vdb]@")
    [finding] = of_code(lint_text(text), "AST017")
    assert "{ 1: @./shot.usdz[a/puff.0001.vdb]@, 2: @./shot.usdz[a/puff.0002.vdb]@" in (
        finding.suggestion or ""
    )


@pytest.mark.parametrize(
    "names",
    [
        ["c/puff.0003.vdb"],
        ["c/puff.0003.vdb", *five("d/")],
        ["c/puff.0003.vdb", *five()],
        ["c/puff.0003.vdb", *five("c/old/")],
    ],
)
def test_what_lies_in_other_folders_of_a_package_is_no_sequence(
    names: list[str], engine: Engine, tmp_path: Path
) -> None:
    report = engine.lint(pack(tmp_path, " = @./c/puff.0003.vdb@", *names))
    assert of_code(report, "AST017") == []


@pytest.mark.parametrize(
    ("path", "names", "advice"),
    [
        ("./cache_v2/puff.0001.vdb", ["cache_v1/puff.0001.vdb"], "./cache_v1/puff.0001.vdb"),
        ("./fx/cache_v2/a.vdb", ["fx/cache_v1/a.vdb", "cache_v3/a.vdb"], "./fx/cache_v1/a.vdb"),
        ("./cahce/a.vdb", ["cache/a.vdb"], "./cache/a.vdb"),
        ("./new/a.vdb", ["old/a.vdb", "old/b.vdb"], "./old/a.vdb"),
        ("./b/a.vdb", ["b/other.vdb", "c/a.vdb"], "./c/a.vdb"),
        ("./b/a.0001.vdb", ["b/other.vdb", "caches/a.0001.vdb"], None),
        ("./a.vdb", ["old/a.vdb", "olda.vdb"], None),
        ("./new/a.vdb", ["old/deep/a.vdb"], None),
        ("./new/a.vdb", ["old/smaa.vdb"], None),
    ],
)
def test_files_that_moved_in_a_package(
    path: str, names: list[str], advice: str | None, engine: Engine, tmp_path: Path
) -> None:
    [finding] = of_code(engine.lint(pack(tmp_path, f" = @{path}@", *names)), "AST002")
    assert finding.suggestion == (f"did you mean '{advice}'?" if advice else WRITE)


def test_files_that_may_have_moved_to_several_folders(engine: Engine, tmp_path: Path) -> None:
    names = ["cache_v1/a.vdb", "cache_v3/a.vdb"]
    [finding] = of_code(engine.lint(pack(tmp_path, " = @./old/a.vdb@", *names)), "AST002")
    assert finding.suggestion in {
        f"there are files of that name at './{first}', './{second}'"
        for first, second in (names, names[::-1])
    }


def test_a_path_into_a_package_whose_file_has_moved(lint_text: Lint, tmp_path: Path) -> None:
    pack(tmp_path, "", "cache_v1/a.vdb")
    text = ROOT.format(value=" = @./shot.usdz[cache_v2/a.vdb]@")
    [finding] = of_code(lint_text(text), "AST002")
    assert finding.suggestion == "did you mean './shot.usdz[cache_v1/a.vdb]'?"
