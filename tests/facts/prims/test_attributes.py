"""What is authored on prims and contradicts the schemas, where several have the same properties."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]


def found(report: StageReport, code: str) -> list[str | None]:
    return [finding.site.prim for finding in report.findings if finding.code == code]


def fields(*bodies: str) -> str:
    """Fields `a`, `b` and so on below a Volume."""
    text = '#usda 1.0\ndef Volume "cloud" {\n float3[] extent = [(0, 0, 0), (1, 1, 1)]\n'
    for name, body in zip("abcd", bodies, strict=False):
        text += f'rel field:{name} = </cloud/{name}>\ndef OpenVDBAsset "{name}" {{\n{body}\n}}\n'
    return text + "}\n"


def test_each_prim_has_a_type_of_its_own_wrong(lint_text: Lint) -> None:
    """One prim's wrong type hides no other's, whichever attribute comes first."""
    name, wrong_name = 'token fieldName = "density"', 'string fieldName = "density"'
    index, wrong_index = "int fieldIndex = 0", "float fieldIndex = 0"
    bodies = [f"{name}\n{wrong_index}", f"{name}\n{index}", f"{wrong_name}\n{index}"]
    assert found(lint_text(fields(*bodies)), "SCH003") == ["/cloud/a", "/cloud/c"]
    assert found(lint_text(fields(*bodies[::-1])), "SCH003") == ["/cloud/a", "/cloud/c"]


def test_samples_hide_an_allowed_default(lint_text: Lint) -> None:
    allowed = 'token fieldDataType = "float"'
    samples = 'token fieldDataType.timeSamples = {1: "flot"}'
    report = lint_text(fields(f"{allowed}\n{samples}"))
    assert [each.site.frames for each in report.findings if each.code == "SCH005"] == ["1"]
    assert found(lint_text(fields(allowed)), "SCH005") == []


@pytest.mark.parametrize(
    ("relationship", "prims"), [("rel proxyPrim", []), ("rel density", ["/cloud"])]
)
def test_a_relationship_of_another_schema_binds_nothing(
    relationship: str, prims: list[str], lint_text: Lint
) -> None:
    text = fields().replace(
        "\n}\n", f'\n{relationship} = </spare>\n}}\ndef OpenVDBAsset "spare" {{\n}}\n'
    )
    assert found(lint_text(text), "VOL006") == prims
