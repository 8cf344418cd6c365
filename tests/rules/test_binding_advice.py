"""What findings about field relationships say and advise in each of their cases."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[[str], StageReport]
FIELD = 'def OpenVDBAsset "density"\n{\n}\n'
OTHER = FIELD.replace("density", "other")
FIELD_IN_SCOPE = f'def Scope "fields"\n{{\n{FIELD}}}\n'
ABSTRACT = f'class "x"\n{{\n{FIELD}}}\n'


class Case(NamedTuple):
    """What the Volume says, what is below it and before it, and what is said of that."""

    code: str
    says: str
    below: str
    message: str
    advice: str = ""
    before: str = ""

    @property
    def stage(self) -> str:
        volume = f'def Volume "cloud"\n{{\n{self.says}\n{self.below}}}\n'
        return f"#usda 1.0\n{self.before}{volume}"


CASES = [
    Case(
        "VOL001 error",
        "rel field:density = </cloud/densty>",
        FIELD,
        "'field:density' targets </cloud/densty>, and there is no such prim",
        "did you mean </cloud/density>?",
    ),
    Case(
        "VOL001 error",
        "rel field:density = </cloud/x>",
        "",
        "'field:density' targets </cloud/x>, and there is no such prim",
        "target a field that is there, or remove it",
    ),
    Case(
        "VOL002 error",
        "rel field:density = </scope>",
        "",
        "'field:density' targets </scope>, which is of type 'Scope', not a field",
        "target a field, such as an OpenVDBAsset",
        before='def Scope "scope"\n{\n}\n',
    ),
    Case(
        "VOL002 error",
        "rel field:density = </scope>",
        "",
        "'field:density' targets </scope>, which has no type",
        "give it a type, such as 'OpenVDBAsset'",
        before='def "scope"\n{\n}\n',
    ),
    Case(
        "VOL002 error",
        "rel field:density = </cloud/fields>",
        FIELD_IN_SCOPE,
        "'field:density' targets </cloud/fields>, which is of type 'Scope', not a field",
        "did you mean </cloud/fields/density>?",
    ),
    Case(
        "VOL003 warning",
        "rel field:density",
        "",
        "'field:density' has no target",
        "name a field, or remove it",
    ),
    Case(
        "VOL003 warning",
        "rel field:density",
        FIELD,
        "'field:density' has no target",
        "did you mean </cloud/density>?",
    ),
    Case(
        "VOL003 warning",
        "rel field:density = </cloud.other>\nrel other",
        "",
        "'field:density' has no target behind </cloud.other>",
        "name a field, or remove it",
    ),
    Case(
        "VOL003 warning",
        "rel field:density = </cloud.field:density>",
        "",
        "'field:density' forwards to </cloud.field:density>, which leads round in a circle",
        "target a field",
    ),
    Case(
        "VOL003 warning",
        "rel field:density = </cloud.field:density>",
        FIELD,
        "'field:density' forwards to </cloud.field:density>, which leads round in a circle",
        "did you mean </cloud/density>?",
    ),
    Case(
        "VOL003 info",
        "rel field:density = None",
        "",
        "'field:density' is authored to have no target",
        "leave it, if the Volume is to go without this field; if not, target one",
    ),
    Case(
        "VOL004 error",
        "rel field:density = [</cloud/density>, </cloud/fields>]",
        FIELD + 'def Scope "fields"\n{\n}\n',
        "'field:density' has 2 targets, </cloud/density>, </cloud/fields>, and USD binds a field "
        "only where there is exactly one",
        "keep </cloud/density>, the only field among them",
    ),
    Case(
        "VOL004 error",
        "rel field:density = [</cloud/density>, </cloud/other>]",
        FIELD + OTHER,
        "'field:density' has 2 targets, </cloud/density>, </cloud/other>, and USD binds a field "
        "only where there is exactly one",
        "keep one, and give each other field a relationship of its own",
    ),
    Case(
        "VOL005 error",
        "rel field:density = </cloud/density.filePath>",
        FIELD.replace("{\n", "{\n    asset filePath\n"),
        "'field:density' targets the property </cloud/density.filePath>, not a field prim",
        "target the prim </cloud/density>",
    ),
    Case(
        "VOL005 error",
        "rel field:density = </cloud.extent>\nfloat3[] extent",
        "",
        "'field:density' targets the property </cloud.extent>, not a field prim",
        "target the field prim",
    ),
    Case(
        "VOL006 error",
        'custom string field:density = "x"',
        "",
        "'field:density' is an attribute, not a relationship",
        "write 'rel field:density = <path of the field prim>'",
    ),
    Case(
        "VOL006 warning",
        "rel field = </cloud/density>",
        FIELD,
        "the relationship 'field' is outside the 'field:' namespace, so it binds no field",
        "name it 'field:<name>'",
    ),
    Case(
        "VOL006 warning",
        "rel fields:density = </cloud/density>",
        FIELD,
        "the relationship 'fields:density' is outside the 'field:' namespace, so it binds no field",
        "name it 'field:density'",
    ),
    Case(
        "VOL008 error",
        "rel field:density = </cloud/density>",
        FIELD.replace("{", "(active = false)\n{", 1),
        "'field:density' targets </cloud/density>, which is inactive",
        "activate </cloud/density>",
    ),
    Case(
        "VOL008 error",
        "rel field:density = </cloud/x/density>",
        ABSTRACT,
        "'field:density' targets </cloud/x/density> below </cloud/x>, which is an abstract 'class'",
        "target a prim that inherits </cloud/x>",
    ),
    Case(
        "VOL008 error",
        "rel field:density = </cloud/density>",
        'over "density"\n{\n}\n',
        "'field:density' targets </cloud/density>, which is an 'over' that nothing defines",
        "define </cloud/density> with 'def'",
    ),
    Case(
        "VOL009 error",
        "rel field:density = </cloud/density>\nrel field:a:density = </cloud/density>",
        FIELD,
        "USD knows 'field:a:density' as 'density' as it does 'field:density', and drops one of the "
        "two",
        "name it 'field:a_density'",
    ),
    Case(
        "VOL009 warning",
        "rel field:a:density = </cloud/density>",
        FIELD,
        "USD knows 'field:a:density' as 'density' only",
        "name it 'field:a_density'",
    ),
    Case(
        "VOL010 info",
        "",
        "",
        "the Volume has no field",
        "add a field, or leave it, if a renderer fills the Volume by other means",
    ),
    Case(
        "VOL010 warning",
        "",
        FIELD,
        "the Volume has no field, though there is 'density' below it",
        "add 'rel field:density = <density>'",
    ),
]


@pytest.mark.parametrize("case", [pytest.param(case, id=case.code[:6]) for case in CASES])
def test_bindings(case: Case, lint_text: Lint) -> None:
    """One finding about the Volume, whatever is said of unused fields and their files."""
    told = [
        (f"{found.code} {found.severity.label}", found.message, found.suggestion or "")
        for found in lint_text(case.stage).findings
        if found.code.startswith("VOL") and found.code not in ("VOL011", "VOL012")
    ]
    assert told == [(case.code, case.message, case.advice)]


FORWARDED = """#usda 1.0
def Xform "fx"
{
    custom rel field:heat = </fx/caches/heat>

    def Scope "caches"
    {
        def OpenVDBAsset "heat"
        {
        }
    }

    def Volume "cloud" (
        prepend variantSets = "heat"
        variants = {
            string heat = "none"
        }
    )
    {
        variantSet "heat" = {
            "none" {
            }
            "cached" {
                rel field:heat = </fx.field:heat>
            }
        }
    }
}
"""


def test_a_group_that_only_a_variant_forwards_is_no_volume(lint_text: Lint) -> None:
    assert "SCH014" not in {finding.code for finding in lint_text(FORWARDED).findings}
    without = FORWARDED.replace("def Volume", "def Scope")
    assert "SCH014" in {finding.code for finding in lint_text(without).findings}
