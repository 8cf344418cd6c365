"""Which colour space a prim has, and whether one of that name is defined where it counts."""

from __future__ import annotations

import pytest
from pxr import Usd

from usdvol_lint.facts.particles.colour_spaces import colour_space

NAME = 'token colorSpace:name = "{0}"'
DEFINED = 'token colorSpaceDefinition:own:name = "mine"'
APIS = '(prepend apiSchemas = ["ColorSpaceAPI", "ColorSpaceDefinitionAPI:own"])'
NOTE = 'custom token colorSpaceDefinition:own:note = "mine"'


@pytest.mark.parametrize(
    ("above", "between", "own", "expected"),
    [
        ("", "", "", None),
        ("", "", NAME.format("mine"), ("/a/b/c", "mine", False)),
        ("", "", f"{NAME.format('mine')}\n{DEFINED}", ("/a/b/c", "mine", True)),
        (DEFINED, "", NAME.format("mine"), ("/a/b/c", "mine", True)),
        (DEFINED, NAME.format("mine"), "", ("/a/b", "mine", True)),
        ("", NAME.format("mine"), DEFINED, ("/a/b", "mine", False)),
        (NOTE, "", NAME.format("mine"), ("/a/b/c", "mine", False)),
        (NAME.format("mine"), NAME.format("lin_rec709_scene"), "", ("/a/b", "lin_rec709_scene", 1)),
        (NAME.format("lin_rec709_scene"), "", NAME.format(""), ("/a", "lin_rec709_scene", True)),
    ],
)
def test_a_name_and_its_definition(
    above: str, between: str, own: str, expected: tuple[str, str, bool] | None
) -> None:
    """The nearest name counts, and what is defined on its prim or above."""
    stage = Usd.Stage.CreateInMemory()
    stage.GetRootLayer().ImportFromString(
        f'#usda 1.0\ndef "a" {APIS} {{\n{above}\ndef "b" {APIS} {{\n{between}\n'
        f'def "c" {APIS} {{\n{own}\n}}\n}}\n}}\n'
    )
    found = colour_space(stage.GetPrimAtPath("/a/b/c"))
    told = found and (str(found.attribute.GetPrimPath()), found.name, found.is_known)
    assert told == expected
