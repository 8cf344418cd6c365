"""Instances of instances, which may be very many."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

import pytest

from usdvol_lint.facts.layers import stopped_clips
from usdvol_lint.facts.usd import instances
from usdvol_lint.model import StageReport

WIDTH = 30
LEVELS = 3

LEAF = """\
    def Volume "cloud"
    {
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
        rel field:density = </_P3/cloud/density>

        def OpenVDBAsset "density"
        {
            asset filePath = @./no.vdb@
            token fieldName = "density"
        }
    }
"""


def nested_instances() -> str:
    levels = "".join(
        f'class "_P{level}"\n{{\n'
        + "".join(
            f'def "c{number}" (\ninstanceable = true\nreferences = </_P{level + 1}>\n)\n{{\n}}\n'
            for number in range(WIDTH)
        )
        + "}\n"
        for level in range(LEVELS)
    )
    root = 'def "root" (\nreferences = </_P0>\n)\n{\n}\n'
    return f'#usda 1.0\n{levels}class "_P{LEVELS}"\n{{\n{LEAF}}}\n{root}'


def test_a_prototype_is_asked_once_for_its_instances(
    lint_text: Callable[[str], StageReport], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not once for each of the thousands of places at which it appears."""
    asked: Counter[str] = Counter()
    plain = instances.instances_of

    def counting(prototype: Any) -> list[Any]:
        asked[str(prototype.GetPath())] += 1
        return plain(prototype)

    for module in (instances, stopped_clips):
        monkeypatch.setattr(module, "instances_of", counting)
    report = lint_text(nested_instances())
    [missing] = [each for each in report.findings if each.code == "AST002"]
    assert missing.message == f"no file at './no.vdb' (shown by {WIDTH**LEVELS} instances)"
    assert missing.site.prim == "/root/c0/c0/c0/cloud/density"
    assert max(asked.values()) < WIDTH
