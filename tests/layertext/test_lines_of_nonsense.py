"""Text that is no usda has no positions, raises nothing, and takes no more time than its length."""

from __future__ import annotations

from time import process_time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usdvol_lint.layertext.lines import TextLayer

FRAGMENTS = st.sampled_from(
    [
        *('def "a"', "{", "}", "(", ")", "[", "]", '"', '"""', "'", "@", "@@@", "<", "/*", "*/"),
        *("//", "#", "\n", ";", "=", "= {", 'variantSet "v" = {', '"x"', "int p"),
        *(".timeSamples", "1:", "\\"),
    ]
)


@settings(deadline=None)
@given(
    st.binary(max_size=60) | st.lists(FRAGMENTS, max_size=25).map(lambda f: " ".join(f).encode())
)
def test_nonsense_never_raises(data: bytes) -> None:
    layer = TextLayer(data)
    for path in (
        "/",
        "/a",
        "/a.p",
        "/a{v=x}",
        "/a{v=x}.p",
        "/a{v=",
        "a",
        "",
        "/a.",
        "//",
        "/a[/b]",
    ):
        for what in ({}, {"time": 1.0}, {"asset": "x"}, {"time": 1.0, "asset": "x"}):
            layer.find(path, **what)


@pytest.mark.parametrize(
    "unit",
    [
        *('"', '"""\\', "@@@", "@@@\\", "/*", "<", "{", "}", "(", "[", "= /**/", "def ", "def /*"),
        *("1", "variantSet ", 'variantSet "v" = {', 'def "a" {', "1.", "1:", "1: [", "int p("),
        *("1e", "\\"),
    ],
)
def test_time_is_linear_in_malformed_text(unit: str) -> None:
    layer = TextLayer(
        b'#usda 1.0\ndef "a" {\n int p.timeSamples = {1: 2,\n' + unit.encode() * 100_000
    )
    start = process_time()
    layer.find("/a.p", time=5)
    layer.find("/a", asset="x")
    assert process_time() - start < 5
