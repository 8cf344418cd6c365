"""What many places of one spec share is found once."""

from __future__ import annotations

from typing import Any

import pytest
from blamings import Open
from varianttexts import Lint, volume

import usdvol_lint.facts.files.absences as absences
from usdvol_lint.engine.site import Sites
from usdvol_lint.layertext.lines import TextLayer
from usdvol_lint.rule import Problem

PLACES = 8
SHOT = "".join(
    f'def "p{number}" (\n    references = @./lib.usda@</m>\n)\n{{\n}}\n' for number in range(PLACES)
)


def test_what_places_of_one_spec_share_is_found_once(
    lint: Lint, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each reference shows the same missing file, for the same reason, in the same line."""
    asked: list[tuple[str, Any]] = []

    def counts(owner: Any, name: str) -> None:
        original = getattr(owner, name)

        def count(*arguments: Any, **named: Any) -> Any:
            asked.append((name, named.get("asset")))
            return original(*arguments, **named)

        monkeypatch.setattr(owner, name, count)

    counts(absences, "find_absence")
    counts(absences, "missing_folder")
    counts(TextLayer, "find")
    report = lint(0, shot=SHOT, lib=f'def "m"\n{{\n{volume("gone/9")}}}\n')
    missing = [each for each in report.findings if each.code == "AST002"]
    assert len({each.site.prim for each in missing}) == PLACES
    assert len({(each.site.layer, each.site.line, each.message) for each in missing}) == 1
    assert sorted(each for each in asked if each[1] or each[0] != "find") == [
        ("find", "./gone/9.vdb"),
        ("find_absence", None),
        ("missing_folder", None),
    ]


def test_each_time_of_one_spec_has_its_line(opened: Open) -> None:
    samples = "float x.timeSamples = {\n1: 1,\n2: 2,\n}\n"
    stage, sites = opened(shot=SHOT, lib=f'def "m"\n{{\n{samples}}}\n'), Sites()
    lines = [
        sites.locate(Problem("", at=stage.GetAttributeAtPath(path), times=(time,))).site.line
        for path, time in (("/p0.x", 1.0), ("/p1.x", 2.0), ("/p2.x", 1.0))
    ]
    assert lines == [5, 6, 5]
