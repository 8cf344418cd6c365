"""Fields that stand elsewhere than their Volume, and fields of different files."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from volumetexts import LARGE, OPS, SMALL, Lint, only, samples

SHARED = """
class "_asset" {
    def Volume "cloud" {
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
        rel field:density = </fields/density>
    }
}
def Scope "fields" {
    def OpenVDBAsset "density" {
        asset filePath = @./cloud.vdb@
        token fieldName = "density"
    }
}
"""
INSTANCE = 'def Xform "{0}" (\n instanceable = true\n inherits = </_asset>\n) {{ {1}\n}}\n'


def test_a_field_that_instances_share(lint: Lint) -> None:
    one = SHARED + INSTANCE.format("one", "")
    assert len(lint(one, "VOL011")) == 1
    assert lint(one + INSTANCE.format("two", ""), "VOL011") == []


def test_an_instance_that_stands_elsewhere_than_its_field(lint: Lint) -> None:
    assert lint(SHARED + INSTANCE.format("one", ""), "VOL015") == []
    found = only(lint(SHARED + INSTANCE.format("one", "\n " + OPS["move"]), "VOL015"))
    assert "its space is moved by (-1, -2, -3) in relation" in found.message


@pytest.mark.parametrize("moved", ["one", "two"])
def test_each_instance_stands_where_it_stands(moved: str, lint: Lint) -> None:
    """Whichever comes first; and no extent is suggested that would hide it."""
    instances = "".join(
        INSTANCE.format(name, "\n " + OPS["move"] if name == moved else "")
        for name in ("one", "two", "three")
    )
    found = only(lint(SHARED + instances, "VOL013"))
    assert (
        f"moved as its field is, in </{moved}/cloud> may be cut off where it reaches out of the "
        "extent, by" in found.message
    )
    assert found.suggestion == "move the field below the Volume, or give both the same transform"
    found = only(lint(SHARED + instances, "VOL015"))
    assert f"its space is moved by (-1, -2, -3) in </{moved}/cloud> in relation" in found.message


@pytest.mark.parametrize(
    ("ops", "words", "frames"),
    [
        (OPS["move"], "moved by (-1, -2, -3)", None),
        (OPS["turn"], "rotated or scaled", None),
        (OPS["reset"], "moved by (-5, 0, 0)", None),
        (OPS["wander"], "moved by (-4, 0, 0)", "3"),
        (OPS["none"], None, None),
        (OPS["size"].replace("(2, 3, 4)", "(0, 1, 1)"), None, None),
        (OPS["size"].replace("(2, 3, 4)", "(1, 1.0001, 1)"), "rotated or scaled", None),
        (OPS["size"].replace("(2, 3, 4)", "(1, 1.0000001, 1)"), None, None),
        (OPS["move"].replace("(1, 2, 3)", "(1e-7, 0, 0)"), None, None),
    ],
)
def test_words_of_a_displacement(
    ops: str, words: str | None, frames: str | None, lint: Lint
) -> None:
    text = SHARED.replace("class", "def").replace("float3[]", f"{ops}\n float3[]")
    found = lint(text, "VOL015")
    assert [finding.site.frames for finding in found] == ([frames] if words else [])
    assert all(f"its space is {words} in relation" in finding.message for finding in found)


def mixed(*fields: tuple[str, str]) -> Iterator[str]:
    yield 'def Volume "v" {\n float3[] extent = [(0, 0, 0), (1, 1, 1)]\n'
    for name, files in fields:
        yield f"rel field:{name} = </v/{name}>\n"
        yield f'def OpenVDBAsset "{name}" {{\n {files}\n token fieldName = "density"\n}}\n'
    yield "}\n"


ONE, TWO = "./smoke/smoke.0001.vdb", "./smoke/smoke.0002.vdb"


@pytest.mark.parametrize(
    ("fields", "frames", "words"),
    [
        ([ONE, ONE], None, None),
        ([ONE, "smoke/../smoke/smoke.0001.vdb"], None, None),
        ([ONE, "./gone.vdb"], None, None),
        ([ONE, TWO], None, f"2 files at one time, '{ONE}' (a) and '{TWO}' (b): some"),
        ([ONE, TWO, ONE], None, f"2 files at one time, '{ONE}' (a, c) and '{TWO}' (b): some"),
        (
            [ONE, TWO, "smoke/../smoke/smoke.0001.vdb"],
            None,
            f"2 files at one time, '{ONE}' (a, c) and '{TWO}' (b): some",
        ),
        (
            [ONE, TWO, SMALL, LARGE],
            None,
            f"4 files at one time, '{ONE}' (a), '{TWO}' (b) and 2 more: some",
        ),
        ([{1: ONE, 2: TWO}, {1: ONE, 2: TWO}], None, None),
        ([{1: ONE, 2: ONE, 3: TWO}, {1: ONE, 3: TWO}], None, None),
        ([{1: ONE, 2: TWO, 3: TWO}, {1: ONE, 3: TWO}], "2", f"'{TWO}' (a) and '{ONE}' (b)"),
        ([{5: ONE, 6: TWO}, ONE], "6", f"'{TWO}' (a) and '{ONE}' (b)"),
        (["omniverse:/a.vdb", "omniverse:/b.vdb"], None, "'omniverse:/a.vdb' (a) and"),
    ],
)
def test_mixed_files(fields: list[Any], frames: str | None, words: str | None, lint: Lint) -> None:
    written = [
        samples(each) if isinstance(each, dict) else f"asset filePath = @{each}@" for each in fields
    ]
    found = lint("".join(mixed(*zip("abcd", written, strict=False))), "VOL014")
    assert [finding.site.frames for finding in found] == ([frames] if words else [])
    assert all(str(words) in finding.message for finding in found)
