"""Stages of one run that compose each other: what is absent in one and there in another is fine."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from itertools import permutations
from pathlib import Path

import pytest
from process import ROOT, run
from pxr import UsdUtils

from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import USD_TOO_OLD, Catalog
from usdvol_lint.run.parts import without_completed

Files = dict[str, str]
Judge = Callable[..., list[str]]
PUFF = ROOT / "rules" / "assets" / "puff"
EXTENT = "float3[] extent = [(-1, -1, -1), (3, 3, 3)]"
HEAD = '#usda 1.0\n(\n    upAxis = "Y"\n    metersPerUnit = 1\n%s\n)\n'


def layer(text: str, *lines: str) -> str:
    return HEAD % "\n".join(lines) + text


def sublayers(*names: str) -> str:
    return f"subLayers = [{', '.join(f'@./{name}.usda@' for name in names)}]"


def over(name: str, inside: str, meta: str = "", what: str = "over") -> str:
    return f'{what} "{name}" {meta}\n{{\n{inside}\n}}\n'


def field(inside: str = "", name: str = "density", what: str = "def OpenVDBAsset") -> str:
    data = '\ntoken fieldDataType = "float"\n' if "fieldDataType" not in inside else "\n"
    return over(name, f"{data}{inside}", what=what)


def volume(inside: str, name: str = "smoke", meta: str = "") -> str:
    return over(name, inside, meta, what="def Volume")


NAME = 'token fieldName = "density"'
FILE = "asset filePath = @./puff.0001.vdb@"
BOUND = f"{EXTENT}\nrel field:density = <density>\n"
WHOLE = volume(BOUND + "\n" + field(f"{NAME}\n{FILE}"))
ROOT_PRIM = 'defaultPrim = "smoke"'
REFERENCE = "(prepend references = @./asset.usda@)"
SPLAT = "point3f[] positions = [(0, 0, 0), (1, 1, 1)]\nfloat[] opacities = [1, 1]\n"
COLOUR = (
    "uniform int radiance:sphericalHarmonicsDegree = 0\n"
    "float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1), (0, 1, 1)]\n"
)


def splats(inside: str, meta: str = "", what: str = "def ParticleField3DGaussianSplat") -> str:
    return over("splats", inside, meta, what=what)


@pytest.fixture
def judge(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Judge:
    """What is told of a run over these layers: file, code, level and place of each finding."""
    monkeypatch.chdir(tmp_path)
    for file in PUFF.iterdir():
        shutil.copy(file, tmp_path)

    def call(layers: Files, names: Sequence[str] = ()) -> list[str]:
        for name, text in layers.items():
            (tmp_path / f"{name}.usda").write_text(text, encoding="utf-8")
        engine = Engine(catalog.rules, activate(Config(), catalog))
        stages = [engine.lint(f"{name}.usda") for name in names or sorted(layers)]
        return told(without_completed(stages))

    return call


def told(stages: Sequence[StageReport]) -> list[str]:
    return [
        f"{stage.path.removesuffix('.usda')} {each.code} {each.severity.label}"
        for stage in stages
        for each in stage.findings
        if each.code != USD_TOO_OLD.code
    ]


def clips(keys: str, what: str = "def", inside: str = "") -> str:
    return over("smoke", inside, f"(clips = {{ dictionary default = {{\n{keys}\n}} }})", what=what)


ACTIVE = "double2[] active = [(1, 0), (2, 1)]\ndouble2[] times = [(1, 1), (2, 2)]"
PATHS = 'asset[] assetPaths = [@./c1.usda@, @./c2.usda@]\nstring primPath = "/smoke"'
MANIFEST = "asset manifestAssetPath = @./manifest.usda@"
RANGE = ("startTimeCode = 1", "endTimeCode = 2", "timeCodesPerSecond = 24", "framesPerSecond = 24")


def clip(number: int, what: str = "def") -> str:
    samples = f"asset filePath.timeSamples = {{ {number}: @./puff.000{number}.vdb@ }}"
    types = ("def Volume", "def OpenVDBAsset") if what == "def" else ("over", "over")
    return layer(over("smoke", over("density", samples, what=types[1]), what=types[0]))


COMPLETED: dict[str, tuple[Files, set[str]]] = {
    "caches in a stronger layer": (
        {
            "base": layer(volume(BOUND + field(NAME)), *RANGE),
            "shot": layer(
                over(
                    "smoke",
                    over(
                        "density",
                        "asset filePath.timeSamples = "
                        "{ 1: @./puff.0001.vdb@, 2: @./puff.0002.vdb@ }",
                    ),
                ),
                sublayers("base"),
                *RANGE,
            ),
        },
        {"base AST001 error"},
    ),
    "declared, or empty, or blocked": (
        {
            "asset": layer(volume(BOUND + field(f"{NAME}\nasset filePath")), ROOT_PRIM),
            "blank": layer(volume(BOUND + field(f"{NAME}\nasset filePath = @@")), ROOT_PRIM),
            "block": layer(volume(BOUND + field(f"{NAME}\nasset filePath = None")), ROOT_PRIM),
            "shot": layer(
                "".join(
                    over(
                        f"s_{name}",
                        over("density", FILE),
                        f"(prepend references = @./{name}.usda@)",
                        what="def",
                    )
                    for name in ("asset", "blank", "block")
                )
            ),
        },
        {"asset AST001 info", "blank AST001 error", "block AST001 error"},
    ),
    "a rig that names the fields of a cache": (
        {
            "cache": layer(over("fx", field(f"{NAME}\n{FILE}"), what="def Scope")),
            "rig": layer(
                over("fx", volume(f"{EXTENT}\nrel field:density = </fx/density>"), what="def Scope")
            ),
            "shot": layer("", sublayers("cache", "rig")),
        },
        {"rig VOL001 error"},
    ),
    "two sublayers that need each other": (
        {
            "one": layer(
                volume(f"{EXTENT}\nrel field:density = </smoke/density>", "smoke")
                + volume(field(f"{NAME}\n{FILE}"), "fire")
            ),
            "two": layer(
                over("smoke", field(f"{NAME}\n{FILE}"))
                + over("fire", f"{EXTENT}\nrel field:density = </fire/density>")
            ),
            "shot": layer("", sublayers("one", "two")),
        },
        {"one SCH007 warning", "one VOL001 error", "one VOL010 warning"},
    ),
    "an asset in which the shot selects a version": (
        {
            "asset": layer(
                volume(
                    BOUND
                    + field(NAME)
                    + 'variantSet "version" = {\n"v1" {\n'
                    + over("density", FILE)
                    + "}\n}\n",
                    meta='(prepend variantSets = "version")',
                ),
                ROOT_PRIM,
            ),
            "shot": layer(
                over(
                    "smoke",
                    "",
                    '(prepend references = @./asset.usda@\nvariants = { string version = "v1" })',
                    what="def",
                )
            ),
        },
        {"asset AST001 error"},
    ),
    "a variant that defines the field": (
        {
            "asset": layer(
                volume(
                    f"{BOUND}\n"
                    + 'variantSet "version" = {\n"v1" {\n'
                    + field(f"{NAME}\n{FILE}")
                    + "}\n}\n",
                    meta='(prepend variantSets = "version")',
                ),
                ROOT_PRIM,
            ),
            "shot": layer(
                over(
                    "smoke",
                    "",
                    '(prepend references = @./asset.usda@\nvariants = { string version = "v1" })',
                    what="def",
                )
            ),
        },
        {"asset VOL001 error"},
    ),
    "an assembly that says nothing of the prim": (
        {
            "asset": layer(volume(BOUND + field(NAME)), ROOT_PRIM),
            "assembly": layer(over("set", over("fog", "", REFERENCE, "def"), what="def Xform")),
            "shot": layer(over("set", over("fog", over("density", FILE))), sublayers("assembly")),
        },
        {"asset AST001 error", "assembly AST001 error"},
    ),
    "names, with the files": (
        {
            "asset": layer(volume(BOUND + field()), ROOT_PRIM),
            "shot": layer(over("smoke", over("density", f"{NAME}\n{FILE}"), REFERENCE, "def")),
        },
        {"asset AST001 error", "asset FLD001 warning"},
    ),
    "positions in the shot": (
        {
            "asset": layer(splats(EXTENT), 'defaultPrim = "splats"'),
            "shot": layer(splats(SPLAT + COLOUR, REFERENCE, "def")),
        },
        {"asset ARR001 warning"},
    ),
    "positions in half precision, and colours": (
        {
            "asset": layer(splats(EXTENT), 'defaultPrim = "splats"'),
            "colour": layer(splats(f"{EXTENT}\n{SPLAT}"), 'defaultPrim = "splats"'),
            "shot": layer(
                splats(
                    SPLAT.replace("point3f[] positions", "point3h[] positionsh") + COLOUR,
                    REFERENCE,
                    "def",
                )
                + over("more", COLOUR, "(prepend references = @./colour.usda@)", "def")
            ),
        },
        {"asset ARR001 warning", "colour ARR017 warning"},
    ),
    "what a Volume declares": (
        {
            "asset": layer(
                volume(f"{EXTENT}\nrel field:density")
                + volume(BOUND + over("density", ""), "fire")
                + volume(BOUND + over("density", "", what="def"), "fog")
            ),
            "shot": layer(
                over("smoke", BOUND + field(f"{NAME}\n{FILE}"))
                + "".join(over(each, field(f"{NAME}\n{FILE}")) for each in ("fire", "fog")),
                sublayers("asset"),
            ),
        },
        {"asset VOL002 error", "asset VOL003 warning", "asset VOL008 error"},
    ),
    "an extent": (
        {
            "asset": layer(volume(BOUND.replace(EXTENT, "") + field(f"{NAME}\n{FILE}")), ROOT_PRIM),
            "shot": layer(over("smoke", EXTENT, REFERENCE, "def")),
        },
        {"asset SCH007 warning"},
    ),
    "a hint of the model above": (
        {
            "asset": layer(volume(BOUND.replace(EXTENT, "") + field(f"{NAME}\n{FILE}")), ROOT_PRIM),
            "shot": layer(
                over(
                    "set",
                    "float3[] extentsHint = [(-1, -1, -1), (3, 3, 3)]\n"
                    + over("smoke", "", REFERENCE, "def"),
                    '(kind = "component")',
                    "def Xform",
                )
            ),
        },
        {"asset SCH007 warning"},
    ),
    "fields": (
        {
            "asset": layer(volume(EXTENT), ROOT_PRIM),
            "fields": layer(field(f"{NAME}\n{FILE}"), 'defaultPrim = "density"'),
            "shot": layer(
                over(
                    "smoke",
                    "rel field:density = <density>\n"
                    + over("density", "", "(prepend references = @./fields.usda@)", "def"),
                    REFERENCE,
                    "def",
                )
            ),
        },
        {"asset VOL010 info", "fields VOL012 info"},
    ),
    "prims that another layer defines": (
        {
            "fx": layer(over("set", over("fx", WHOLE), what="def Xform")),
            "layout": layer(over("set", over("fx", "", what="def Xform"), what="def Xform")),
            "other": layer(over("effects", WHOLE) + over("efects", "", what="def Xform")),
            "sets": layer(over("effects", "", what="def Xform")),
            "all": layer("", sublayers("other", "sets")),
            "shot": layer("", sublayers("fx", "layout")),
        },
        {"fx STG005 info", "other STG005 warning"},
    ),
    "a type": (
        {
            "asset": layer(WHOLE.replace("def Volume", "def"), ROOT_PRIM),
            "shot": layer(over("smoke", "", REFERENCE, "def Volume")),
        },
        {"asset SCH014 warning"},
    ),
    "an empty sublayer": (
        {"empty": layer(""), "shot": layer(WHOLE, sublayers("empty"))},
        {"empty STG003 warning"},
    ),
    "what the clips need": (
        {
            "asset": layer(
                clips(PATHS, "def Volume", BOUND + field(NAME)),
                *RANGE,
                ROOT_PRIM,
            ),
            "c1": clip(1, "over"),
            "c2": clip(2, "over"),
            "shot": layer(
                clips(ACTIVE).replace("(clips", "(prepend references = @./asset.usda@\nclips"),
                *RANGE,
            ),
        },
        {"asset AST016 error"},
    ),
    "clips with their manifest": (
        {
            "c1": clip(1),
            "c2": clip(2),
            "manifest": layer(over("smoke", field("asset filePath"), what="def Volume")),
            "topology": layer(volume(BOUND + field(f"{NAME}\nasset filePath")), *RANGE),
            "result": layer(
                clips(f"{PATHS}\n{ACTIVE}\n{MANIFEST}", "over"), sublayers("topology"), *RANGE
            ),
        },
        {"c1 FLD001 warning", "c1 SCH007 warning", "manifest AST001 info", "topology AST001 info"},
    ),
}


@pytest.mark.parametrize("name", COMPLETED)
def test_what_another_stage_has_is_not_told(judge: Judge, name: str) -> None:
    layers, absent = COMPLETED[name]
    alone = [line for each in layers for line in judge(layers, [each])]
    assert absent <= set(alone)
    assert judge(layers) == []
    assert judge(layers, sorted(layers, reverse=True)) == []


BASE = volume(BOUND + field(NAME))
WRONG = "asset filePath = @./pufff.0001.vdb@"
STAYS: dict[str, tuple[Files, list[str]]] = {
    "a part that nobody composes": (
        {"asset": layer(BASE, ROOT_PRIM), "shot": layer(WHOLE)},
        ["asset AST001 error"],
    ),
    "a part without a stage that completes it": (
        {"asset": layer(BASE, ROOT_PRIM), "shot": layer(over("smoke", "", REFERENCE, "def"))},
        ["asset AST001 error", "shot AST001 error"],
    ),
    "a declaration that no stage gives a value": (
        {
            "asset": layer(volume(BOUND + field(f"{NAME}\nasset filePath")), ROOT_PRIM),
            "shot": layer(over("smoke", "", REFERENCE, "def")),
        },
        ["asset AST001 info", "shot AST001 error"],
    ),
    "what is wrong in a part, and put right elsewhere": (
        {
            "asset": layer(volume(BOUND + field(f"{NAME}\n{WRONG}")), ROOT_PRIM),
            "shot": layer(over("smoke", over("density", FILE), REFERENCE, "def")),
        },
        ["asset AST002 error"],
    ),
    "a wrong name that another stage brings": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(over("smoke", over("density", WRONG), REFERENCE, "def")),
        },
        ["shot AST002 error"],
    ),
    "an empty path that another stage brings": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(over("smoke", over("density", "asset filePath = @@"), REFERENCE, "def")),
        },
        ["shot AST001 error"],
    ),
    "a shot that lacks what another shot brings to their asset": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "bare": layer(over("smoke", "", REFERENCE, "def")),
            "shot": layer(over("smoke", over("density", FILE), REFERENCE, "def")),
        },
        ["bare AST001 error"],
    ),
    "one of two places of an asset": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(
                over("one", over("density", FILE), REFERENCE, "def")
                + over("two", "", REFERENCE, "def")
            ),
        },
        ["shot AST001 error"],
    ),
    "a version that the shot does not select": (
        {
            "asset": layer(
                volume(
                    BOUND
                    + field(NAME)
                    + 'variantSet "version" = {\n"v1" {\n'
                    + over("density", FILE)
                    + "}\n}\n",
                    meta='(prepend variantSets = "version")',
                ),
                ROOT_PRIM,
            ),
            "shot": layer(over("smoke", "", REFERENCE, "def")),
        },
        ["asset AST001 error", "shot AST001 error"],
    ),
    "a target that is nowhere": (
        {
            "cache": layer(over("fx", field(f"{NAME}\n{FILE}"), what="def Scope")),
            "rig": layer(
                over("fx", volume(f"{EXTENT}\nrel field:density = </fx/denstiy>"), what="def Scope")
            ),
            "shot": layer("", sublayers("cache", "rig")),
        },
        ["cache VOL012 info", "rig VOL001 error", "shot VOL001 error"],
    ),
    "positions without extent": (
        {
            "asset": layer(splats(""), 'defaultPrim = "splats"'),
            "shot": layer(splats(SPLAT + COLOUR, REFERENCE, "def")),
        },
        ["asset SCH007 warning", "shot SCH007 warning"],
    ),
    "an empty stage": ({"empty": layer(""), "shot": layer(WHOLE)}, ["empty STG003 warning"]),
}


@pytest.mark.parametrize("name", STAYS)
def test_what_is_wrong_is_told(judge: Judge, name: str) -> None:
    layers, wanted = STAYS[name]
    assert judge(layers) == wanted


def write(folder: Path, layers: Files) -> None:
    for file in PUFF.iterdir():
        shutil.copy(file, folder)
    for name, text in layers.items():
        (folder / f"{name}.usda").write_text(text, encoding="utf-8")


def test_a_run_hangs_on_neither_workers_nor_order(tmp_path: Path) -> None:
    write(tmp_path, COMPLETED["two sublayers that need each other"][0])
    names = ["one.usda", "two.usda", "shot.usda"]
    for each in permutations(names):
        ran = run("--jobs", "2", *each, cwd=tmp_path)
        assert (ran.code, ran.err) == (0, "")
        assert "no findings in 3 stages" in ran.out
    assert run("one.usda", "two.usda", cwd=tmp_path).code == 1
    assert run("one.usda", cwd=tmp_path).code == 1


def test_stages_are_compared_by_what_they_are(tmp_path: Path) -> None:
    """A part that is reached through links is the same, whoever goes through one."""
    folder = tmp_path / "v002"
    folder.mkdir()
    write(folder, {"asset": layer(BASE, ROOT_PRIM)})
    (tmp_path / "current").symlink_to(folder, target_is_directory=True)
    (tmp_path / "link.usda").symlink_to(folder / "asset.usda")
    reference = REFERENCE.replace("./asset", "./current/asset")
    given = FILE.replace("./", "./v002/")
    shot = over("smoke", over("density", given), reference, "def")
    (tmp_path / "shot.usda").write_text(layer(shot), encoding="utf-8")
    for part in ("v002/asset.usda", "current/asset.usda", "link.usda"):
        assert run(part, cwd=tmp_path).code == 1
        assert run(part, "shot.usda", cwd=tmp_path).code == 0


def test_packages_are_parts_too(tmp_path: Path) -> None:
    write(tmp_path, {"asset": layer(BASE, ROOT_PRIM)})
    assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "asset.usda"), str(tmp_path / "asset.usdz"))
    reference = REFERENCE.replace("usda", "usdz")
    shot = over("smoke", over("density", FILE), reference, "def")
    (tmp_path / "shot.usda").write_text(layer(shot), encoding="utf-8")
    assert run("asset.usdz", cwd=tmp_path).code == 1
    assert run("asset.usdz", "shot.usda", cwd=tmp_path).code == 0


def test_reports_say_what_a_stage_completes(tmp_path: Path) -> None:
    write(tmp_path, COMPLETED["a rig that names the fields of a cache"][0])
    (rig,) = run("rig.usda", "--output-format", "json", cwd=tmp_path).json["stages"]
    (shot,) = run("shot.usda", "--output-format", "json", cwd=tmp_path).json["stages"]
    assert rig["completes"] is None
    assert shot["completes"] == {
        "layers": ["cache.usda", "rig.usda"],
        "specs": [
            {"layers": ["cache.usda"], "path": "/fx/density", "lacking": ["field:"]},
            {"layers": ["rig.usda"], "path": "/fx/smoke", "lacking": ["field:density"]},
        ],
    }


def test_a_whole_stage_completes_nothing(engine: Engine, tmp_path: Path) -> None:
    """Also where it is of several layers, each whole, one of which refers to another."""
    write(tmp_path, {"asset": layer(WHOLE, ROOT_PRIM)})
    middle = over("smoke", "", REFERENCE, "def")
    (tmp_path / "middle.usda").write_text(layer(middle, ROOT_PRIM), encoding="utf-8")
    shot = over("smoke", "", REFERENCE.replace("asset", "middle"), "def")
    (tmp_path / "shot.usda").write_text(layer(shot), encoding="utf-8")
    for name in ("asset", "middle", "shot"):
        assert engine.lint(str(tmp_path / f"{name}.usda")).completes is None
