"""The files that fields name and the layers that stages name: what the rule pages can not show."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from usdvol_lint.catalog import Catalog
from usdvol_lint.config import Config, activate
from usdvol_lint.engine import Engine
from usdvol_lint.facts import assets as asset_facts
from usdvol_lint.facts.assets import is_uri
from usdvol_lint.facts.files import Absence, Files
from usdvol_lint.facts.patterns import find_pattern
from usdvol_lint.model import Finding, StageReport

Lint = Callable[..., StageReport]
CONTENT = b"x" * 2000


def volume(file_path: str, header: str = "") -> str:
    """A stage with one volume, whose one field names files as given."""
    return f"""#usda 1.0
{header}
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </cloud/density>

    def OpenVDBAsset "density"
    {{
        token fieldName = "density"
        token fieldDataType = "float"
        token fieldClass = "fogVolume"
        {file_path}
    }}
}}
"""


def findings(report: StageReport) -> list[Finding]:
    """Those of the rules about assets and stages, and what was not checked."""
    return [f for f in report.findings if f.code.startswith(("AST00", "AST014", "STG", "LNT"))]


def said(report: StageReport) -> list[str]:
    return [
        f"{finding.code} {finding.message}"
        + (f" -> {finding.suggestion}" if finding.suggestion else "")
        for finding in findings(report)
    ]


def only(report: StageReport) -> Finding:
    [finding] = findings(report)
    return finding


def write(folder: Path, *names: str) -> None:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(CONTENT)


def package(path: Path, stage: str, files: dict[str, bytes]) -> None:
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in {"root.usda": stage.encode(), **files}.items():
            archive.writestr(name, data)


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
    assert Files().absence(absolute, path) == expected


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


CLIPS = """
(
    subLayers = [@./fx.usda@]
)
def "cloud" (
    clips = {
        dictionary default = {
            string primPath = "/cloud"
            double2[] active = [(1, 0), (3, 1), (5, 2)]
            double2[] times = [(1, 1), (6, 6)]
            asset manifestAssetPath = @./manifest.usda@
            %s
        }
    }
)
{
}
"""


def write_clips(folder: Path) -> None:
    clip = '#usda 1.0\nover "cloud"\n{{\n    over "density"\n    {{\n        {}\n    }}\n}}\n'
    (folder / "fx.usda").write_text(volume(""))
    (folder / "manifest.usda").write_text(clip.format("asset filePath"))
    for number in range(3):
        samples = "".join(f"{t}: @./{number}.{t}.vdb@,\n" for t in (2 * number + 1, 2 * number + 2))
        (folder / f"clip.{number}.usda").write_text(
            clip.format(f"asset filePath.timeSamples = {{\n{samples}}}")
        )


def test_missing_frames_in_several_clips_name_their_layers(lint_text: Lint, tmp_path: Path) -> None:
    write_clips(tmp_path)
    write(tmp_path, "0.1.vdb", "0.2.vdb")
    clips = "asset[] assetPaths = [@./clip.0.usda@, @./clip.1.usda@, @./clip.2.usda@]"
    finding = only(lint_text("#usda 1.0\n" + CLIPS % clips))
    assert (finding.site.layer, finding.site.line, finding.site.frames, finding.message) == (
        "clip.1.usda",
        7,
        "3-6",
        "no file at './1.3.vdb' (4 of 6 samples, in 2 layers: clip.1.usda, clip.2.usda)",
    )


def test_a_clip_with_times_of_its_own(lint_text: Lint, tmp_path: Path) -> None:
    """The stage's frame is named, and the line is that of the clip's."""
    write_clips(tmp_path)
    write(tmp_path, "0.1.vdb")
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", "(101, 0)").replace(
        "(1, 1), (6, 6)", "(101, 1), (102, 2)"
    )
    finding = only(lint_text("#usda 1.0\n" + clips % "asset[] assetPaths = [@./clip.0.usda@]"))
    assert (finding.site.layer, finding.site.line, finding.site.frames, finding.message) == (
        "clip.0.usda",
        8,
        "102",
        "no file at './0.2.vdb' (1 of 2 samples)",
    )


def test_the_sample_that_usd_adds_where_a_clip_jumps_is_none(
    lint_text: Lint, tmp_path: Path
) -> None:
    write_clips(tmp_path)
    write(tmp_path, "0.1.vdb")
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", "(1, 0)")
    clips = clips.replace("(1, 1), (6, 6)", "(1, 1), (3, 3), (3, 1), (4, 2)")
    finding = only(lint_text("#usda 1.0\n" + clips % "asset[] assetPaths = [@./clip.0.usda@]"))
    assert (finding.site.frames, finding.message) == (
        "2, 4",
        "no file at './0.2.vdb' (2 of 4 samples)",
    )


@pytest.mark.parametrize("active", ["(1, 0), (3, 1), (5, 2)", "(1, 0)"])
@pytest.mark.parametrize("manifest", ["asset manifestAssetPath = @./manifest.usda@", ""])
def test_a_clip_that_can_not_be_read(
    active: str, manifest: str, lint_text: Lint, tmp_path: Path
) -> None:
    """The field has no path then, but the layer is to blame, not the field."""
    write_clips(tmp_path)
    (tmp_path / "broken.usda").write_text("#usda 1.0\ndef (")
    broken = ", ".join(["@./broken.usda@"] * active.count("("))
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", active)
    clips = clips.replace("asset manifestAssetPath = @./manifest.usda@", manifest)
    assert said(lint_text("#usda 1.0\n" + clips % f"asset[] assetPaths = [{broken}]")) == [
        "STG001 the clip './broken.usda' can't be read: broken.usda:2:1: unexpected 'def (' in "
        "</>; what it holds was not checked"
    ]


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


@pytest.mark.parametrize("others", ["", 'def OpenVDBAsset "other"\n{\n}\n'])
def test_a_manifest_that_can_not_be_read_is_one_finding(
    others: str, lint_text: Lint, tmp_path: Path
) -> None:
    """USD raises for it where a value is first asked for, whichever field that is of."""
    write_clips(tmp_path)
    (tmp_path / "manifest.usda").write_text("#usda 1.0\ndef (")
    clips = "asset[] assetPaths = [@./clip.0.usda@, @./clip.1.usda@, @./clip.2.usda@]"
    stage = f"#usda 1.0\n{CLIPS % clips}".removesuffix("}\n") + others + "}\n"
    report = lint_text(stage)
    about = [each for each in said(report) if each[:6] not in ("FLD001", "FLD002", "VOL012")]
    assert about == [
        "STG001 the clip manifest './manifest.usda' can't be read: manifest.usda:2:1: unexpected "
        "'def (' in </>; what it holds was not checked"
    ]


def test_clips_far_above_what_they_hold(lint_text: Lint) -> None:
    others = "".join(f'def Scope "other_{number}"\n{{\n}}\n' for number in range(1000))
    text = CLIPS.replace("subLayers = [@./fx.usda@]", "").replace("{\n}\n", "{%s}\n")
    inside = others + volume("asset filePath = @./a.vdb@").removeprefix("#usda 1.0\n")
    stage = "#usda 1.0\n" + text % ("asset[] assetPaths = [@./gone.usda@]", inside)
    assert "STG001" in [finding.code for finding in lint_text(stage).findings]


def test_a_clip_template_that_fits_no_file(lint_text: Lint, tmp_path: Path) -> None:
    write_clips(tmp_path)
    template = """string templateAssetPath = "./gone.#.usda"
            double templateStartTime = 1
            double templateEndTime = 6
            double templateStride = 1"""
    assert said(lint_text("#usda 1.0\n" + CLIPS % template)) == [
        "STG001 the clip template './gone.#.usda' does not exist; what it holds was not checked"
    ]


def test_expressions_in_a_usd_that_forgets_them(
    lint_text: Lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Old USD gives the evaluated path alone: what was written is found in the layer."""
    monkeypatch.setattr(asset_facts, "authored_path", lambda asset: "")
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


