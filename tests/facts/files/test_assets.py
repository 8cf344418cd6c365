"""The files that fields name: what the rule pages can not show."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Ar, UsdUtils
from stages import CONTENT, findings, only, package, said, volume, write

from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.files import classify
from usdvol_lint.facts.files.corrections import Absence, find_absence
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.folders import Folders
from usdvol_lint.facts.files.paths import extension_of, is_uri
from usdvol_lint.facts.files.patterns import find_pattern
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]


@pytest.mark.parametrize(
    ("authored", "expected"),
    [
        (
            "./shto.usdz[a.vdb]",
            "no file at './shto.usdz[a.vdb]': no package './shto.usdz'"
            " -> did you mean './shot.usdz[a.vdb]'?",
        ),
        (
            "./caches/shot.usdz[a.vdb]",
            "no file at './caches/shot.usdz[a.vdb]': no folder './caches'"
            " -> did you mean './cache'?",
        ),
    ],
)
def test_a_package_that_is_not_there(
    authored: str, expected: str, lint_text: Lint, tmp_path: Path
) -> None:
    package(tmp_path / "shot.usdz", "#usda 1.0\n", {"a.vdb": CONTENT})
    (tmp_path / "cache").mkdir()
    assert said(lint_text(volume(f"asset filePath = @{authored}@"))) == [f"AST002 {expected}"]


@pytest.mark.parametrize(
    ("authored", "expected"),
    [
        ("./vdb/cloud.vdb", []),
        ("vdb/cloud.vdb", []),
        (
            "./vdb/clod.vdb",
            [
                "AST002 no file at './vdb/clod.vdb' in 'shot.usdz'"
                " -> did you mean './vdb/cloud.vdb'?"
            ],
        ),
        ("vdb/gone.vdb", ["AST002 no file at 'vdb/gone.vdb' in 'shot.usdz'"]),
        ("./vdb", ["AST002 no file at './vdb' in 'shot.usdz'"]),
        (
            "./vdb/nothing.vdb",
            [
                "AST005 './vdb/nothing.vdb' is a file of 0 bytes -> write it again: this is what a"
                " simulation that died leaves behind"
            ],
        ),
    ],
)
def test_files_inside_a_package(
    authored: str,
    expected: list[str],
    engine: Engine,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    files = {"vdb/cloud.vdb": CONTENT, "vdb/nothing.vdb": b""}
    package(tmp_path / "shot.usdz", volume(f"asset filePath = @{authored}@"), files)
    (tmp_path / "scene.usda").write_text(
        '#usda 1.0\ndef "shot" (\n    references = @./shot.usdz@</cloud>\n)\n{\n}\n'
    )
    assert said(engine.lint("shot.usdz")) == expected
    assert said(engine.lint("scene.usda")) == expected


def test_names_that_usd_writes_into_a_package(
    engine: Engine, assets: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They are UTF-8, and the archive does not say so."""
    monkeypatch.chdir(tmp_path)
    shutil.copyfile(assets / "cloud.vdb", "wölkchen.vdb")
    Path("root.usda").write_text(volume("asset filePath = @./wölkchen.vdb@"), encoding="utf-8")
    assert UsdUtils.CreateNewUsdzPackage("root.usda", "shot.usdz")
    assert engine.lint("shot.usdz").findings == ()
    stage = volume("asset filePath = @./shot.usdz[wolkchen.vdb]@")
    Path("stage.usda").write_text(stage, encoding="utf-8")
    assert said(engine.lint("stage.usda")) == [
        "AST002 no file at './shot.usdz[wolkchen.vdb]' in 'shot.usdz' -> did you mean "
        "'./shot.usdz[wölkchen.vdb]'?"
    ]


