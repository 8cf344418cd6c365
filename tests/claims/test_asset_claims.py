"""What the pages of rules/asset say of USD, asked of USD."""

from __future__ import annotations

import sys
import zipfile
from pathlib import Path

import pytest
from answers import Said, stage
from pxr import Sdf, Usd, UsdVol

FIELD = 'def OpenVDBAsset "d"\n{\n    asset filePath%s\n}\n'


def path_of(of: Usd.Stage, prim: str = "/d") -> Usd.Attribute:
    return UsdVol.OpenVDBAsset(of.GetPrimAtPath(prim)).GetFilePathAttr()


def on_disk(folder: Path, path: str) -> Sdf.AssetPath:
    """What USD makes of a path in a layer in that folder, without a word."""
    (folder / "shot.usda").write_text("#usda 1.0\n" + FIELD % f" = @{path}@")
    with Said() as said:
        opened = Usd.Stage.Open(str(folder / "shot.usda"))
        found = path_of(opened).Get()
    assert said == []
    return found


def test_AST001_no_path_is_none_or_empty() -> None:
    assert path_of(stage(FIELD % "")).Get() is None
    assert path_of(stage(FIELD % " = @@")).Get().path == ""
    assert path_of(stage(FIELD % " = None")).Get() is None


def test_AST002_a_missing_file_resolves_to_nothing(tmp_path: Path) -> None:
    assert on_disk(tmp_path, "./a.vdb").resolvedPath == ""
    (tmp_path / "a.vdb").write_bytes(b"")
    assert Path(on_disk(tmp_path, "./a.vdb").resolvedPath) == tmp_path / "a.vdb"


SAMPLES = FIELD % ".timeSamples = {1: @a.vdb@, 2: None, 4: @c.vdb@}"


def test_AST002_a_value_is_held_and_never_interpolated() -> None:
    path = path_of(stage(SAMPLES))
    assert [path.Get(time).path for time in (0, 1, 1.5, 4, 9)] == ["a.vdb"] * 3 + ["c.vdb"] * 2


@pytest.mark.skipif(Usd.GetVersion() < (0, 26, 3), reason="between samples a block was a value")
@pytest.mark.parametrize("time", [2, 3])
def test_AST018_nothing_is_held_after_a_block(time: float) -> None:
    assert path_of(stage(SAMPLES)).Get(time) is None


def test_AST012_nothing_is_held_after_a_block() -> None:
    path = path_of(stage(FIELD % ".timeSamples = {1: @a.vdb@, 2: None}"))
    assert path.Get(1).path == "a.vdb"
    assert path.Get(9) in (None, Sdf.ValueBlock())


def test_AST007_an_absolute_path_stands_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "a.vdb").write_bytes(b"")
    found = path_of(stage(FIELD % f" = @{(tmp_path / 'a.vdb').as_posix()}@")).Get()
    assert Path(found.resolvedPath) == tmp_path / "a.vdb"


@pytest.mark.skipif(sys.platform != "linux", reason="the page tells what Linux does")
@pytest.mark.parametrize("path", ["./A.vdb", "./Sub/a.vdb"])
def test_AST009_another_case_is_missing_without_a_word(tmp_path: Path, path: str) -> None:
    (tmp_path / "sub").mkdir()
    for folder in (tmp_path, tmp_path / "sub"):
        (folder / "a.vdb").write_bytes(b"")
    assert on_disk(tmp_path, path).resolvedPath == ""


def test_AST011_the_file_of_the_frame_before_is_held() -> None:
    path = path_of(stage(FIELD % ".timeSamples = {1: @a.1.vdb@, 4: @a.4.vdb@}"))
    assert [path.Get(time).path for time in (2, 3)] == ["a.1.vdb"] * 2


def test_AST013_a_number_in_a_name_is_not_read() -> None:
    path = path_of(stage(FIELD % ".timeSamples = {3: @a.3.vdb@, 4: @a.6.vdb@}"))
    assert path.Get(4).path == "a.6.vdb"


@pytest.mark.parametrize(("path", "found"), [("a.vdb", True), ("./a.vdb", False)])
def test_AST015_usd_looks_beside_the_package(tmp_path: Path, path: str, found: bool) -> None:
    (tmp_path / "a.vdb").write_bytes(b"")
    with zipfile.ZipFile(tmp_path / "shot.usdz", "w") as package:
        package.writestr("root.usda", "#usda 1.0\n" + FIELD % f" = @{path}@")
    opened = Usd.Stage.Open(str(tmp_path / "shot.usdz"))
    assert bool(path_of(opened).Get().resolvedPath) is found


def test_AST003_a_placeholder_stands_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "a.0001.vdb").write_bytes(b"")
    found = on_disk(tmp_path, "./a.$F4.vdb")
    assert (found.path, found.resolvedPath) == ("./a.$F4.vdb", "")


def test_AST004_a_broken_expression_is_left_with_a_warning_at_every_get() -> None:
    path = path_of(stage(FIELD % ' = @`"./${TAKE`@'))
    for _ in range(2):
        with Said() as said:
            assert path.Get().path == '`"./${TAKE`'
        assert "Missing ending '}'" in said[0]


def test_AST004_an_unset_variable_is_no_error() -> None:
    with Said() as said:
        found = path_of(stage(FIELD % ' = @`"./${TAKE}.vdb"`@')).Get()
    assert said == []
    newest = Usd.GetVersion() >= (0, 26, 11)
    assert found.path == ("./${TAKE}.vdb" if newest else "./TAKE.vdb")


