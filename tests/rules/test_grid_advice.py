"""What findings about the content of files say and advise in each of their cases."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import vdbwriter
from process import ROOT

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]
ASSETS = ROOT / "rules" / "assets"
FIELD3D = ROOT / "tests" / "samples" / "f3d_ogawa.f3d"
FLOAT = 'token fieldDataType = "float"'
FOG = 'token fieldClass = "fogVolume"'

Case = tuple[str, str, tuple[str, ...], str, str, str]


def stage(path: str, name: str, *lines: str) -> str:
    kind = "Field3DAsset" if path.endswith(".f3d") else "OpenVDBAsset"
    body = "\n        ".join((f"asset filePath = @{path}@", f'token fieldName = "{name}"', *lines))
    return f"""#usda 1.0
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:data = </cloud/data>
    def {kind} "data"
    {{
        {body}
    }}
}}
"""


CASES: list[Case] = [
    (
        "grids/no_grids.vdb",
        "density",
        (FLOAT,),
        "GRD003",
        "which holds no grids",
        "export it again with a grid 'density', without",
    ),
    ("cloud.vdb", "densty", (FLOAT,), "GRD003", "'density', 'temperature'", "did you mean 'dens"),
    (
        "cloud.vdb",
        "xyz",
        (FLOAT,),
        "GRD003",
        "no grid 'xyz' in './cloud.vdb', which",
        "set fieldName to a grid that is there, or export a grid 'xyz'",
    ),
    (
        "grids/split_velocity.vdb",
        "vel",
        ('token fieldDataType = "float3"',),
        "GRD003",
        "which holds 'vel.x', 'vel.y', 'vel.z'",
        "'vel' is split into 'vel.x', 'vel.y', 'vel.z': write it as one vector",
    ),
    (
        "x.f3d",
        "dens",
        (FLOAT, 'token fieldPurpose = "cloud"'),
        "GRD003",
        "no grid 'dens' of 'cloud' in './x.f3d', which",
        "set fieldName to a grid that is there, or export a grid 'dens'",
    ),
    (
        "x.f3d",
        "density",
        (FLOAT, 'token fieldPurpose = "cluod"'),
        "GRD003",
        "no grid 'density' of 'cluod' in './x.f3d', which",
        "did you mean fieldPurpose 'cloud'?",
    ),
    (
        "grids/same_name.vdb",
        "density",
        (FLOAT, "int fieldIndex = 2"),
        "GRD004",
        "holds 2 grids named 'density'",
        "count from 0: the last one is 1",
    ),
    (
        "cloud.vdb",
        "density",
        (FLOAT, "int fieldIndex = 1"),
        "GRD004",
        "holds 1 grid named 'density'",
        "count from 0: the last one is 0",
    ),
    (
        "grids/half.vdb",
        "density",
        ('token fieldDataType = "int"',),
        "GRD005",
        "holds float, saved as half",
        "author fieldDataType 'float'",
    ),
    ("grids/double.vdb", "density", (FLOAT,), "GRD005", "holds double", "fieldDataType 'double'"),
    (
        "grids/points.vdb",
        "points",
        (FLOAT,),
        "GRD005",
        "holds ptdataidx32",
        "remove it: no fieldDataType stands for ptdataidx32",
    ),
    (
        "grids/unclassed.vdb",
        "density",
        (FLOAT, FOG),
        "GRD006",
        "does not say its class",
        "set the class",
    ),
    (
        "grids/level_set.vdb",
        "density",
        (FLOAT, FOG),
        "GRD006",
        "is of class 'level set'",
        "author fieldClass 'levelSet', or correct the grid",
    ),
    ("grids/text.vdb", "density", (FLOAT,), "GRD001", "is not a volume file: its first", "copy it"),
    (
        "grids/broken.vdb",
        "density",
        (FLOAT,),
        "GRD001",
        "is broken: the offsets",
        "write or copy it",
    ),
    ("grids/nanovdb.vdb", "density", (FLOAT,), "GRD001", "NanoVDB file, which some", "convert it"),
    ("odd.vdb", "density", (FLOAT,), "GRD001", "is a Field3D file, but", "convert it"),
    (
        "x.f3d",
        "density",
        (FLOAT,),
        "GRD009",
        "holds 2 grids named 'density', and the field has no fieldIndex",
        "author the fieldIndex that is meant",
    ),
    (
        "two.f3d",
        "v",
        ('token fieldDataType = "double"',),
        "GRD009",
        "holds grids named 'v' in 'cloud', 'smoke'",
        "author the fieldPurpose that is meant",
    ),
    (
        "grids/version_226.vdb",
        "density",
        (FLOAT,),
        "GRD010",
        "226 is newer than 225",
        "write it again with the",
    ),
    (
        "grids/version_221.vdb",
        "density",
        (FLOAT,),
        "GRD010",
        "221 is older than 222",
        "open it with",
    ),
    (
        "grids/truncated.vdb",
        "density",
        (FLOAT, "int fieldIndex = 3"),
        "GRD002",
        "is cut off: grid 'density' ends at byte",
        "write it again, or copy it again",
    ),
    ("grids/truncated.vdb", "heat", (FLOAT,), "GRD002", "is cut off", "write it again"),
]


@pytest.mark.parametrize(
    ("path", "name", "lines", "code", "message", "advice"),
    [pytest.param(*case, id=f"{case[3]}-{case[0]}-{case[1]}") for case in CASES],
)
def test_contents(
    path: str,
    name: str,
    lines: tuple[str, ...],
    code: str,
    message: str,
    advice: str,
    lint_text: Lint,
    tmp_path: Path,
) -> None:
    """One finding about the content, whatever else is said of the field."""
    shutil.copytree(ASSETS, tmp_path, dirs_exist_ok=True)
    shutil.copy(FIELD3D, tmp_path / "x.f3d")
    shutil.copy(FIELD3D, tmp_path / "odd.vdb")
    heat_is_v = FIELD3D.read_bytes().replace(b"\4" + bytes(7) + b"heat", b"\1" + bytes(7) + b"vxxx")
    (tmp_path / "two.f3d").write_bytes(heat_is_v)
    report = lint_text(stage(f"./{path}", name, *lines))
    [finding] = [finding for finding in report.findings if finding.code.startswith("GRD")]
    assert finding.code == code
    assert message in finding.message
    assert ("saved as half" in finding.message) == ("saved as half" in message)
    assert advice in (finding.suggestion or "")
    assert bool(finding.suggestion) == bool(advice)
    assert (" of 'cloud'" in finding.message) == (" of 'cloud'" in message)


def test_a_name_that_tells_no_format(lint_text: Lint, tmp_path: Path) -> None:
    """It makes no stranger of a file that is what the field wants."""
    shutil.copy(ASSETS / "cloud.vdb", tmp_path / "cloud.cache")
    report = lint_text(stage("./cloud.cache", "density", FLOAT))
    assert [f.code for f in report.findings if f.code.startswith(("GRD", "AST"))] == ["AST006"]


def test_of_a_broken_file_nothing_else_is_said(lint_text: Lint, tmp_path: Path) -> None:
    broken = vdbwriter.Grid("heat", offsets=lambda grid, block, end: (block, grid, end))
    (tmp_path / "fog.vdb").write_bytes(vdbwriter.vdb(vdbwriter.Grid(), broken))
    report = lint_text(stage("./fog.vdb", "density", 'token fieldDataType = "int"'))
    assert [f.code for f in report.findings if f.code.startswith("GRD")] == ["GRD001"]


def test_openvdb_knows_no_purpose(lint_text: Lint, tmp_path: Path) -> None:
    """What the field says of it is no reason to miss the grid; its file is AST006."""
    shutil.copy(ASSETS / "cloud.vdb", tmp_path)
    text = stage("./cloud.vdb", "density", FLOAT, 'token fieldPurpose = "smoke"')
    report = lint_text(text.replace("OpenVDBAsset", "Field3DAsset"))
    assert [f.code for f in report.findings if f.code.startswith(("GRD", "AST"))] == ["AST006"]


@pytest.mark.parametrize(("count", "end"), [(8, "'g6', 'g7'"), (9, "'g6', 2 more")])
def test_grids_that_are_listed(count: int, end: str, lint_text: Lint, tmp_path: Path) -> None:
    grids = (vdbwriter.Grid(f"g{number}") for number in range(count))
    (tmp_path / "fog.vdb").write_bytes(vdbwriter.vdb(*grids))
    report = lint_text(stage("./fog.vdb", "density", FLOAT))
    [finding] = [finding for finding in report.findings if finding.code == "GRD003"]
    assert finding.message.endswith(end)


def test_the_grid_that_the_index_means(lint_text: Lint, tmp_path: Path) -> None:
    grids = vdbwriter.Grid(), vdbwriter.Grid("density\x1e1", "Tree_double_5_4_3")
    (tmp_path / "fog.vdb").write_bytes(vdbwriter.vdb(*grids))
    report = lint_text(stage("./fog.vdb", "density", FLOAT, "int fieldIndex = 1"))
    assert "GRD005" in {finding.code for finding in report.findings}
    report = lint_text(stage("./fog.vdb", "density", FLOAT, "int fieldIndex = 0"))
    assert "GRD005" not in {finding.code for finding in report.findings}


def test_a_frame_without_grids_hides_no_other(lint_text: Lint, tmp_path: Path) -> None:
    shutil.copytree(ASSETS, tmp_path, dirs_exist_ok=True)
    text = stage("./cloud.vdb", "density", FLOAT).replace("(1, 1, 1)", "(0.1, 0.1, 0.1)")
    samples = "filePath.timeSamples = { 1: @./cloud.vdb@, 2: @./grids/no_grids.vdb@ }"
    report = lint_text(text.replace("filePath = @./cloud.vdb@", samples))
    assert "VOL013" in {finding.code for finding in report.findings}


@pytest.mark.parametrize(
    ("code", "one", "other", "lines"),
    [
        ("FLD001", "grids/unnamed.vdb", "cloud.vdb", (FLOAT,)),
        ("FLD002", "grids/points.vdb", "smoke/smoke.0001.vdb", ()),
    ],
)
def test_what_one_frame_leaves_open(
    code: str, one: str, other: str, lines: tuple[str, ...], lint_text: Lint, tmp_path: Path
) -> None:
    """A field may be silent only where every one of its files speaks for it."""
    shutil.copytree(ASSETS, tmp_path, dirs_exist_ok=True)
    for second, found in ((one, False), (other, True)):
        text = stage("./x.vdb", "", *lines)
        samples = f"filePath.timeSamples = {{ 1: @./{one}@, 2: @./{second}@ }}"
        report = lint_text(text.replace("filePath = @./x.vdb@", samples))
        assert (code in {finding.code for finding in report.findings}) == found


def test_the_only_grid_of_one_file_is_none_where_another_has_several(
    lint_text: Lint, tmp_path: Path
) -> None:
    shutil.copytree(ASSETS, tmp_path, dirs_exist_ok=True)
    samples = "filePath.timeSamples = { 1: @./grids/unnamed.vdb@, 2: @./cloud.vdb@ }"
    report = lint_text(stage("./x.vdb", "", FLOAT).replace("filePath = @./x.vdb@", samples))
    [found] = [finding for finding in report.findings if finding.code == "FLD001"]
    assert found.message == "fieldName is empty"
