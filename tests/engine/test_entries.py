"""What a code host has no file of is shown where it comes into the stage's own file."""

from __future__ import annotations

from pathlib import Path

import pytest
from blamings import Open

from usdvol_lint.engine.site import Sites
from usdvol_lint.paths import canonical
from usdvol_lint.rule import Problem

ASSET = (
    '#usda 1.0\ndef Xform "x"\n{\n    def Volume "tank"\n    {\n        token a = "b"\n    }\n}\n'
)
VARIANT = """
def "x" (
    variants = {{
        string v = "a"
    }}
    variantSets = "v"
)
{{
    variantSet "v" = {{
        "a" (
            references = @{}@</x>
        ) {{
        }}
    }}
}}
"""
OUTSIDE = "over-there/asset.usda"


@pytest.mark.parametrize(
    ("stage", "path", "entry"),
    [
        ('\ndef "x" (\n    prepend references = @{}@</x>\n)\n{{\n}}\n', "/x/tank", (4, 26)),
        ('\ndef "x" (\n    payload = @{}@</x>\n)\n{{\n}}\n', "/x/tank", (4, 15)),
        ("(\n    subLayers = [@{}@]\n)\n", "/x/tank", (3, 18)),
        (
            '\ndef "x" (\n    instanceable = true\n    references = @{}@</x>\n)\n{{\n}}\n',
            "/x/tank",
            (5, 18),
        ),
        (VARIANT, "/x/tank", (12, 26)),
    ],
)
def test_the_line_of_the_arc(
    stage: str, path: str, entry: tuple[int, int], opened: Open, tmp_path: Path
) -> None:
    asset = tmp_path / OUTSIDE
    asset.parent.mkdir()
    asset.write_text(ASSET, encoding="utf-8")
    (tmp_path / "here").mkdir()
    shot = opened(**{"here/shot": stage.format(f"../{OUTSIDE}")})
    prim = shot.GetPrimAtPath(path)
    if prim.IsInstanceProxy():
        prim = prim.GetPrimInPrototype()
    problem = Problem("", at=prim.GetAttribute("a"))
    inside, outside = (Sites(canonical(str(tmp_path / each))) for each in (".", "here"))
    assert inside.locate(problem).site.entry is None
    assert Sites().locate(problem).site.entry is None
    assert outside.locate(problem).site.entry == entry


def test_what_stands_in_the_stage_itself_has_no_other_line(opened: Open, tmp_path: Path) -> None:
    shot = opened(shot='\ndef Volume "x"\n{\n}\n')
    sites = Sites(canonical(str(tmp_path / "elsewhere")))
    assert sites.locate(Problem("", at=shot.GetPrimAtPath("/x"))).site.entry is None
