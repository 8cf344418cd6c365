"""What the pages of rules/grid say of USD and of OpenVDB, asked of both."""

from __future__ import annotations

from pathlib import Path

import pytest
from answers import Said, stage
from libraries import asked, printed, with_nanovdb, with_openvdb, with_vdb_print
from process import ASSETS, SAMPLES
from pxr import UsdVol

FIELD = 'def OpenVDBAsset "d"\n{\n    asset filePath = @%s@\n}\n'
GRIDS = ASSETS / "grids"


def allowed(name: str) -> list[str]:
    """The tokens that the schema allows for an attribute of a field."""
    definition = stage(FIELD % "a.vdb").GetPrimAtPath("/d").GetPrimDefinition()
    return list(definition.GetPropertyMetadata(name, "allowedTokens"))


def test_GRD001_usd_never_opens_the_file() -> None:
    with Said() as said:
        field = stage(FIELD % (GRIDS / "text.vdb")).GetPrimAtPath("/d")
        path = UsdVol.OpenVDBAsset(field).GetFilePathAttr().Get()
    assert said == []
    assert Path(path.resolvedPath) == GRIDS / "text.vdb"


def test_GRD001_the_first_bytes_of_openvdb() -> None:
    assert (ASSETS / "cloud.vdb").read_bytes().startswith(b" BDV")


@with_vdb_print
@pytest.mark.parametrize("name", ["nanovdb.vdb", "text.vdb"])
def test_GRD001_openvdb_refuses_other_files(name: str) -> None:
    assert "not a VDB file" in printed("vdb_print", GRIDS / name)


@with_openvdb
def test_GRD002_only_reading_the_voxels_fails(tmp_path: Path) -> None:
    cut = tmp_path / "cut.vdb"
    cut.write_bytes((ASSETS / "cloud.vdb").read_bytes()[:-100])
    listed = "[grid.name for grid in pyopenvdb.readAllGridMetadata(path)]"
    assert asked(cut, listed) == ["density", "temperature"]
    voxels = "tried(lambda: pyopenvdb.read(path, %r).activeVoxelCount())"
    assert asked(cut, voxels % "density") == 33
    assert asked(cut, voxels % "temperature") == "Expected to decompress 132 bytes, got -1 bytes"


NAMESAKE = "tried(lambda: pyopenvdb.readGridMetadata(path, %r)['ord'])"
"""The sample's four grids named `density` are numbered in its order by metadata."""


@with_openvdb
def test_GRD004_grids_of_a_name_are_counted_from_0() -> None:
    found = [asked(SAMPLES / "dup_names.vdb", NAMESAKE % f"density[{number}]") for number in (0, 3)]
    assert found == [0, 3]


@with_openvdb
def test_GRD004_beyond_them_there_is_none() -> None:
    said = asked(SAMPLES / "dup_names.vdb", NAMESAKE % "density[4]")
    assert 'has no grid named "density[4]"' in said


def test_GRD005_no_data_type_stands_for_points() -> None:
    assert not [token for token in allowed("fieldDataType") if "point" in token.lower()]


@with_openvdb
def test_GRD005_saved_as_half_it_is_float_in_memory() -> None:
    grid = "[(grid.valueTypeName, grid.saveFloatAsHalf) for grid in {}]"
    grids = grid.format("pyopenvdb.readAllGridMetadata(path)")
    assert asked(SAMPLES / "half_f.vdb", grids) == [["float", True]]


@with_openvdb
def test_GRD007_what_openvdb_calls_the_roles() -> None:
    kinds = "{kind: getattr(pyopenvdb.VectorType, kind) for kind in pyopenvdb.VectorType.keys()}"
    assert set(asked(SAMPLES, kinds).values()) == {
        "invariant",
        "covariant",
        "covariant normalize",
        "contravariant relative",
        "contravariant absolute",
    }
    said = " ".join(asked(SAMPLES, "pyopenvdb.VectorType.__doc__").split())
    for kind, example in (
        ("COVARIANT_NORMALIZE", "unit normal"),
        ("CONTRAVARIANT_RELATIVE", "displacement, velocity, acceleration"),
        ("CONTRAVARIANT_ABSOLUTE", "position"),
    ):
        assert f"(e.g., {example})" in said.split(f" - {kind}: ")[1].split(" - ")[0]


def test_GRD007_the_roles_that_a_field_may_have() -> None:
    assert allowed("vectorDataRoleHint") == ["None", "Point", "Normal", "Vector", "Color"]


@with_openvdb
def test_GRD009_of_namesakes_openvdb_takes_the_first() -> None:
    assert asked(SAMPLES / "dup_names.vdb", NAMESAKE % "density") == 0


@with_openvdb
def test_GRD009_a_grid_is_looked_up_by_the_name_in_the_list() -> None:
    name = "tried(lambda: pyopenvdb.readGridMetadata(path, %r).name)"
    assert asked(GRIDS / "two_names.vdb", name % "density") == "Density"
    assert 'has no grid named "Density"' in asked(GRIDS / "two_names.vdb", name % "Density")


@with_vdb_print
def test_GRD010_a_newer_version_is_told_and_read(tmp_path: Path) -> None:
    content = bytearray((ASSETS / "cloud.vdb").read_bytes())
    content[8:12] = (999).to_bytes(4, "little")
    newer = tmp_path / "newer.vdb"
    newer.write_bytes(content)
    said = printed("vdb_print", newer)
    assert "unsupported VDB file format" in said
    assert "density " in said


@with_nanovdb
def test_GRD012_nanovdb_has_no_frustum(tmp_path: Path) -> None:
    said = printed("nanovdb_convert", ASSETS / "box_frustum.vdb", tmp_path / "box.nvdb")
    assert "only supports grids with affine transforms" in said


def test_GRD006_the_classes_that_a_field_may_have() -> None:
    assert allowed("fieldClass") == ["levelSet", "fogVolume", "staggered", "unknown"]


@with_vdb_print
def test_GRD011_one_unknown_type_and_the_whole_file_is_refused() -> None:
    said = printed("vdb_print", GRIDS / "unregistered.vdb")
    assert "Tree_uint32_5_4_3 is not registered" in said
    assert "density " not in said
