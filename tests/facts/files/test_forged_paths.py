"""No path that a layer may hold makes a rule fail, however long its names and numbers are."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]

FOLDERS = "./" + "a/" * 3000
DIGITS = "1" * 6000


@pytest.mark.parametrize(
    ("path", "code"),
    [
        (f"{FOLDERS}b.vdb", "AST002"),
        (f"/{'a/' * 3000}b.vdb", "AST002"),
        (f"./{'../' * 3000}b.vdb", "AST002"),
        (f"./a.{DIGITS}.vdb", "AST002"),
        (f"./{DIGITS}/a.vdb", "AST002"),
        ("./a.$F99999999999.vdb", "AST003"),
        (f"./a.$F{DIGITS}.vdb", "AST003"),
        (f"./a.%0{DIGITS}d.vdb", "AST003"),
        (f"./a.{'#' * 70_000}.vdb", "AST003"),
    ],
    ids=lambda text: text[:20],
)
def test_a_path_is_found_missing(path: str, code: str, lint_text: Lint) -> None:
    samples = f"asset filePath = @{path}@"
    stage = f'#usda 1.0\ndef OpenVDBAsset "a" {{\n{samples}\ntoken fieldName = "a"\n}}'
    codes = {finding.code for finding in lint_text(stage).findings}
    assert code in codes
    assert not codes & {"LNT001", "LNT002"}


def test_a_sequence_of_them(lint_text: Lint) -> None:
    names = ", ".join(f"{time}: @{FOLDERS}{DIGITS}{time}.vdb@" for time in range(5))
    stage = f'#usda 1.0\ndef OpenVDBAsset "a" {{\nasset filePath.timeSamples = {{ {names} }}\n}}'
    codes = {finding.code for finding in lint_text(stage).findings}
    assert "AST002" in codes
    assert not codes & {"LNT001", "LNT002"}
