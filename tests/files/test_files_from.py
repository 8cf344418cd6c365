"""Lists of paths: lines and NUL, what is passed over, and what is no list."""

from __future__ import annotations

import io
import os
import sys
from pathlib import Path

import pytest

from usdvol_lint.files.lists import read_list
from usdvol_lint.model import UsageError


@pytest.mark.parametrize(
    ("data", "paths"),
    [
        (b"", []),
        (b"\n  \n\r\n", []),
        (b"a.usda\nb c.usda", ["a.usda", "b c.usda"]),
        (b"a.usda\r\n\r\n a.usda\r\n", ["a.usda", " a.usda"]),
        (b"a.usda\0b\nc.usda\0", ["a.usda", "b\nc.usda"]),
        (b"\xef\xbb\xbfa.usda\n", ["a.usda"]),
        ("\u00e9.usda\n".encode(), ["\u00e9.usda"]),
    ],
)
def test_lists(
    data: bytes, paths: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "list").write_bytes(data)
    assert list(read_list(str(tmp_path / "list"))) == paths
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    assert list(read_list("-")) == paths


def test_a_list_without_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("usdvol_lint.files.lists._MOST_BYTES", 10)
    (tmp_path / "list").write_bytes(b"stages.usda\n")
    with pytest.raises(UsageError, match=r"list: no list of paths has more than 10 bytes"):
        read_list(str(tmp_path / "list"))
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"stages.usda\n")))
    with pytest.raises(UsageError, match=r"-: no list of paths has more than 10 bytes"):
        read_list("-")


@pytest.mark.skipif(os.name == "nt", reason="file names are Unicode there")
def test_bytes_that_are_no_text_are_names_all_the_same(tmp_path: Path) -> None:
    (tmp_path / "list").write_bytes(b"\xff.usda\n")
    assert read_list(str(tmp_path / "list")) == (os.fsdecode(b"\xff.usda"),)


def test_what_is_no_list(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wide").write_bytes("a.usda".encode("utf-16"))
    with pytest.raises(UsageError, match="--files-from wide: this is UTF-16 text"):
        read_list("wide")
    with pytest.raises(UsageError, match="--files-from gone: No such file or directory"):
        read_list("gone")
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(UsageError, match="--files-from -: there is no standard input"):
        read_list("-")
