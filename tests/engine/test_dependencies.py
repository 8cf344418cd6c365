"""Which stages what changed concerns, as their layers say."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from pxr import UsdUtils

from usdvol_lint.config import Storage
from usdvol_lint.engine.dependencies import concerned
from usdvol_lint.engine.search_path import set_search_path
from usdvol_lint.files.names import names_of

LAYERS = {
    "alone": 'def "x" {\n}\n',
    "sub": 'def "x" {\n}\n',
    "above": '(\n    subLayers = [@./sub.usda@]\n)\ndef "y" {\n}\n',
    "top": 'def "y" (\n    references = @./above.usda@</y>\n) {\n}\n',
    "variants": (
        'def "x" (\n    prepend variantSets = "look"\n    variants = {\n'
        '        string look = "a"\n    }\n)\n{\n    variantSet "look" = {\n        "a" {\n'
        '        }\n        "b" (\n            references = @./sub.usda@</x>\n        ) {\n'
        "        }\n    }\n}\n"
    ),
    "frames": (
        'def OpenVDBAsset "d" {\n    asset filePath.timeSamples = {\n'
        "        1: @./fog.0001.vdb@,\n        2: @./fog.0002.vdb@,\n    }\n}\n"
    ),
    "searched": 'def OpenVDBAsset "d" {\n    asset filePath = @library/fog.vdb@\n}\n',
    "arguments": (
        "(\n    subLayers = [@./gone.usda:SDF_FORMAT_ARGS:a=b@]\n)\n"
        'def "x" (\n    references = [\n        @./gone.usdz[x.usda:SDF_FORMAT_ARGS:a=b]@</x>,\n'
        "        @./away.usdz[x.usda]:SDF_FORMAT_ARGS:a=b@</x>\n    ]\n) {\n}\n"
    ),
    "fallback": 'def OpenVDBAsset "d" {\n    asset filePath = @vol/fog.vdb@\n}\n',
    "shared": 'def OpenVDBAsset "d" {\n    asset filePath = @P:/fog.vdb@\n}\n',
    "clips": (
        'def "x" (\n    clips = {\n        dictionary default = {\n'
        '            string templateAssetPath = "./clip.###.usda"\n'
        "            double templateStartTime = 1\n            double templateEndTime = 2\n"
        '            double templateStride = 1\n            string primPath = "/x"\n'
        "        }\n    }\n) {\n}\n"
    ),
    "clip.001": 'def "x" {\n}\n',
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.chdir(tmp_path)
    for name, text in LAYERS.items():
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    Path("garbage.usda").write_text("garbage")
    assert UsdUtils.CreateNewUsdzPackage("sub.usda", "sub.usdz")
    Path("packed.usda").write_text(
        '#usda 1.0\ndef "x" (\n    references = @./sub.usdz[sub.usda]@</x>\n) {\n}\n'
    )
    for name in ("fog.0001.vdb", "second/vol/fog.vdb"):
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).touch()
    set_search_path(["first", "second"])
    yield tmp_path
    set_search_path([])


@pytest.mark.parametrize(
    ("changed", "stages"),
    [
        (["alone.usda"], "alone"),
        (["sub.usda"], "above sub top variants"),
        (["fog.0001.vdb"], "frames"),
        (["fog.0002.vdb"], "frames"),  # gone, and named
        (["fog.0003.vdb"], "frames"),  # gone, and named until then, as far as anybody knows
        (["library/fog.vdb"], "searched"),
        (["share/fog.vdb"], "shared"),
        (["gone.usda"], "arguments"),
        (["gone.usdz"], "arguments"),
        (["away.usdz"], "arguments"),
        (["first/vol/fog.vdb"], "fallback"),  # found before that in `second`, until it was gone
        (["vol/fog.vdb"], "fallback"),
        (["first/vol/smog.vdb"], ""),
        (["clip.001.usda"], "clip.001 clips"),
        (["clip.002.usda"], "clip.001 clips"),
        (["sub.usdz"], "packed"),
        (["notes.txt", "fog.vdb"], ""),
        (["notes.txt", "alone.usda"], "alone"),
    ],
)
def test_who_uses_what_changed(changed: Sequence[str], stages: str, folder: Path) -> None:
    paths = frozenset(name for path in changed for name in names_of(path))
    storage = Storage(("first", "second"), path_map={"P:/": str(folder / "share")})
    concerns = concerned(paths, storage)
    found = [path.stem for path in sorted(folder.glob("*.usda")) if concerns(path.name)]
    # Nobody knows what a stage uses that can't be read.
    assert found == sorted({*stages.split(), "garbage"})
    assert concerns("gone.usda")


def test_a_folder_that_changed_as_one(folder: Path) -> None:
    """A submodule, or the link that leads to it."""
    concerns = concerned(frozenset(names_of(str(folder))), Storage())
    assert concerns("alone.usda")
    (folder / "second" / "other").mkdir()
    concerns = concerned(frozenset(names_of(str(folder / "second" / "other"))), Storage())
    assert concerns("searched.usda")  # nobody knows what was in it
    assert not concerns("alone.usda")


def test_a_path_that_is_not_utf_8_may_use_anything(folder: Path) -> None:
    """USD takes no such path; that it can't be read is told where the stage is checked."""
    concerns = concerned(frozenset(names_of(str(folder / "alone.usda"))), Storage())
    assert concerns("bad\udcff.usda")
