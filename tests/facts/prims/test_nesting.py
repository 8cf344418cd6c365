"""Gprims above and below others, through instances."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]
VOLUME = """def Volume "cloud" {
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
}
"""
INSTANCE = 'def "it" (\n instanceable = true\n inherits = </_{0}>\n) {{\n}}\n'


def nested(report: StageReport) -> list[tuple[str | None, str]]:
    return [(each.site.prim, each.message) for each in report.findings if each.code == "SCH009"]


@pytest.mark.parametrize("kinds", [("Cube", "Xform"), ("Xform", "Cube")])
def test_a_gprim_above_any_instance(kinds: tuple[str, str], lint_text: Lint) -> None:
    """Whichever of the instances comes first."""
    text = f'#usda 1.0\nclass "_asset" {{\n{VOLUME}}}\n'
    for name, kind in zip("ab", kinds, strict=True):
        text += f'def {kind} "{name}" {{\n{INSTANCE.format("asset")}}}\n'
    [(_, message)] = nested(lint_text(text))
    assert f"Volume below Cube </{'ab'[kinds.index('Cube')]}>, which is a Gprim too" in message


def test_a_gprim_in_an_instance_of_an_instance(lint_text: Lint) -> None:
    """The outermost instance is to blame, once, for it can be moved."""
    text = '#usda 1.0\nclass "_inner" {\n def Cube "one" {\n }\n def Cube "two" {\n }\n}\n'
    text += f'class "_outer" {{\n{INSTANCE.format("inner")}}}\n'
    text += VOLUME.replace("}", INSTANCE.format("outer") + "}")
    [(prim, message)] = nested(lint_text(text))
    assert prim == "/cloud/it"
    assert message.startswith("an instance, which holds Cube </cloud/it/it/one>, below Volume")


@pytest.mark.parametrize("depth", [10, 2000])
def test_a_gprim_in_the_depth(depth: int, lint_text: Lint) -> None:
    """Deeper than Python recurses, above and below."""
    above, below, end = 'def "a" {\n' * depth, 'def "b" {\n' * depth, "}\n" * depth
    inside = VOLUME.replace("}", f'{below}def Cube "it" {{\n}}\n{end}}}')
    report = lint_text(f"#usda 1.0\n{above}{inside}{end}")
    assert [each.code for each in report.findings if each.code.startswith("LNT")] == []
    [(_, message)] = nested(report)
    assert message.startswith("Cube below Volume </a/a/")
