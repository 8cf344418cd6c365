"""Text that is not UTF-8: told once a stage, and neither findings nor suppressions are lost."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from stagetexts import field, found, on_layer, on_prim

from usdvol_lint.model import Finding

Lint = Callable[..., tuple[Finding, ...]]

BROKEN = r"string '\x9b' = 'x'"


def told(findings: tuple[Finding, ...]) -> list[str]:
    return [each.message for each in findings if each.code == "LNT001"]


def test_a_token_is_told_that_usd_gives_no_value_for(lint: Lint) -> None:
    broken = field().replace('= "float"', r'= "flo\x9bat"')
    findings = lint({"stage.usda": broken + field(name="other")})
    assert told(findings) == [r"USD can't read what is here: text that is not UTF-8: 'flo\x9bat'"]
    assert {each.site.prim for each in findings if each.code == "AST002"} == {"/density", "/other"}


@pytest.mark.parametrize(("old", "new"), [("AST002", r'"AST\x9b"'), ("why", r"wh\x9by")])
def test_what_is_no_text_suppresses_nothing(old: str, new: str, lint: Lint) -> None:
    findings = lint({"stage.usda": field(on_prim(AST002="why").replace(old, new))})
    assert ("AST002", "/density", None) in found(findings)
    assert {"LNT002", "LNT003"}.isdisjoint(each.code for each in findings)
    assert len(told(findings)) == 1


def test_a_reason_beside_broken_keys_counts(lint: Lint) -> None:
    unused = on_prim(AST010="why").replace("= {", f"= {{\n{BROKEN}", 1)
    stage = (
        '(subLayers = [@./a.usda@])\nover "density" (\ncustomData = {\nint other = 1\n}\n)\n{\n}\n'
    )
    findings = lint({"stage.usda": stage, "a.usda": field(unused)}, unused=True)
    assert [each.site.layer for each in findings if each.code == "LNT003"] == ["a.usda"]
    of_prim = field(on_prim(AST002="why").replace("= {", f"= {{\n{BROKEN}", 1))
    assert ("AST002", "/density", "why") in found(lint({"stage.usda": of_prim}))
    of_layer = on_layer(AST002="why").replace("Data = {", f"Data = {{\n{BROKEN}", 1) + field()
    assert ("AST002", "/density", "why") in found(lint({"stage.usda": of_layer}))
