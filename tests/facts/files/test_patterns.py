"""Placeholders, schemes and extensions of paths."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from stages import only, volume, write

from usdvol_lint.facts.files.paths import extension_of, is_uri
from usdvol_lint.facts.files.patterns import find_pattern
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]


def test_time_samples_to_paste(lint_text: Lint, tmp_path: Path) -> None:
    """All of them, by number; padding counts, and what only resembles the pattern does not."""
    write(tmp_path, *(f"fx/smoke.{frame:04}.vdb" for frame in (-5, 1, 2, 3, 10, 100)))
    write(tmp_path, "fx/smoke.7.vdb", "fx/smoke.0001.vdb.tmp", "fx/old_smoke.0001.vdb")
    finding = only(lint_text(volume("asset filePath = @./fx/smoke.%04d.vdb@")))
    assert finding.suggestion == (
        "5 files found: author filePath.timeSamples = { 1: @./fx/smoke.0001.vdb@, "
        "2: @./fx/smoke.0002.vdb@, 3: @./fx/smoke.0003.vdb@, 10: @./fx/smoke.0010.vdb@, "
        "100: @./fx/smoke.0100.vdb@ }"
    )


@pytest.mark.parametrize(
    ("path", "pattern"),
    [
        ("smoke.$F.vdb", "$F"),
        ("smoke.$F4.vdb", "$F4"),
        ("smoke.${F4}.vdb", "${F4}"),
        ("smoke.$FF.vdb", "$FF"),
        ("smoke.$SF4.vdb", "$SF4"),
        ("smoke.####.vdb", "####"),
        ("smoke.#.vdb", "#"),
        ("smoke.%d.vdb", "%d"),
        ("smoke.%04d.vdb", "%04d"),
        ("smoke.<UDIM>.vdb", "<UDIM>"),
        ("smoke.%(UDIM)d.vdb", "%(UDIM)d"),
        ("smoke.<f>.vdb", "<f>"),
        ("smoke.<f4>.vdb", "<f4>"),
        ("smoke.<frame>.vdb", "<frame>"),
        ("smoke.{frame:04d}.vdb", "{frame:04d}"),
        ("smoke.@@@@.vdb", "@@@@"),
        ("smoke.*.vdb", "*"),
        ("smoke.$F4/density.vdb", "$F4"),
        ("$HIP/smoke.vdb", "$HIP"),
        ("${JOB}/smoke.vdb", "${JOB}"),
        ("smoke.0001.vdb", None),
        ("take#3/smoke.vdb", None),
        ("100%done/smoke.vdb", None),
        ("me@studio/smoke.vdb", None),
        ("5$/smoke.vdb", None),
        ("a{b}/smoke.vdb", None),
        ("<draft>/smoke.vdb", None),
    ],
)
def test_placeholders(path: str, pattern: str | None) -> None:
    assert find_pattern(path) == pattern


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("omniverse://host/a.vdb", True),
        ("https://host/a.vdb:SDF_FORMAT_ARGS:a=b", True),
        ("op:/obj/geo", True),
        ("./a.vdb:SDF_FORMAT_ARGS:a=b", False),
        ("a.vdb:SDF_FORMAT_ARGS:a=b", False),
        ("cloud:SDF_FORMAT_ARGS:a=b", False),
        ("C:/shots/a.vdb", False),
        ("./a:b.vdb", False),
        ("a.vdb", False),
    ],
)
def test_schemes(path: str, expected: bool) -> None:
    assert is_uri(path) is expected


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("./a.vdb", ".vdb"),
        ("./a.0001.VDB", ".vdb"),
        ("./a.nvdb:SDF_FORMAT_ARGS:b=c.vdb", ".nvdb"),
        ("./shot.usdz[vdb/a.vdb]", ".vdb"),
        ("./shot.usdz[a.f3d]:SDF_FORMAT_ARGS:b=c", ".f3d"),
        ("./v1.0/a", ""),
        ("", ""),
    ],
)
def test_extensions(path: str, expected: str) -> None:
    assert extension_of(path) == expected