@pytest.mark.parametrize("flag", [0, 0x800])
def test_names_in_a_package_that_are_no_text(
    flag: int, engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether or not the archive calls them UTF-8; if it does, no more than advice is lost."""
    monkeypatch.chdir(tmp_path)
    package(
        tmp_path / "shot.usdz",
        volume("asset filePath = @./vdb/gone.vdb@"),
        {"vdb/x": b"", "~~": b""},
    )
    content = (tmp_path / "shot.usdz").read_bytes().replace(b"~~", b"\xff\xfe")
    entry = content.rindex(b"PK\1\2")
    content = content[: entry + 8] + flag.to_bytes(2, "little") + content[entry + 10 :]
    (tmp_path / "shot.usdz").write_bytes(content)
    assert said(engine.lint("shot.usdz")) == ["AST002 no file at './vdb/gone.vdb' in 'shot.usdz'"]


@pytest.mark.parametrize(
    ("start", "others"),
    [
        ("./shot.usdz[gone/", ": no folder 'gone' in 'shot.usdz', where 1 other field should"),
        ("./shot.usdz[vdb/gone/", ": no folder 'vdb/gone' in 'shot.usdz', where 1 other field"),
        ("./gone.usdz[vdb/", ": no package './gone.usdz', where 1 other field should have"),
        ("./shot.usdz[vdb/", None),
        ("./shot.usdz[", None),
        ("./shot.usdz[in.usdz[vdb/", None),
    ],
)
def test_a_folder_that_a_package_lacks_is_one_finding(
    start: str, others: str | None, lint_text: Lint, tmp_path: Path
) -> None:
    package(tmp_path / "shot.usdz", "#usda 1.0\n", {"vdb/b/cloud.vdb": CONTENT, "in.usdz": CONTENT})
    one, two = (f"{start}{name}.vdb]{']' * (start.count('[') - 1)}" for name in ("mist", "sparks"))
    first, second = (volume(f"asset filePath = @{path}@") for path in (one, two))
    found = said(lint_text(first + second.replace("cloud", "second").replace("#usda 1.0", "")))
    if others:
        [finding] = found
        assert finding.startswith(f"AST002 no file at '{one}'{others}")
    else:
        assert found == [f"AST002 no file at '{path}' in 'shot.usdz'" for path in (one, two)]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_named_pipe_is_no_file_and_is_not_opened(lint_text: Lint, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.vdb")
    report = lint_text(volume("asset filePath = @./pipe.vdb@"))
    assert said(report) == ["AST005 './pipe.vdb' is not a regular file"]


@pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="permissions do not bite here"
)
def test_a_file_without_permission(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "cloud.vdb")
    (tmp_path / "cloud.vdb").chmod(0)
    report = lint_text(volume("asset filePath = @./cloud.vdb@"))
    assert said(report) == ["AST005 './cloud.vdb' is not readable -> check its permissions"]


def test_symbolic_links_that_lead_nowhere(lint_text: Lint, tmp_path: Path) -> None:
    (tmp_path / "dangling.vdb").symlink_to("published.vdb")
    (tmp_path / "loop.vdb").symlink_to("loop.vdb")
    (tmp_path / "folder").symlink_to("unmounted")
    texts = {
        "./dangling.vdb": "a symbolic link to 'published.vdb', which does not exist",
        "./loop.vdb": "a symbolic link to 'loop.vdb' that leads round in a circle",
        "./folder/cloud.vdb": "a symbolic link to 'unmounted', which does not exist",
    }
    for path, reason in texts.items():
        report = lint_text(volume(f"asset filePath = @{path}@"))
        assert said(report) == [f"AST002 no file at {path!r}: {reason}"]


def test_a_symbolic_link_to_a_file_is_a_file(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "cloud.vdb")
    (tmp_path / "link.vdb").symlink_to("cloud.vdb")
    assert said(lint_text(volume("asset filePath = @./link.vdb@"))) == []


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("./clod.vdb", Absence("", "./cloud.vdb")),
        ("clod.vdb", Absence("", "cloud.vdb")),
        ("./CLOUD.vdb", Absence("", "./cloud.vdb")),
        ("./nothing.vdb", Absence("", None)),
        ("./smok/smoke.0001.vdb", Absence(": no folder './smok'", "./smoke/smoke.0001.vdb")),
        ("./smok/smoke.0009.vdb", Absence(": no folder './smok'", "./smoke")),
        ("./smoke/v2/smoke.0001.vdb", Absence(": no folder './smoke/v2'", None)),
        ("./x/y/smoke.vdb", Absence(": no folder './x'", None)),
        ("./smoke/smoke.1.vdb", Absence("", "./smoke/smoke.0001.vdb")),
        ("./smoke/smok.0002.vdb", Absence("", "./smoke/smoke.0002.vdb")),
        ("./smoke/smoke.0004.vdb", Absence("", None)),
        ("./smoke/../clod.vdb", Absence("", "./smoke/../cloud.vdb")),
        ("./clod.vdb:SDF_FORMAT_ARGS:a=b", Absence("", "./cloud.vdb")),
    ],
)
def test_what_a_missing_path_may_have_meant(path: str, expected: Absence, tmp_path: Path) -> None:
    """Another frame is another file, never a misspelling."""
    write(tmp_path, "cloud.vdb", *(f"smoke/smoke.{frame:04}.vdb" for frame in (1, 2, 3)))
    absolute = os.path.normpath(tmp_path / path.partition(":")[0])
    assert find_absence(Disk(), absolute, path) == expected


@pytest.mark.parametrize(
    ("path", "similar"),
    [
        ("./cahce/cloud.vdb", "./cache/cloud.vdb"),
        ("./cahce/gone.vdb", "./cache"),
        ("./cache_v2/smoke.0001.vdb", "./cache_v1/smoke.0001.vdb"),
        ("./cache_v2/smoke.0002.vdb", None),
        ("./fx/sim/fire.vdb", "./effects/sim/fire.vdb"),
        ("./cache/fire.vdb", "./sparks/fire.vdb"),
        ("./cache/smoke.0001.vdb", None),
        ("./sparkl/fire.vdb", "./sparks/fire.vdb"),
        ("./effects/sin/fire.vdb", "./effects/sim/fire.vdb"),
        ("./cahce_v1/smoke.0001.vdb", "./cache_v1/smoke.0001.vdb"),
    ],
)
def test_a_file_that_lies_in_a_sibling_folder(
    path: str, similar: str | None, tmp_path: Path
) -> None:
    files = ("cache/cloud.vdb", "cache_v1/smoke.0001.vdb", "effects/sim/fire.vdb")
    write(
        tmp_path, *files, "sparks/fire.vdb", "sparks/both.vdb", "cache_v1/both.vdb", "sparkle/a.vdb"
    )
    found = find_absence(Disk(), os.path.normpath(tmp_path / path), path)
    assert (found.similar, found.elsewhere) == (similar, ())


@pytest.mark.parametrize(
    ("path", "elsewhere"),
    [
        (
            "./cache_v2/a.vdb",
            "'./cache_v10/a.vdb', './cache_v3/a.vdb', './cache_v1/a.vdb' and 1 more",
        ),
        (
            "./old/a.vdb",
            "'./old_caches_of_wednesday/a.vdb', './cache_v10/a.vdb', './cache_v3/a.vdb' and 1 more",
        ),
        ("./sparkle/b.vdb", "'./sparks/b.vdb', './cache_v10/b.vdb'"),
        ("./sparkk/b.vdb", "'./sparks/b.vdb', './cache_v10/b.vdb'"),
        (
            "./cache_v3/../cache_v2/b.vdb",
            "'./cache_v3/../cache_v10/b.vdb', './cache_v3/../sparks/b.vdb'",
        ),
        ("./gone/shot.usdz[c.vdb]", "'./cache_v3/shot.usdz[c.vdb]', './cache_v1/shot.usdz[c.vdb]'"),
    ],
)
def test_a_file_that_lies_in_several_sibling_folders(
    path: str, elsewhere: str, tmp_path: Path
) -> None:
    folders = ("cache_v1", "cache_v3", "cache_v10", "old_caches_of_wednesday")
    write(tmp_path, *(f"{folder}/a.vdb" for folder in folders))
    write(tmp_path, "sparks/b.vdb", "cache_v10/b.vdb", "sparkle/c.vdb")
    write(tmp_path, "cache_v1/shot.usdz", "cache_v3/shot.usdz")
    found = find_absence(Disk(), os.path.normpath(tmp_path / path), path)
    assert found.advice == f"there are files of that name at {elsewhere}"


@pytest.mark.parametrize(("path", "count"), [("./gone.vdb", 2), ("./gone/a.vdb", 1)])
def test_a_folder_is_one_finding_and_a_file_one_for_each_field(
    path: str, count: int, lint_text: Lint
) -> None:
    one = volume(f"asset filePath = @{path}@")
    found = findings(lint_text(one + one.replace("cloud", "second")))
    assert [each.code for each in found] == ["AST002"] * count


def test_what_lies_beside_the_folder_of_a_layer_is_another_asset(tmp_path: Path) -> None:
    write(tmp_path, "a/cloud.vdb", "b/other.vdb")
    assert find_absence(Disk(), f"{tmp_path}/b/cloud.vdb", "./cloud.vdb") == Absence("", None)


def test_a_moved_cache_is_looked_for_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, *(f"{folder}/{file}.vdb" for folder in "abcd" for file in range(9)))
    (tmp_path / "a").rename(tmp_path / "moved")
    for folder in "bcd":
        (tmp_path / folder / "0.vdb").unlink()
    asked: list[str] = []
    is_file = os.path.isfile
    monkeypatch.setattr(os.path, "isfile", lambda path: asked.append(path) or is_file(path))
    disk = Disk()
    for file in range(9):
        assert disk.siblings_with(f"{tmp_path}/a", f"/{file}.vdb") == ["moved"]
    assert len(asked) < 2 * 9


def test_no_end_of_folders_is_searched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, "moved/0.vdb", "other/1.vdb")
    monkeypatch.setattr("usdvol_lint.facts.files.folders._NAMES_TRIED", 3)
    folders = Folders()
    disk = Disk(folders)
    assert disk.siblings_with(f"{tmp_path}/a", "/0.vdb") == ["moved"]
    assert disk.siblings_with(f"{tmp_path}/b", "/1.vdb") == []
    assert Disk(folders).siblings_with(f"{tmp_path}/b", "/1.vdb") == []  # of the next stage


def test_bare_names_are_looked_for_beside_their_layer(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "shot/cloud.vdb", "shot/smoke.0001.vdb")
    (tmp_path / "shot" / "a.usda").write_text(volume("asset filePath = @clod.vdb@"))
    (tmp_path / "shot" / "b.usda").write_text(volume("asset filePath = @smoke.$F4.vdb@"))
    stage = "#usda 1.0\n(\n    subLayers = [@./shot/{}.usda@]\n)\n"
    assert said(lint_text(stage.format("a"), "a.usda")) == [
        "AST002 no file at 'clod.vdb' -> did you mean 'cloud.vdb'?"
    ]
    assert said(lint_text(stage.format("b"), "b.usda")) == [
        "AST003 no file at 'smoke.$F4.vdb': USD does not replace '$F4' -> 1 file found: author "
        "filePath.timeSamples = { 1: @smoke.0001.vdb@ }"
    ]


def test_frames_of_the_stage_and_of_the_layer(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "smoke.0001.vdb", "smoke.0004.vdb")
    samples = "\n".join(f"{frame}: @./smoke.{frame:04}.vdb@," for frame in range(1, 6))
    (tmp_path / "fx.usda").write_text(volume(f"asset filePath.timeSamples = {{\n{samples}\n}}"))
    finding = only(
        lint_text("#usda 1.0\n(\n    subLayers = [@./fx.usda@ (offset = 100; scale = 2)]\n)\n")
    )
    assert (finding.site.layer, finding.site.line, finding.site.frames, finding.message) == (
        "fx.usda",
        15,
        "104, 106, 110",
        "no file at './smoke.0002.vdb' (3 of 5 samples, authored as frames 2-3, 5)",
    )


def test_default_and_samples_are_told_apart(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "a.vdb")
    both = (
        "asset filePath = {}\n        asset filePath.timeSamples = {{\n 1: @./a.vdb@,\n 2: {}\n}}"
    )
    finding = only(lint_text(volume(both.format("@./b.vdb@", "@./a.vdb@"))))
    assert (finding.site.line, finding.site.at_default, finding.site.times, finding.message) == (
        13,
        True,
        (),
        "no file at './b.vdb' (the default alone, none of the 2 time samples)",
    )
    finding = only(lint_text(volume(both.format("@./b.vdb@", "@./c.vdb@"))))
    assert (finding.site.line, finding.site.frames, finding.message) == (
        13,
        "default, 2",
        "no file at './b.vdb' (1 of 2 samples)",
    )


def test_a_default_below_stronger_samples_is_found_in_its_own_layer(
    lint_text: Lint, tmp_path: Path
) -> None:
    write(tmp_path, "a.vdb")
    (tmp_path / "weak.usda").write_text(volume("asset filePath = @./b.vdb@"))
    finding = only(
        lint_text(
            """#usda 1.0
(
    subLayers = [@./weak.usda@]
)
over "cloud"
{
    over "density"
    {
        asset filePath.timeSamples = {
            1: @./a.vdb@,
        }
    }
}
"""
        )
    )
    assert (finding.site.layer, finding.site.line, finding.message) == (
        "weak.usda",
        13,
        "no file at './b.vdb' (the default alone, none of the 1 time samples)",
    )


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("", "no filePath"),
        ("asset filePath", "filePath has no value"),
        ("asset filePath = None", "filePath is blocked"),
        ("asset filePath = @@", "filePath is empty"),
    ],
)
def test_ways_to_name_no_file(path: str, message: str, lint_text: Lint) -> None:
    assert said(lint_text(volume(path))) == [
        f"AST001 {message} -> author the path of the file that holds the field"
    ]


def test_expressions_in_a_usd_that_forgets_them(
    lint_text: Lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Old USD gives the evaluated path alone: what was written is found in the layer."""
    monkeypatch.setattr(classify, "authored_path", lambda asset: "")
    variables = '(\n    expressionVariables = {\n        string TAKE = "clod"\n    }\n)'
    expressions = {
        '`"./${TAKE}.vdb"`': "AST002 no file at './clod.vdb' (from '`\"./${TAKE}.vdb\"`')",
        '`"./${NOPE}.vdb"`': (
            "AST004 the expression '`\"./${NOPE}.vdb\"`' needs a variable that is not set: NOPE -> "
            "set NOPE in expressionVariables of the root layer; USD does not read those of "
            "sublayers"
        ),
        '`"./${TAKE.vdb"`': (
            "AST004 the expression '`\"./${TAKE.vdb\"`' can't be evaluated: missing ending '}' at "
            "character 10"
        ),
        '`if(defined("NOPE"), "./${NOPE}.vdb", "./clod.vdb")`': (
            "AST002 no file at './clod.vdb' (from "
            '\'`if(defined("NOPE"), "./${NOPE}.vdb", "./clod.vdb")`\')'
        ),
        '`""`': "AST001 filePath is empty -> author the path of the file that holds the field",
    }
    for expression, expected in expressions.items():
        default = f"asset filePath = @{expression}@"
        assert said(lint_text(volume(default, variables))) == [expected]
    (tmp_path / "fx.usda").write_text(
        volume('asset filePath.timeSamples = {\n 1: @`"./${TAKE}.vdb"`@\n}')
    )
    stage = f"#usda 1.0\n{variables[:-1]}    subLayers = [@./fx.usda@ (offset = 10)]\n)\n"
    assert said(lint_text(stage)) == [
        "AST002 no file at './clod.vdb' (from '`\"./${TAKE}.vdb\"`') "
        "(1 of 1 samples, authored as frame 1)"
    ]


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


@pytest.mark.skipif(os.name == "nt", reason="names have no colons here")
@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("op:/obj/pyro/OUT.vdb", []),
        ("op:/obj/pyro/OUT.vdb:SDF_FORMAT_ARGS:a=b", []),
        ("op:/obj/pyro/OUT", ["AST006"]),
        ("op:/obj/pyro/empty.vdb", ["AST005"]),
        ("op:/obj/pyro/GONE.vdb", ["AST010"]),
        ("asset:smoke.vdb", []),
        ("asset:gone.vdb", ["AST010"]),
    ],
)
def test_a_resolver_that_answers_for_what_looks_like_a_uri(
    path: str, expected: list[str], lint_text: Lint, assets: Path, tmp_path: Path
) -> None:
    """USD's own does, where its search path leads to such a file."""
    for name in ("op:/obj/pyro/OUT.vdb", "op:/obj/pyro/OUT", "asset:smoke.vdb"):
        (tmp_path / "search" / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(assets / "cloud.vdb", tmp_path / "search" / name)
    (tmp_path / "search/op:/obj/pyro/empty.vdb").touch()
    Ar.DefaultResolver.SetDefaultSearchPath([str(tmp_path / "search")])
    try:
        found = lint_text(volume(f"asset filePath = @{path}@")).findings
    finally:
        Ar.DefaultResolver.SetDefaultSearchPath([])
    assert [each.code for each in found] == expected


def test_what_a_resolver_that_is_registered_does_not_find(
    lint_text: Lint, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is missing, and nothing else is known of it; no wheel of USD has such a resolver."""
    monkeypatch.setattr(Ar, "GetRegisteredURISchemes", lambda: ["asset"])
    paths = ("asset://show/fx/smoke.vdb", "asset:smoke.vdb", "ASSET://show/fx/smoke.0001.vdb")
    one, *others = (volume(f"asset filePath = @{path}@") for path in paths)
    for number, other in enumerate(others):
        one += other.replace("cloud", f"cloud_{number}").replace("#usda 1.0", "")
    assert said(lint_text(one)) == [f"AST002 no file at {path!r}" for path in paths]


@pytest.mark.parametrize(("resolved", "expected"), [("a.vdb", []), ("a", ["AST006"])])
@pytest.mark.parametrize("path", ["./a.vdb", "asset:a", "./a"])
def test_the_extension_that_counts_is_that_of_what_a_resolver_answers(
    path: str,
    resolved: str,
    expected: list[str],
    lint_text: Lint,
    assets: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    answer = str(shutil.copyfile(assets / "cloud.vdb", tmp_path / resolved))
    monkeypatch.setattr(classify, "_resolved_without_arguments", lambda *asked: answer)
    report = lint_text(volume(f"asset filePath = @{path}:SDF_FORMAT_ARGS:a=b.vdb@"))
    assert [each.code for each in report.findings] == expected


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


def test_a_path_in_a_package_may_have_format_arguments(lint_text: Lint, tmp_path: Path) -> None:
    package(tmp_path / "shot.usdz", "#usda 1.0\n", {"a.vdb": CONTENT})
    path = "./shot.usdz[a.vdb]:SDF_FORMAT_ARGS:b=c"
    assert said(lint_text(volume(f"asset filePath = @{path}@"))) == []


@pytest.mark.parametrize("where", [".", "elsewhere"])
def test_the_search_path_begins_with_the_folder_of_the_stage(
    where: str, engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A path without `./` in a layer of another folder, from whatever working directory."""
    write(tmp_path, "shot/cloud.vdb")
    for name, text in {
        "shot/root.usda": "#usda 1.0\n(\n    subLayers = [@./fx/smoke.usda@]\n)\n",
        "shot/fx/smoke.usda": volume("asset filePath = @cloud.vdb@"),
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / where)
    assert said(engine.lint(str(tmp_path / "shot" / "root.usda"))) == []
