"""Fields of one Volume that name one file are told in one line of a report."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ASSETS

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]

FIELD = 'def %s "%s"\n{\nasset filePath = @%s@\ntoken fieldName = "density"\n}\n'


@pytest.fixture
def folds(lint_text: Lint, tmp_path: Path) -> Callable[..., dict[str | None, str | None]]:
    """The key of what a rule says of each field below one Volume, or below two of one name."""
    shutil.copytree(ASSETS, tmp_path, dirs_exist_ok=True)

    def call(code: str, path: str, *kinds: str) -> dict[str | None, str | None]:
        fields = "".join(FIELD % (kind, f"f{n}", path) for n, kind in enumerate(kinds))
        text = f'#usda 1.0\ndef Volume "v"\n{{\n{fields}}}\ndef Volume "w"\n{{\n'
        report = lint_text(f"{text}{FIELD % (kinds[0], 'f0', path)}}}\n")
        return {each.site.prim: each.fold for each in report.findings if each.code == code}

    return call


VDB, F3D = "OpenVDBAsset", "Field3DAsset"


@pytest.mark.parametrize(
    ("code", "path"),
    [
        ("AST002", "./gone.vdb"),
        ("AST003", "./smoke/smoke.####.vdb"),
        ("AST005", "./folder"),
        ("AST009", "./CLOUD.vdb"),
        ("GRD001", "./grids/text.vdb"),
        ("GRD002", "./grids/truncated.vdb"),
        ("GRD003", "./grids/no_grids.vdb"),
        ("GRD011", "./grids/unregistered.vdb"),
        ("GRD010", "./grids/version_226.vdb"),
    ],
)
def test_fields_that_name_one_file(
    code: str, path: str, folds: Callable[..., dict[str, str | None]]
) -> None:
    assert folds(code, path, VDB, VDB) == {"/v/f0": "/v/f0", "/v/f1": "/v/f0", "/w/f0": None}


def test_an_extension_is_told_apart_by_the_type_of_the_field(
    folds: Callable[..., dict[str, str | None]],
) -> None:
    assert folds("AST006", "./puff/puff.nvdb", VDB, F3D, VDB) == {
        "/v/f0": f"/v/f0 {VDB}",
        "/v/f1": f"/v/f0 {F3D}",
        "/v/f2": f"/v/f0 {VDB}",
        "/w/f0": None,
    }


def test_a_grid_that_is_missing_beside_others_is_told_for_each_field(
    folds: Callable[..., dict[str, str | None]],
) -> None:
    found = folds("GRD003", "./grids/velocity.vdb", VDB, VDB)
    assert found == dict.fromkeys(("/v/f0", "/v/f1", "/w/f0"))
