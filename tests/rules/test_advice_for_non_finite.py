"""What is said of NaN and infinity, which depends on what else an array holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]


def splats(array: str, values: Sequence[str]) -> str:
    count = len(values)
    places = ", ".join(f"({index}, 1, 1)" for index in range(count))
    return f"""#usda 1.0
def ParticleField3DGaussianSplat "Splats" {{
float3[] extent = [(0, 0, 0), ({count}, 2, 2)]
point3f[] positions = [{places}]
{array} = [{", ".join(values)}]
int radiance:sphericalHarmonicsDegree = 0
float3[] radiance:sphericalHarmonicsCoefficients = [{places}]
}}
"""


@pytest.mark.parametrize(
    ("array", "values", "message", "advice"),
    [
        (
            "float[] opacities",
            ["1"] * 9 + ["nan"],
            "1 of 10 opacities is NaN (10 %), the one at [9]",
            "remove these particles, in all arrays",
        ),
        ("float[] opacities", ["nan", *["1"] * 8], "1 of 9 opacities is NaN", "export again"),
        ("float[] opacities", ["1", "inf"], "1 of 2 opacities is infinite", "author 1 for inf"),
        ("half[] opacitiesh", ["1", "nan"], "1 of 2 opacities is NaN (50 %), the", "export again"),
        (
            "half[] opacitiesh",
            ["1", "inf"],
            "1 of 2 opacities is infinite (50 %), the one at [1]: inf",
            "author 1 for inf, the opaque end, and 0 for -inf",
        ),
        ("float[] opacities", ["-99", "inf"], "1 of 2 opacities is infinite", "the sigmoid, 1 / ("),
        ("float[] opacities", ["-100", "inf"], "1 of 2 opacities is infinite", "author 1 for inf"),
        ("float[] opacities", ["31", "inf"], "1 of 2 opacities is infinite", "the sigmoid, 1 / ("),
        ("float[] opacities", ["32", "inf"], "1 of 2 opacities is infinite", "author 1 for inf"),
        (
            "float[] opacities",
            ["3", "inf", "nan"],
            "2 of 3 opacities are NaN or infinite (66.7 %), first inf at [1]",
            "; particles with NaN have to be exported again",
        ),
        (
            "half3[] scalesh",
            ["(1, 1, inf)", "(1, 1, 1)"],
            "1 of 2 scales has infinity (50 %), beyond the 65,504 that half goes up to, the one at",
            "author the float array 'scales', or smaller values",
        ),
        ("float3[] scales", ["(1, 1, inf)", "(1, 1, 1)"], "1 of 2 scales has inf", "export again"),
        ("float3[] scales", ["(-1, 1, -inf)", "(-49, 1, 19)"], "1 of 2 scales", "makes 0 of -inf"),
        ("float3[] scales", ["(-1, 1, -inf)", "(-50, 1, 1)"], "1 of 2 scales", "export again"),
        ("float3[] scales", ["(-1, 1, -inf)", "(-49, 1, 20)"], "1 of 2 scales", "export again"),
        ("float3[] scales", ["(-1, 1, nan)", "(-49, 1, 1)"], "1 of 2 scales has NaN", "export ag"),
    ],
)
def test_advice(array: str, values: list[str], message: str, advice: str, lint_text: Lint) -> None:
    findings = lint_text(splats(array, values)).findings
    (found,) = (finding for finding in findings if finding.code == "ARR007")
    assert found.message.startswith(message)
    assert advice in (found.suggestion or "")
