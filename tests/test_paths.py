"""A layer is called by the file that it is, however it was named."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from unicodedata import normalize

import pytest

from usdvol_lint.paths import as_spelt, below, canonical, display

NFC, NFD = (normalize(form, "tänk") for form in ("NFC", "NFD"))


@pytest.mark.parametrize(
    ("named", "file"),
    [
        ("a.usda", "a.usda"),
        ("./x/../a.usda", "a.usda"),
        ("link/a.usda", "real/a.usda"),
        ("linked.usda", "real/a.usda"),
        ("a.usda:SDF_FORMAT_ARGS:x=1&y=[2]", "a.usda"),
        ("a.usdz[in/b.usda]", "a.usdz[in/b.usda]"),
        ("link/a.usdz[in/b.usda]", "real/a.usdz[in/b.usda]"),
        ("a.usdz[b.usdz[c.usda]]", "a.usdz[b.usdz[c.usda]]"),
        ("a.usdz[b.usda]:SDF_FORMAT_ARGS:x=1", "a.usdz[b.usda]"),
        ("[1]/a[2].usda", "[1]/a[2].usda"),
        (f"{NFD}/{NFD}.usda", f"{NFC}/{NFC}.usda"),
        (f"a.usdz[{NFD}.usda]", f"a.usdz[{NFC}.usda]"),
        ("gone/a.usda", "gone/a.usda"),
        ("", ""),
    ],
)
def test_canonical(named: str, file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Absolute, without links, with `/`, in NFC and without file format arguments."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "real").mkdir()
    (tmp_path / "real" / "a.usda").touch()
    (tmp_path / "link").symlink_to("real")
    (tmp_path / "linked.usda").symlink_to("link/a.usda")
    folder = Path(os.path.realpath(tmp_path)).as_posix()
    expected = f"{folder}/{file}".rstrip("/")
    assert canonical(named) == expected
    assert canonical(str(tmp_path / named)) == expected
    assert canonical(expected) == expected


FOLDERS = {
    "/": ["Volumes"],
    "/volumes": ["Show", "Reel"],
    "/volumes/show": ["Tank.usda", NFD, "a", "A"],
}
"""What is in them, on a file system where the case of letters does not matter."""


@pytest.mark.parametrize(
    ("path", "spelt"),
    [
        ("/volumes/SHOW/tank.USDA", "/Volumes/Show/Tank.usda"),
        ("/Volumes/Show/Tank.usda", "/Volumes/Show/Tank.usda"),
        ("/volumes/show/gone.usda", "/Volumes/Show/gone.usda"),
        ("/volumes/none/tank.usda", "/volumes/none/tank.usda"),
        (f"/volumes/show/{NFC.upper()}", f"/Volumes/Show/{NFD}"),
        ("/volumes/show/a", "/Volumes/Show/a"),
        ("/volumes/show/A", "/Volumes/Show/A"),
        ("/", "/"),
    ],
)
@pytest.mark.skipif(sys.platform == "win32", reason="paths have drives there")
def test_names_are_spelt_as_their_folders_spell_them(path: str, spelt: str) -> None:
    def names_in(folder: str) -> list[str]:
        try:
            return FOLDERS[folder.casefold()]
        except KeyError:
            raise NotADirectoryError(folder) from None

    assert as_spelt(path, names_in) == spelt


@pytest.mark.parametrize(
    ("path", "root", "shown"),
    [
        ("/lib/a.usda", "/lib", "a.usda"),
        ("/lib/x/a.usdz[b.usda]", "/lib", "x/a.usdz[b.usda]"),
        ("/library/a.usda", "/lib", "/library/a.usda"),
        ("/other/a.usda", "/lib", "/other/a.usda"),
        ("/lib/a.usda", "/", "lib/a.usda"),
        ("/lib", "/lib", "."),
        ("/lib/a.usda", None, "/lib/a.usda"),
        ("C:/lib/a.usda", "C:/", "lib/a.usda"),
    ],
)
def test_below(path: str, root: str | None, shown: str) -> None:
    assert below(path, root) == shown


def test_display(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "shots").mkdir()
    monkeypatch.chdir(tmp_path / "shots")
    assert (
        display(f"{os.path.realpath(tmp_path)}/lib/a.usdz[b/c.usda]") == "../lib/a.usdz[b/c.usda]"
    )
    assert display("a[1].usda") == "a[1].usda"
