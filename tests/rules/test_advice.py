"""What findings say and advise in each of their cases, which the marks of a page do not show."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ASSETS

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]
POSITIONS = "point3f[] positions = [(0.2, 0.2, 0.2), (0.8, 0.8, 0.8)]"
DEGREE = "uniform int radiance:sphericalHarmonicsDegree"
COEFFICIENTS = "float3[] radiance:sphericalHarmonicsCoefficients"
HALF_COEFFICIENTS = "half3[] radiance:sphericalHarmonicsCoefficientsh"
GREY = f"{DEGREE} = 0\n    {COEFFICIENTS} = [(1, 1, 1), (1, 1, 1)]"


def splats(*lines: str) -> str:
    """Two particles, grey unless the lines say more of their radiance."""
    body = "\n    ".join((POSITIONS, *lines))
    body += "" if "radiance" in body or "displayColor" in body else f"\n    {GREY}"
    return f"""
def ParticleField3DGaussianSplat "splats"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    {body}
}}
"""


def field(*lines: str, data_type: str = 'token fieldDataType = "float"') -> str:
    body = "\n        ".join(lines)
    return f"""
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </cloud/density>
    def OpenVDBAsset "density"
    {{
        token fieldName = "density"
        {data_type}
        {body}
    }}
}}
"""


def told(report: StageReport, code: str) -> tuple[str, str, str]:
    """Level, message and suggestion of the only finding with the code."""
    [finding] = [finding for finding in report.findings if finding.code == code]
    return finding.severity.label, finding.message, finding.suggestion or ""


@pytest.mark.parametrize(
    ("opacities", "remedy"),
    [
        ("1, 2", "clamp"),  # half of them is not most of them
        ("-99, 31", "sigmoid"),
        ("-100, 31", "clamp"),
        ("2, 31", "sigmoid"),
        ("2, 32", "divide them by 255"),
        ("-0.5, 32", "clamp"),
        ("40, 255", "look like bytes: divide them by 255"),
        ("40.5, 100.5", "look like bytes: divide them by 255"),
        ("40, 101", "look like bytes: divide them by 255"),
        ("40, 100", "bytes or percentages: divide them by 255, or by 100, before"),
        ("40.5, 100", "percentages: divide them by 100 before"),
        ("40, 256", "clamp"),
        ("0.5, 200", "clamp"),
    ],
)
def test_remedies_for_opacities(opacities: str, remedy: str, lint_text: Lint) -> None:
    report = lint_text("#usda 1.0" + splats(f"float[] opacities = [{opacities}]"))
    assert remedy in told(report, "ARR008")[2]


@pytest.mark.parametrize(
    ("scales", "level", "advice"),
    [
        ("(-3, -3, -3), (-4, -4, -4)", "error", "apply exp(x)"),
        ("(-3, -3, -3), (4, 4, 4)", "warning", "author sizes"),
        ("(-3, -3, -3), (-50, -4, -4)", "error", "author sizes"),
        ("(-3, -3, -3), (-49, -4, -4)", "error", "apply exp(x)"),
    ],
)
def test_advice_for_scales(scales: str, level: str, advice: str, lint_text: Lint) -> None:
    report = lint_text("#usda 1.0" + splats(f"float3[] scales = [{scales}]"))
    found, _, suggestion = told(report, "ARR009")
    assert (found, advice in suggestion) == (level, True)


@pytest.mark.parametrize(
    ("code", "lines", "message", "advice"),
    [
        (
            "ARR016",
            ('uniform token colorSpace:name = "srgb_rec709_scenes"',),
            "USD does not read the colour space 'srgb_rec709_scenes'",
            "did you mean 'srgb_rec709_scene'?",
        ),
        (
            "ARR016",
            ('uniform token colorSpace:name = "house"',),
            "USD does not read the colour space 'house'",
            "name one that USD has, such as 'lin_rec709_scene'",
        ),
        (
            "ARR012",
            ("float[] opacities = [1, 1]", "half[] opacitiesh = [1, 1]"),
            "'opacities' counts, so 'opacitiesh' is never read",
            "",
        ),
        (
            "ARR012",
            ("float[] opacities = [1, 1]", "half[] opacitiesh = [1]"),
            "'opacities' counts, so 'opacitiesh' is never read; they differ in size: ",
            "",
        ),
        (
            "ARR017",
            ("color3f[] primvars:displayColor = [(1, 0, 0)]",),
            "mid-grey: 'primvars:displayColor' is not read",
            "author degree 0 and for each colour",
        ),
        ("ARR017", (f"{DEGREE} = 0",), "every particle is mid-grey", "author radiance:spherical"),
        (
            "ARR004",
            (f"{COEFFICIENTS} = [(1, 1, 1), (1, 1, 1)]",),
            "1 for each particle; degree 3, what USD falls back to, takes 16",
            "author radiance:sphericalHarmonicsDegree = 0, which fits",
        ),
        (
            "ARR004",
            (f"{DEGREE} = 0", f"{COEFFICIENTS} = [(1, 1, 1)]"),
            "1 coefficient for 2 particles; degree 0 takes 1 for each",
            "author 1 coefficient for each position",
        ),
        (
            "ARR004",
            (f"{DEGREE} = 1", f"{COEFFICIENTS} = [(1, 1, 1)]"),
            "; degree 1 takes 4 for each",
            "author 4 coefficients for each position",
        ),
        (
            "ARR005",
            (f"{DEGREE} = -1",),
            "degree -1, which no number",
            "author a degree from 0 to 3",
        ),
        (
            "ARR005",
            (f"{DEGREE} = -1", f"{COEFFICIENTS} = [(1, 1, 1), (1, 1, 1)]"),
            "degree -1, which no number of coefficients fits",
            "author 0, which fits the coefficients",
        ),
    ],
)
def test_particles(
    code: str, lines: tuple[str, ...], message: str, advice: str, lint_text: Lint
) -> None:
    _, said, suggestion = told(lint_text("#usda 1.0" + splats(*lines)), code)
    assert message in said
    assert advice in suggestion
    for further in (" differ in size", ", beyond the", "displayColor", "falls back"):
        assert (further in said) == (further in message)


@pytest.mark.parametrize(
    ("code", "lines", "message", "advice"),
    [
        ("AST001", (), "no filePath", ""),
        ("AST001", ("asset filePath",), "filePath has no value", ""),
        ("AST001", ("asset filePath = None",), "filePath is blocked", ""),
        ("AST001", ("asset filePath = @@",), "filePath is empty", ""),
        ("AST002", ("asset filePath = @./fogs.1.vdb@",), "no file at", "did you mean './fog"),
        ("AST003", ("asset filePath = @./haze.####.vdb@",), "no file at", "name one file, or"),
        (
            "AST003",
            ("asset filePath = @${SHOW}/haze.vdb@",),
            "no file at",
            'variables in an expression alone: @`"${SHOW}/haze.vdb"`@',
        ),
        (
            "AST003",
            ("asset filePath = @./one.####.vdb@",),
            "no file at",
            "1 file found: author filePath.timeSamples = { 7: @./one.0007.vdb@ }",
        ),
        ("AST006", ("asset filePath = @./fog.f3d@",), "does not end in", "end its name in '.vdb'"),
        ("AST006", ("asset filePath = @./fog.nvdb@",), "is a NanoVDB file", "renderers that read"),
        ("AST008", ("asset filePath = @.\\fog\\a.vdb@",), "has backslashes", "'./fog/a.vdb'"),
        ("AST008", ("asset filePath = @C:/a.vdb@",), "a drive letter", "name it in relation to"),
        ("AST008", ("asset filePath = @~/a.vdb@",), "begins with '~'", "name it in relation to"),
        (
            "FLD002",
            ("asset filePath = @foo://a.vdb@", 'token fieldDataType = ""'),
            "fieldDataType is empty",
            "",
        ),
        ("FLD002", ("asset filePath = @foo://a.vdb@",), "no fieldDataType", ""),
    ],
)
def test_fields(
    code: str, lines: tuple[str, ...], message: str, advice: str, lint_text: Lint, tmp_path: Path
) -> None:
    for name in ("fog.1.vdb", "one.0007.vdb"):
        (tmp_path / name).write_bytes(b"x")
    shutil.copy(ASSETS / "cloud.vdb", tmp_path / "fog.f3d")
    shutil.copy(ASSETS / "grids/nanovdb.vdb", tmp_path / "fog.nvdb")
    data_type = "" if code == "FLD002" else 'token fieldDataType = "float"'
    _, said, suggestion = told(lint_text("#usda 1.0" + field(*lines, data_type=data_type)), code)
    assert message in said
    assert advice in suggestion


@pytest.mark.parametrize(
    ("frames", "words"),
    [
        ((1, 2, 3, 4, 6, 7, 8), "no sample at 5, in a run"),
        ((1, 2, 3, 4, 7, 8, 9), "no samples at 5-6, in a run"),
    ],
)
def test_gaps(frames: tuple[int, ...], words: str, lint_text: Lint, tmp_path: Path) -> None:
    for frame in frames:
        (tmp_path / f"fog.{frame}.vdb").write_bytes(b"x")
    samples = "".join(f"{frame}: @./fog.{frame}.vdb@,\n" for frame in frames)
    report = lint_text("#usda 1.0" + field(f"asset filePath.timeSamples = {{\n{samples}}}"))
    assert told(report, "AST011")[1].startswith(words)


@pytest.mark.parametrize(
    ("half", "length", "found"),
    [(False, 1.005, True), (True, 1.005, False), (True, 1.02, True), (False, 1.0005, False)],
)
def test_half_precision_may_round_lengths(
    half: bool, length: float, found: bool, lint_text: Lint
) -> None:
    kind, suffix = ("quath", "h") if half else ("quatf", "")
    turned = f"{kind}[] orientations{suffix} = [(1, 0, 0, 0), ({length}, 0, 0, 0)]"
    report = lint_text("#usda 1.0" + splats(turned))
    assert ("ARR011" in {finding.code for finding in report.findings}) == found


@pytest.mark.parametrize(("half", "found"), [(False, True), (True, False)])
def test_half_precision_may_round_positions(half: bool, found: bool, lint_text: Lint) -> None:
    suffix = "h" if half else ""
    points = f"point3{suffix or 'f'}[] positions{suffix} = [(0.2, 0.2, 0.2), (0.8, 0.8, 1.0005)]"
    colours = HALF_COEFFICIENTS if half else COEFFICIENTS
    text = splats(f"{DEGREE} = 0", f"{colours} = [(1, 1, 1), (1, 1, 1)]").replace(POSITIONS, points)
    report = lint_text("#usda 1.0" + text)
    assert ("ARR013" in {finding.code for finding in report.findings}) == found


def test_extent_as_advised_holds_the_kernels_too(lint_text: Lint) -> None:
    extent = "[(0, 0, 0), (0.5, 0.5, 20)]"
    text = f"""#usda 1.0
def ParticleField3DGaussianSplat "Splat" {{
float3[] extent = {extent}
point3f[] positions = [(0.2, 0.2, 0.2), (0.8, 0.3, 0.3), (0.3, 0.3, 0.9)]
float3[] scales = [(0.2, 0.1, 0.1), (0.2, 0.1, 0.1), (0, 0.1, 0.1)]
{DEGREE} = 0
{COEFFICIENTS} = [(1, 1, 1), (1, 1, 1), (1, 1, 1)]
}}
"""
    (outside,) = lint_text(text).findings
    advised = re.match(r"author at least (.*) to (.*), which holds", outside.suggestion or "")
    assert outside.code == "ARR013"
    assert advised
    assert lint_text(text.replace(extent, f"[{advised[1]}, {advised[2]}]")).findings == ()
    assert lint_text(text.replace(extent, "[(0.2, 0.2, 0.2), (0.8, 0.3, 0.9)]")).findings != ()