def test_payloads_that_were_not_loaded(
    catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lib.usda").write_text(volume("asset filePath = @./gone.vdb@"))
    payload = 'def "p{}" (\n    payload = @./lib.usda@</cloud>\n)\n{{\n}}\n'
    (tmp_path / "stage.usda").write_text("#usda 1.0\n" + "".join(map(payload.format, range(5))))
    engine = Engine(catalog.rules, activate(Config(select=("ALL",)), catalog), load="none")
    assert said(engine.lint("stage.usda")) == [
        "LNT005 5 payloads not loaded, what is below was not checked: /p0, /p1, /p2, …"
    ]


def test_missing_layers_are_known_by_their_place(lint_text: Lint, tmp_path: Path) -> None:
    """No absolute paths and no addresses: the report is the same on every machine."""
    (tmp_path / "lib.usda").write_text(
        "#usda 1.0\n(\n    subLayers = [@./sub.usda@]\n)\n"
        'def "a" (\n    references = @./other.usda@\n)\n{\n'
        '    def "c" (\n        references = </nope>\n    )\n    {\n    }\n}\n'
    )
    reference = 'def "p{}" (\n    references = @./lib.usda@</a>\n)\n{{\n}}\n'
    report = lint_text("#usda 1.0\n" + "".join(map(reference.format, range(3))))
    assert said(report) == [
        "STG001 the sublayer './sub.usda' does not exist; what it holds was not checked",
        "STG001 the reference './other.usda' does not exist; what it holds was not checked "
        "(on 3 prims)",
        "STG002 unresolved reference prim path @lib.usda@</nope> introduced by @lib.usda@</a/c> "
        "(on 3 prims)",
    ]
    assert [(f.site.layer, f.site.line) for f in findings(report)] == [
        ("lib.usda", 3),
        ("lib.usda", 6),
        ("lib.usda", 9),
    ]


def test_misspelt_layers(lint_text: Lint, tmp_path: Path) -> None:
    (tmp_path / "library.usda").write_text("#usda 1.0\n")
    report = lint_text('#usda 1.0\ndef "a" (\n    references = @./libary.usda@\n)\n{\n}\n')
    assert said(report) == [
        "STG001 the reference './libary.usda' does not exist; what it holds was not checked -> did "
        "you mean './library.usda'?"
    ]


def test_layers_that_are_there_and_do_not_open(lint_text: Lint, tmp_path: Path) -> None:
    """What is wrong with the file is said; where it lies on this machine is not."""
    (tmp_path / "empty.usda").touch()
    (tmp_path / "folder.usda").mkdir()
    (tmp_path / "broken.usda").write_text('#usda 1.0\ndef "a" (\n')
    names = ("empty", "folder", "broken")
    arcs = (f'def "{name}" (\n    references = @./{name}.usda@\n)\n{{\n}}\n' for name in names)
    broken, empty, folder = said(lint_text("#usda 1.0\n" + "".join(arcs)))
    unchecked = "; what it holds was not checked"
    assert (
        empty
        == f"STG001 the reference './empty.usda' can't be read: it is a file of 0 bytes{unchecked}"
    )
    assert (
        folder == f"STG001 the reference './folder.usda' can't be read: it is a folder{unchecked}"
    )
    assert broken.startswith("STG001 the reference './broken.usda' can't be read: ")
    assert str(tmp_path) not in broken


def test_unset_variables_in_arcs(lint_text: Lint) -> None:
    report = lint_text('#usda 1.0\ndef "a" (\n    references = @`"./${SET}.usda"`@\n)\n{\n}\n')
    assert said(report) == [
        "STG001 the reference '`\"./${SET}.usda\"`' does not exist; what it holds was not checked"
    ]


def test_samples_of_their_own_beside_a_clip_that_can_not_be_read(
    lint_text: Lint, tmp_path: Path
) -> None:
    """They are stronger than the clip, and checked; USD raises when asked where they stand."""
    write_clips(tmp_path)
    (tmp_path / "broken.usda").write_text("#usda 1.0\ndef (")
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", "(1, 0)").removesuffix("{\n}\n")
    own = 'over "density"\n{\n    asset filePath.timeSamples = {\n1: @./gone.vdb@,\n}\n}\n'
    stage = f"#usda 1.0\n{clips % 'asset[] assetPaths = [@./broken.usda@]'}{{\n{own}}}\n"
    assert said(lint_text(stage)) == [
        "STG001 the clip './broken.usda' can't be read: broken.usda:2:1: unexpected 'def (' in "
        "</>; what it holds was not checked",
        "AST002 no file at './gone.vdb' (1 of 1 samples)",
    ]
