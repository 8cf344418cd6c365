"""Which lists of API schemas have a name twice, in the text before the body of a prim."""

from __future__ import annotations

import pytest

from usdvol_lint.layertext.lines import TextLayer
from usdvol_lint.layertext.lists import doubled_lists


@pytest.mark.parametrize(
    ("metadata", "lists"),
    [
        ('apiSchemas = ["A", "A"]', {"": ("A", "A")}),
        ('prepend apiSchemas = ["A", "B", "A"]', {"prepend": ("A", "B", "A")}),
        ("append/**/apiSchemas=['''A''', \"A\"]", {"append": ("A", "A")}),
        ('delete apiSchemas = ["A", "A"]', {"delete": ("A", "A")}),
        ('prepend apiSchemas = ["A", "B"]', {}),
        ('prepend apiSchemas = ["A"]\nappend apiSchemas = ["A"]', {}),
        ('prepend apiSchemas = ["A", "A"]\nprepend apiSchemas = ["A"]', {}),
        ('prepend apiSchemas = [\n"A", # "A"\n"B" /* "B" */\n]', {}),
        ('prepend apiSchemas = ["A"]\nprepend variantSets = ["A", "A"]', {}),
        ("apiSchemas = None", {}),
        ('doc = """prepend apiSchemas = ["A", "A"]"""', {}),
        ('# prepend apiSchemas = ["A", "A"]', {}),
        ('customData = {\nstring[] apiSchemas = ["A", "A"]\n}', {}),
        ('myapiSchemas = ["A", "A"]', {}),
    ],
)
def test_lists_with_a_name_twice(metadata: str, lists: dict[str, tuple[str, ...]]) -> None:
    assert doubled_lists(heading(metadata)) == lists


def test_only_the_heading_counts() -> None:
    assert doubled_lists(heading("", 'prepend apiSchemas = ["A", "A"]')) == {}


def heading(metadata: str, body: str = "") -> bytes:
    text = f'#usda 1.0\n\ndef "prim" (\n{metadata}\n)\n{{\ndef "child" (\n{body}\n)\n{{\n}}\n}}\n'
    return TextLayer(text.encode()).heading("/prim")
