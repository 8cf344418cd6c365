"""The files that fields name, there or not: what the rule pages can not show."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import UsdUtils
from stages import CONTENT, only, package, said, volume, write

import usdvol_lint.facts.files.classify as classify
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]


WRITE = " -> write or copy it there, or name a file that is there"


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
        ("vdb/gone.vdb", ["AST002 no file at 'vdb/gone.vdb' in 'shot.usdz'" + WRITE]),
        ("./vdb", ["AST002 no file at './vdb' in 'shot.usdz'" + WRITE]),
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
    assert said(engine.lint("shot.usdz")) == [
        f"AST002 no file at './vdb/gone.vdb' in 'shot.usdz'{WRITE}"
    ]


@pytest.mark.parametrize(
    ("start", "reason", "folder"),
    [
        ("./shot.usdz[gone/", ": no folder 'gone' in 'shot.usdz'", "shot.usdz[gone]"),
        ("./shot.usdz[vdb/gone/", ": no folder 'vdb/gone' in 'shot.usdz'", "shot.usdz[vdb/gone]"),
        ("./gone.usdz[vdb/", ": no package './gone.usdz'", "gone.usdz"),
        ("./shot.usdz[vdb/", " in 'shot.usdz'", None),
        ("./shot.usdz[", " in 'shot.usdz'", None),
        ("./shot.usdz[in.usdz[vdb/", " in 'shot.usdz'", None),
    ],
)
def test_fields_below_a_folder_that_a_package_lacks_are_told_in_one_line(
    start: str, reason: str, folder: str | None, lint_text: Lint, tmp_path: Path
) -> None:
    package(tmp_path / "shot.usdz", "#usda 1.0\n", {"vdb/b/cloud.vdb": CONTENT, "in.usdz": CONTENT})
    one, two = (f"{start}{name}.vdb]{']' * (start.count('[') - 1)}" for name in ("mist", "sparks"))
    first, second = (volume(f"asset filePath = @{path}@") for path in (one, two))
    report = lint_text(first + second.replace("cloud", "second").replace("#usda 1.0", ""))
    assert said(report) == [f"AST002 no file at '{path}'{reason}{WRITE}" for path in (one, two)]
    fold = folder and os.path.join(tmp_path, folder)
    assert [finding.fold for finding in report.findings] == [fold, fold]


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
        assert said(report) == [f"AST002 no file at {path!r}: {reason}{WRITE}"]


def test_a_symbolic_link_to_a_file_is_a_file(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "cloud.vdb")
    (tmp_path / "link.vdb").symlink_to("cloud.vdb")
    assert said(lint_text(volume("asset filePath = @./link.vdb@"))) == []


def test_bare_names_are_looked_for_beside_their_layer(lint_text: Lint, tmp_path: Path) -> None:
    write(tmp_path, "shot/cloud.vdb", "shot/smoke.0001.vdb")
    (tmp_path / "shot" / "a.usda").write_text(volume("asset filePath = @clod.vdb@"))
    (tmp_path / "shot" / "b.usda").write_text(volume("asset filePath = @smoke.$F4.vdb@"))
    stage = "#usda 1.0\n(\n    subLayers = [@./shot/{}.usda@]\n)\n"
    assert said(lint_text(stage.format("a"), "a.usda")) == [
        f"AST002 no file at 'clod.vdb' in '{tmp_path}/shot' -> did you mean 'cloud.vdb'?"
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
        '`"./${TAKE}.vdb"`': "AST002 no file at './clod.vdb' (from '`\"./${TAKE}.vdb\"`')" + WRITE,
        '`"./${NOPE}.vdb"`': (
            "AST004 the expression '`\"./${NOPE}.vdb\"`' needs a variable that is not set: NOPE -> "
            "set NOPE in expressionVariables of the root layer; USD does not read those of "
            "sublayers"
        ),
        '`"./${TAKE.vdb"`': (
            "AST004 the expression '`\"./${TAKE.vdb\"`' can't be evaluated: missing ending '}' at "
            'character 10 -> correct it, as in @`"./${NAME}.vdb"`@, or write a path without '
            "backticks"
        ),
        '`if(defined("NOPE"), "./${NOPE}.vdb", "./clod.vdb")`': (
            "AST002 no file at './clod.vdb' (from "
            '\'`if(defined("NOPE"), "./${NOPE}.vdb", "./clod.vdb")`\')' + WRITE
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
        "(1 of 1 samples, authored as frame 1)" + WRITE
    ]
