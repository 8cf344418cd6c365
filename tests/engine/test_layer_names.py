"""Layers are called as the files that they are, and shown from the working directory."""

from __future__ import annotations

from pathlib import Path
from zipfile import ZipFile

import pytest
from pxr import Sdf

from usdvol_lint.engine.layer_names import real_name, shown_name
from usdvol_lint.paths import canonical

TEXT = '#usda 1.0\ndef "a"\n{\n}\n'


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A folder with layers and packages, which is the working directory."""
    for folder in ("real", "[1]"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "a.usda").write_text(TEXT)
        with ZipFile(tmp_path / folder / "p.usdz", "w") as package:
            for name in ("first.usda", "deep/first.usda"):
                package.writestr(name, TEXT)
    (tmp_path / "link").symlink_to("real")
    monkeypatch.chdir(tmp_path)
    return canonical(str(tmp_path))


@pytest.mark.parametrize(
    ("path", "real", "shown"),
    [
        ("real/a.usda", "real/a.usda", "real/a.usda"),
        ("link/a.usda", "real/a.usda", "link/a.usda"),
        ("real/a.usda:SDF_FORMAT_ARGS:x=1", "real/a.usda", "real/a.usda"),
        ("real/p.usdz", "real/p.usdz", "real/p.usdz"),
        ("real/p.usdz[first.usda]", "real/p.usdz", "real/p.usdz[first.usda]"),
        (
            "real/p.usdz[deep/first.usda]",
            "real/p.usdz[deep/first.usda]",
            "real/p.usdz[deep/first.usda]",
        ),
        ("[1]/a.usda", "[1]/a.usda", "[1]/a.usda"),
        ("[1]/p.usdz", "[1]/p.usdz", "[1]/p.usdz"),
    ],
)
def test_names_of_layers(path: str, real: str, shown: str, here: str) -> None:
    layer = Sdf.Layer.FindOrOpen(f"{here}/{path}")
    assert layer
    assert (real_name(layer), shown_name(layer)) == (f"{here}/{real}", shown)


def test_a_package_in_a_folder_with_brackets(here: str) -> None:
    """The layer is made up: USD does not open one in a package there."""

    class Layer:
        anonymous = False

        def __init__(self, path: str) -> None:
            self.identifier = self.realPath = path

    for inner, real in (("first.usda", ""), ("deep/first.usda", "[deep/first.usda]")):
        layer = Layer(f"{here}/[1]/p.usdz[{inner}]")
        assert real_name(layer) == f"{here}/[1]/p.usdz{real}"


def test_layers_without_a_file() -> None:
    layer = Sdf.Layer.CreateAnonymous("made.usda")
    assert real_name(layer) == layer.identifier
    assert shown_name(layer).startswith("anon:")
