"""What rules say where a condition turns, as far as the marks of a page can not show it."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest
from process import ASSETS, SAMPLES, run

from usdvol_lint.model import Finding, Severity, StageReport

Lint = Callable[..., StageReport]
CLOUD = ASSETS / "cloud.vdb"
FIELD3D = SAMPLES / "f3d_ogawa.f3d"
UNIT = "float3[] extent = [(0, 0, 0), (1, 1, 1)]"
TYPED = 'token fieldDataType = "float"'


def density(files: str, kind: str = "OpenVDBAsset", name: str = "density", more: str = "") -> str:
    return f"""
    def {kind} "density"
    {{
        {files}
        token fieldName = "{name}"
        token fieldDataType = "float"
        {more}
    }}
"""


def cloud(files: str, **more: str) -> str:
    """A Volume with one field."""
    return f"""
def Volume "cloud"
{{
    {UNIT}
    rel field:density = </cloud/density>
    {density(files, **more)}
}}
"""


def splats(arrays: str) -> str:
    """Two particles with what is given."""
    return f"""
def ParticleField3DGaussianSplat "splats"
{{
    {UNIT}
    point3f[] positions = [(0.2, 0.2, 0.2), (0.8, 0.8, 0.8)]
    uniform int radiance:sphericalHarmonicsDegree = 0
    float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1), (1, 1, 1)]
    {arrays}
}}
"""


def sampled(paths: Iterable[tuple[float, str]]) -> str:
    lines = "".join(f"{time}: @{path}@,\n" for time, path in paths)
    return f"asset filePath.timeSamples = {{\n{lines}}}"


def layer(path: Path, body: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#usda 1.0\n{body}\n", encoding="utf-8")


@pytest.fixture
def lint(lint_text: Lint, tmp_path: Path) -> Callable[..., list[Finding]]:
    """The findings of the codes named, of a stage beside `cloud.vdb`."""
    shutil.copy(CLOUD, tmp_path)

    def findings(body: str, *codes: str) -> list[Finding]:
        found = lint_text(f"#usda 1.0\n{body}").findings
        return [finding for finding in found if finding.code.startswith(codes)]

    return findings


FindIn = Callable[..., list[Finding]]


# --- severities ---


def test_a_severity_that_is_set_holds_for_milder_cases_too(tmp_path: Path) -> None:
    layer(tmp_path / "stage.usda", cloud("asset filePath = @foo://x/cloud.vdb@"))
    arguments = "--isolated", "--select", "AST010", "--output-format", "json", "stage.usda"
    assert _levels(run(*arguments, cwd=tmp_path).json) == ["info"]
    ran = run("--severity", "AST010=warning", *arguments, cwd=tmp_path)
    assert (ran.code, _levels(ran.json)) == (0, ["warning"])
    ran = run("--severity", "AST010=error", *arguments, cwd=tmp_path)  # which the rule has anyway
    assert (ran.code, _levels(ran.json)) == (1, ["error"])


def _levels(report: dict[str, list[dict[str, str]]]) -> list[str]:
    return [cause["severity"] for cause in report["causes"]]


# --- suggestions ---


def test_of_two_fields_equally_near_none_is_proposed(lint: FindIn) -> None:
    one, other = (f'def "{name}" {{{density("")}}}\n' for name in "ad")
    volume = f'def Volume "cloud" {{ {UNIT}\n rel field:density = </cloud/x/density>\n}}'
    [finding] = lint(one + volume, "VOL001")
    assert finding.suggestion == "did you mean </a/density>?"
    [finding] = lint(one + other + volume, "VOL001")
    assert finding.suggestion == "target a field that is there, or remove it"


@pytest.mark.parametrize("high", [19.9, 20, 25])
def test_scales_that_are_no_logarithms(high: float, lint: FindIn) -> None:
    """e^20 units is no size of a splat."""
    [finding] = lint(splats(f"float3[] scales = [(-3, -4, -5), (-3, -4, {high})]"), "ARR009")
    taken_for_logarithms = "apply exp(x)" in (finding.suggestion or "")
    assert taken_for_logarithms == (high < 20)
    assert taken_for_logarithms or finding.suggestion == "author sizes from 0"


@pytest.mark.parametrize(("count", "shown"), [(11, 11), (1000, 1000), (1001, 1000)])
def test_frames_to_paste(count: int, shown: int, lint: FindIn, tmp_path: Path) -> None:
    for number in range(1, count + 1):
        (tmp_path / f"fog.{number:04}.vdb").write_bytes(b"x")
    [finding] = lint(cloud("asset filePath = @./fog.####.vdb@"), "AST003")
    assert finding.suggestion is not None
    assert finding.suggestion.startswith(f"{count} files found: ")
    assert finding.suggestion.count(".vdb@") == shown
    assert finding.suggestion.endswith("@, … }" if shown < count else f"fog.{count:04}.vdb@ }}")


def test_a_layer_that_is_there_and_broken_is_no_slip_of_the_pen(
    lint: FindIn, tmp_path: Path
) -> None:
    (tmp_path / "scene_main.usda").write_text('#usda 1.0\ndef "cut', encoding="utf-8")
    layer(tmp_path / "scene_mein.usda", 'def "other" {}')
    [finding] = lint("(\n    subLayers = [@./scene_main.usda@]\n)", "STG001")
    assert "can't be read" in finding.message
    assert finding.suggestion == "correct that layer, or export it again"


# --- lists ---


def test_prims_without_extent_are_told_in_one_line(lint: FindIn) -> None:
    volumes = "".join(f'def Volume "v{number:02}" {{}}\n' for number in range(40))
    assert [(each.site.prim, each.message, each.fold) for each in lint(volumes, "SCH007")] == [
        (f"/v{number:02}", "Volume without an extent, so USD takes its bounds for empty", "extent")
        for number in range(40)
    ]


NO_TYPE, EMPTY_TYPE = "no fieldDataType", "fieldDataType is empty"


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (("",), {"/f0": NO_TYPE}),
        (('token fieldDataType = ""',), {"/f0.fieldDataType": EMPTY_TYPE}),
        ((TYPED, ""), {"/f1": NO_TYPE}),
        (
            ("", TYPED, 'token fieldDataType = ""'),
            {"/f0": NO_TYPE, "/f2.fieldDataType": EMPTY_TYPE},
        ),
        (("",) * 40, {f"/f{number}": NO_TYPE for number in range(40)}),
    ],
    ids=["one", "empty", "other", "mixed", "many"],
)
def test_fields_without_a_data_type_are_told_in_one_line(
    lines: tuple[str, ...], said: dict[str, str], lint: FindIn
) -> None:
    fields = "".join(
        f'def OpenVDBAsset "f{number}"\n{{\n{line}\n}}\n' for number, line in enumerate(lines)
    )
    found = lint(fields, "FLD002")
    assert {each.fold for each in found} == {"fieldDataType"}
    assert len(found) == len(said)
    places = (".".join(filter(None, (each.site.prim, each.site.property))) for each in found)
    assert dict(zip(places, [each.message for each in found], strict=True)) == said


# --- contents ---


def test_field3d_has_no_classes(lint: FindIn, tmp_path: Path) -> None:
    shutil.copy(FIELD3D, tmp_path / "x.f3d")
    found = lint(cloud("asset filePath = @./x.f3d@", more='token fieldClass = "fogVolume"'), "GRD")
    assert {finding.code for finding in found} == {"GRD009"}


def test_values_of_a_type_that_was_not_understood_are_no_other_type(
    lint: FindIn, tmp_path: Path
) -> None:
    data = FIELD3D.read_bytes()
    ends = [found.end() for found in re.finditer(rb"(?s)bits_per_component.{32}", data)]
    for end in ends:
        data = data[:end] + b"\x18" + data[end + 1 :]  # 24 bits
    (tmp_path / "x.f3d").write_bytes(data)
    more = 'token fieldPurpose = "smoke"'
    path = "asset filePath = @./x.f3d@"
    assert not lint(cloud(path, kind="Field3DAsset", name="v", more=more), "GRD")
    shutil.copy(FIELD3D, tmp_path / "x.f3d")
    [finding] = lint(cloud(path, kind="Field3DAsset", name="v", more=more), "GRD")
    assert finding.code == "GRD005"


# --- value clips ---

CLIPPED = """
def Volume "cloud" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [%s]
            double2[] active = [%s]
            double2[] times = [(1, 1), (9, 9)]
            string primPath = "/cloud"
            asset manifestAssetPath = @./manifest.usda@
        }
    }
)
{
    rel field:density = </cloud/density>
    %s
}
"""
OVER = 'over "cloud"\n{\n    over "density"\n    {\n        %s\n    }\n}'


def clipped(folder: Path, field: str, manifest: str, *clips: str) -> str:
    """A Volume with clips that hold what is given, and a manifest that does."""
    layer(folder / "manifest.usda", OVER % manifest)
    for number, clip in enumerate(clips, start=1):
        layer(folder / f"clip{number}.usda", OVER % clip)
    paths = ", ".join(f"@./clip{number}.usda@" for number in range(1, len(clips) + 1))
    active = ", ".join(f"({number + 1}, {number})" for number in range(len(clips)))
    return CLIPPED % (paths, active, density(field))


@pytest.mark.parametrize(
    ("manifest", "code"),
    [("", "AST014"), ("uniform asset filePath", "AST014"), ("asset filePath", "FLD006")],
)
def test_a_default_hides_no_clips_that_bring_nothing(
    manifest: str, code: str, lint: FindIn, tmp_path: Path
) -> None:
    clips = [sampled([(time, f"./smoke/smoke.000{time}.vdb")]) for time in (1, 2)]
    text = clipped(tmp_path, "asset filePath = @./cloud.vdb@", manifest, *clips)
    [finding] = lint(text, "AST", "FLD")
    assert finding.code == code
    assert finding.severity == Severity.WARNING


def test_a_first_clip_without_samples_hides_no_other(lint: FindIn, tmp_path: Path) -> None:
    text = clipped(tmp_path, "", "", "", sampled([(2, "./cloud.vdb")]))
    [finding] = lint(text, "AST")
    assert finding.code == "AST014"
    assert finding.message.startswith("the clip 'clip2.usda' holds filePath")


def test_every_clip_that_lacks_its_file_is_named(lint: FindIn, tmp_path: Path) -> None:
    clips = [sampled([(time, f"./gone.{time}.vdb")]) for time in (1, 2, 3)]
    [finding] = lint(clipped(tmp_path, "", "asset filePath", *clips), "AST")
    assert finding.code == "AST002"
    assert finding.message.endswith("in 3 layers: clip1.usda, clip2.usda, clip3.usda)")


def test_format_arguments_lead_from_the_layer_that_holds_them(lint: FindIn, tmp_path: Path) -> None:
    """The same path in two folders is two files."""
    for folder, present in (("a", True), ("b", False)):
        path = "asset filePath = @./fog.vdb:SDF_FORMAT_ARGS:x=1@"
        layer(tmp_path / folder / "cloud.usda", cloud(path))
        if present:
            shutil.copy(CLOUD, tmp_path / folder / "fog.vdb")
    for first, second in ("ab", "ba"):
        text = "".join(
            f'def "{name}" (references = @./{folder}/cloud.usda@</cloud>) {{}}\n'
            for name, folder in (("first", first), ("second", second))
        )
        [finding] = lint(text, "AST002")
        assert finding.site.prim == f"/{'first' if first == 'b' else 'second'}/density"


# --- sequences ---


@pytest.mark.parametrize(("numbers", "gap"), [((1, 2, 3, 9, 10), "4-8"), ((1, 2, 3, 10, 11), None)])
def test_more_missing_than_there_are_two_ranges(
    numbers: tuple[int, ...], gap: str | None, lint: FindIn, tmp_path: Path
) -> None:
    for number in numbers:
        shutil.copy(CLOUD, tmp_path / f"s.{number:04}.vdb")
    text = cloud(sampled([(number, f"./s.{number:04}.vdb") for number in numbers]))
    assert [f.site.frames for f in lint(text, "AST011")] == ([gap] if gap else [])


# --- where fields stand, what they hold ---

APART = """
def Xform "world"
{{
    double3 xformOp:translate = ({field}, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    {density}
}}
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    double3 xformOp:translate = ({volume}, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    rel field:density = </world/density>
}}
"""


@pytest.mark.parametrize(
    ("field", "volume", "moved"),
    [("1000000", "1000000.00001", False), ("1000000", "1000002", True), ("0", "0.00001", True)],
)
def test_rounding_far_from_the_origin(field: str, volume: str, moved: bool, lint: FindIn) -> None:
    file = density("asset filePath = @./cloud.vdb@")
    found = lint(APART.format(field=field, volume=volume, density=file), "VOL015")
    assert bool(found) == moved


def test_an_extent_that_never_changes_has_no_times(lint: FindIn) -> None:
    small = cloud("asset filePath = @./cloud.vdb@").replace("(1, 1, 1)", "(0.1, 0.1, 0.1)")
    [finding] = lint(small, "VOL013")
    assert (finding.site.times, finding.site.at_default) == ((), False)
