"""Instances in instances, which show a prim more often than a computer can count."""

from __future__ import annotations

from collections.abc import Callable

from usdvol_lint.model import StageReport

DEPTH = 10

LIBRARY = """
class Xform "P10"
{
    def Volume "cloud"
    {
        rel field:density = </P10/field>
    }

    def OpenVDBAsset "field"
    {
        token fieldName = "density"
        asset filePath = @./gone.vdb@
    }
}
"""


def test_billions_of_instances_are_counted_and_not_visited(
    lint_text: Callable[[str], StageReport],
) -> None:
    instance = 'def "c{}" (\n instanceable = true\n references = </P{}>\n)\n{{\n}}\n'
    layers = [
        f'class Xform "P{level}"\n{{\n'
        + "".join(instance.format(number, level + 1) for number in range(10))
        + "}\n"
        for level in range(DEPTH)
    ]
    report = lint_text("#usda 1.0\n" + "".join(layers) + LIBRARY + instance.format("", 0))
    absent = next(each for each in report.findings if each.code == "AST002")
    assert absent.message == f"no file at './gone.vdb' (shown by {10**DEPTH:,} instances)"
    assert absent.site.prim == "/c" + "/c0" * DEPTH + "/field"
