"""What the pages of rules/grid say of USD and of OpenVDB, asked of both."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from answers import Said, stage
from process import ASSETS
from pxr import UsdVol

FIELD = 'def OpenVDBAsset "d"\n{\n    asset filePath = @%s@\n}\n'
GRIDS = ASSETS / "grids"
with_openvdb = pytest.mark.skipif(
    shutil.which("vdb_print") is None, reason="no vdb_print, which libopenvdb-tools installs"
)


def printed(name: str) -> str:
    """What OpenVDB's own tool says of a file."""
    command = ["vdb_print", str(GRIDS / name)]
    done = subprocess.run(command, capture_output=True, check=False, timeout=60)
    return (done.stdout + done.stderr).decode("utf-8", "replace")


def test_GRD001_usd_never_opens_the_file() -> None:
    with Said() as said:
        field = stage(FIELD % (GRIDS / "text.vdb")).GetPrimAtPath("/d")
        path = UsdVol.OpenVDBAsset(field).GetFilePathAttr().Get()
    assert said == []
    assert Path(path.resolvedPath) == GRIDS / "text.vdb"


def test_GRD001_the_first_bytes_of_openvdb() -> None:
    assert (ASSETS / "cloud.vdb").read_bytes().startswith(b" BDV")


@with_openvdb
@pytest.mark.parametrize("name", ["nanovdb.vdb", "text.vdb"])
def test_GRD001_openvdb_refuses_other_files(name: str) -> None:
    assert "not a VDB file" in printed(name)


def test_GRD006_the_classes_that_a_field_may_have() -> None:
    definition = stage(FIELD % "a.vdb").GetPrimAtPath("/d").GetPrimDefinition()
    allowed = list(definition.GetPropertyMetadata("fieldClass", "allowedTokens"))
    assert allowed == ["levelSet", "fogVolume", "staggered", "unknown"]


@with_openvdb
def test_GRD011_one_unknown_type_and_the_whole_file_is_refused() -> None:
    said = printed("unregistered.vdb")
    assert "Tree_uint32_5_4_3 is not registered" in said
    assert "density " not in said