def test_AST004_the_root_layer_sets_the_variables() -> None:
    variables = '(\n    expressionVariables = {\n        string TAKE = "b"\n    }\n%s)\n'
    field = FIELD % ' = @`"./${TAKE}.vdb"`@'
    assert path_of(stage(variables % "" + field)).Get().path == "./b.vdb"
    below = stage("(\n    subLayers = [@other@]\n)\n", other=variables % "" + field)
    assert path_of(below).Get().path != "./b.vdb"


def test_AST005_a_folder_and_an_empty_file_resolve(tmp_path: Path) -> None:
    (tmp_path / "folder.vdb").mkdir()
    (tmp_path / "empty.vdb").write_bytes(b"")
    assert on_disk(tmp_path, "./folder.vdb").resolvedPath
    assert on_disk(tmp_path, "./empty.vdb").resolvedPath


@pytest.mark.skipif(sys.platform != "linux", reason="the page tells what Linux does")
@pytest.mark.parametrize("path", [".\\a.vdb", "C:/a.vdb", "~/a.vdb", "./a.vdb ", "./A.vdb"])
def test_AST008_what_only_some_platforms_find(tmp_path: Path, path: str) -> None:
    (tmp_path / "a.vdb").write_bytes(b"")
    assert on_disk(tmp_path, path).resolvedPath == ""


@pytest.mark.parametrize("path", ["omniverse://host/a.vdb", "https://host/a.vdb", "op:/obj/a"])
def test_AST010_a_scheme_without_a_resolver_is_left_without_a_word(
    tmp_path: Path, path: str
) -> None:
    assert on_disk(tmp_path, path).resolvedPath == ""


CLIPPED = """
def "v" (
    clips = {
        dictionary default = {
            %s
        }
    }
)
{
    def OpenVDBAsset "d"
    {
        asset filePath%s
    }
}
"""
CLIP = """
over "v"
{
    over "d"
    {
        asset filePath.timeSamples = {1: @a.vdb@}
    }
}
"""
WHOLE = ('string primPath = "/v"', "asset[] assetPaths = [@clip@]", "double2[] active = [(1, 0)]")


def clipped(keys: list[str], default: str = "", **layers: str) -> tuple[str, list[str]]:
    """The path at frame 1, and what USD warns of."""
    with Said() as said:
        opened = stage(CLIPPED % ("\n".join(keys), default), clip=CLIP, **layers)
        found = path_of(opened, "/v/d").Get(1)
    return (found.path if found else ""), said


def test_AST014_a_manifest_is_made_where_there_is_none() -> None:
    assert clipped([*WHOLE]) == ("a.vdb", [])


def test_AST014_what_the_manifest_lacks_has_no_value() -> None:
    manifest = CLIP.replace("filePath.timeSamples = {1: @a.vdb@}", "%s")
    keys = [*WHOLE, "asset manifestAssetPath = @manifest@"]
    assert clipped(keys, manifest=manifest % "filePath") == ("a.vdb", [])
    assert clipped(keys, manifest=manifest % "other") == ("", [])
    assert clipped(keys, " = @b.vdb@", manifest=manifest % "other") == ("b.vdb", [])


def test_AST014_what_the_manifest_declares_as_uniform_is_ignored() -> None:
    uniform = CLIP.replace("asset filePath.timeSamples = {1: @a.vdb@}", "uniform asset filePath")
    assert "uniform" in uniform
    keys = [*WHOLE, "asset manifestAssetPath = @manifest@"]
    assert clipped(keys, manifest=uniform) == ("", [])
    assert clipped(keys, " = @b.vdb@", manifest=uniform) == ("b.vdb", [])


@pytest.mark.parametrize("lacking", range(3))
def test_AST016_a_set_that_lacks_a_key_is_not_used_without_a_word(lacking: int) -> None:
    keys = [key for number, key in enumerate(WHOLE) if number != lacking]
    assert clipped(keys) == ("", [])


def test_AST016_a_prim_that_no_clip_has_is_no_word() -> None:
    assert clipped([WHOLE[0].replace("/v", "/w"), *WHOLE[1:]], " = @b.vdb@") == ("b.vdb", [])


@pytest.mark.parametrize(
    ("right", "wrong", "warning"),
    [("(1, 0)", "(1, 1)", "Invalid clip index 1"), ('"/v"', '"v"', "must be an absolute path")],
)
def test_AST016_some_of_it_is_a_warning(right: str, wrong: str, warning: str) -> None:
    found, said = clipped([key.replace(right, wrong) for key in WHOLE])
    assert found == ""
    assert warning in said[0]


def test_AST016_a_reference_below_leaves_the_clips_behind() -> None:
    keys = "\n".join(WHOLE)
    asset = stage(CLIPPED % (keys, ""), clip=CLIP).GetRootLayer().ExportToString()
    body = asset.partition("\n")[2]
    arc = 'def "it" (references = @asset@<%s>)\n{\n}\n'
    assert path_of(stage(arc % "/v", asset=body), "/it/d").Get(1).path == "a.vdb"
    assert path_of(stage(arc % "/v/d", asset=body), "/it").Get(1) is None


def test_AST016_a_stride_of_0_is_a_warning(tmp_path: Path) -> None:
    template = 'string templateAssetPath = "./c.#.usda"\ndouble templateStartTime = 1\n'
    keys = f"{WHOLE[0]}\n{template}double templateEndTime = 1\ndouble templateStride = %s"
    (tmp_path / "c.1.usda").write_text(f"#usda 1.0\n{CLIP}")
    for stride, path, warnings in ((1, "a.vdb", 0), (0, None, 1)):
        shot = tmp_path / f"{stride}.usda"
        shot.write_text("#usda 1.0\n" + CLIPPED % (keys % stride, ""))
        with Said() as said:
            opened = Usd.Stage.Open(str(shot))
            found = path_of(opened, "/v/d").Get(1)
        assert (found and found.path, len(said)) == (path, warnings)
