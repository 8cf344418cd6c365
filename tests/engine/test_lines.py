"""Positions of specs in usda text: by example, and as a law over whatever USD can read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count
from time import process_time
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pxr import Sdf, Usd

from usdvol_lint.engine.lines import Position, TextLayer

MARK = "¦"

# USD 24.11 can only read layers with Sdf once the Usd library is loaded.
assert Usd.GetVersion() >= (0, 24, 11)


def find(text: str, path: str, **what: Any) -> Position | None:
    return TextLayer(text.encode()).find(path, **what)


def marked(text: str) -> tuple[str, Position | None]:
    """The text without its mark, and the position of the mark."""
    before, mark, after = text.partition(MARK)
    assert MARK not in after
    line_start = before.rfind("\n") + 1
    position = Position(before.count("\n") + 1, len(before) - line_start + 1) if mark else None
    return before + after, position


PRIMS = {
    "layer": ("/", '¦#usda 1.0\ndef "a" {}\n'),
    "def": ("/a", '#usda 1.0\n¦def Xform "a" {}\n'),
    "over": ("/a", '#usda 1.0\n  ¦over "a" {}\n'),
    "class without type": ("/_c", '#usda 1.0\n¦class "_c" {}\n'),
    "single quotes": ("/a", "#usda 1.0\n¦def 'a' {}\n"),
    "comment in header": ("/a", '#usda 1.0\n¦def /* "b" { */ Mesh /* "b" */ "a"\n# {\n{}\n'),
    "second of two": ("/b", '#usda 1.0\ndef "a" {}\n¦def "b" {}\n'),
    "same name above": ("/b/a", '#usda 1.0\ndef "a" {}\ndef "b" {\n  ¦def "a" {}\n}\n'),
    "same name below": ("/a", '#usda 1.0\ndef "b" {\n  def "a" {}\n}\n¦def "a" {}\n'),
    "own name": ("/a/a", '#usda 1.0\ndef "a" {\n  ¦def "a" {}\n}\n'),
    "absent": ("/b", '#usda 1.0\ndef "a" {\n  def "b" {}\n}\n'),
    "absent child": ("/a/b", '#usda 1.0\ndef "a" {}\ndef "b" {}\n'),
    "relative path": ("a", '#usda 1.0\ndef "a" {}\n'),
    "in a comment": (
        "/a",
        '#usda 1.0\n# def "a" {}\n// def "a" {}\n/*\ndef "a" {}\n*/\n¦def "a" {}\n',
    ),
    "in a string": ("/a", '#usda 1.0\n(\n"""\ndef "a" {}\n"""\n)\n¦def "a" {}\n'),
    "crlf": ("/a/b", '#usda 1.0\r\ndef "a"\r\n{\r\n  ¦def "b"\r\n  {\r\n  }\r\n}\r\n'),
    "one line": ("/a/b", '#usda 1.0\ndef "a" { string é = "é😀"; ¦def "b" {}\n}\n'),
    "utf-8 name": ("/é/ü", '#usda 1.0\ndef "é"\n{\n  ¦def "ü" {}\n}\n'),
    "metadata": (
        "/a/b",
        """#usda 1.0
(
    customLayerData = { dictionary d = { string def = "def \\"a\\" {" } }
    relocates = { </a{}>: </c> }
)
def Xform "a" (
    "doc ) { def b"
    customData = {
        dictionary d = { string over = '}{' }
        asset[] s = [@{@, @@@"\\@@@{@@@@]
    }
    prepend references = [@a"{.usda@</b> (offset = 1; customData = { int i = 1 }), </c>]
    prefixSubstitutions = { "{": "}" }
    add variantSets = ["def", 'x']
    variants = { string def = "b" }
)
{
    reorder nameChildren = ["c", "b"]
    string s = '''it's } ''\\''' "
    ''' ; string t = "\\\\"; string u = "'{" (doc = "){")
    rel r = [</b.c>, <../{x}>]
    ¦def "b" {}
}
def "b" {}
""",
    ),
}

VARIANTS = """#usda 1.0
def "a" (
    prepend variantSets = ["v", "w"]
    variants = {{ string v = "x" }}
)
{{
    {0}int p
    {1}variantSet "v" = {{
        {2}"x" (
            doc = "y"
            customData = {{ string s = "y" }}
        ) {{
            {3}int p
            {4}def "b" (doc = "z") {{
                {5}int p
                {6}variantSet "v" = {{
                    {7}"x" {{
                        {8}int p
                    }}
                }}
            }}
            {9}variantSet "w" = {{
                {10}'y' {{
                    {11}def "b" {{
                        {12}int p
                    }}
                }}
            }}
        }}
        {13}"y" {{
            {14}def "b" {{}}
        }}
    }}
    variantSet "w" = {{
        "x" {{}}
        {15}"y" {{}}
    }}
    {16}def "b" {{
        {17}int p
    }}
}}
"""
VARIANT_PATHS = [
    "/a.p",
    "/a{v=}",
    "/a{v=x}",
    "/a{v=x}.p",
    "/a{v=x}b",
    "/a{v=x}b.p",
    "/a{v=x}b{v=}",
    "/a{v=x}b{v=x}",
    "/a{v=x}b{v=x}.p",
    "/a{v=x}{w=}",
    "/a{v=x}{w=y}",
    "/a{v=x}{w=y}b",
    "/a{v=x}{w=y}b.p",
    "/a{v=y}",
    "/a{v=y}b",
    "/a{w=y}",
    "/a/b",
    "/a/b.p",
]


def in_prim(statements: str) -> str:
    return '#usda 1.0\ndef "a"\n{\n' + statements + "\n}\n"


PROPERTIES = {
    "plain": ("p", "  ¦int p"),
    "all modifiers": ("n:s:p", "  ¦custom uniform token[] n:s:p.timeSamples = {1: []}"),
    "config": ("p", "¦config int p = 1"),
    "spaced array": ("p", "¦token [ ] p = []"),
    "commented": ("p", "/* int p */ ¦int /* p = */ p /* = */ = /* ; */ 1"),
    "relationship": ("r", "int s\n¦rel r"),
    "varying relationship": ("r", "¦custom varying rel r = None"),
    "list edit of relationship": ("r", "int s\n¦prepend rel r = </b>\ndelete rel r = </c>"),
    "list edit of connection": ("p", "int s\n¦delete custom int p.connect = </b.c>\nint p"),
    "target alone": ("r", "int s\n¦rel r[</b.c>]"),
    "target alone, spaced": ("r", "int s\n¦rel r [</b.c>]"),
    "order of relationship": ("r", "¦reorder rel r = [</c>]"),
    "order of properties": ("properties", 'reorder properties = ["p"]\n¦int properties'),
    "first of several": (
        "p",
        "¦asset p (\n doc = 'd')\nasset p = @a@\nasset p.timeSamples = {1: @b@}",
    ),
    "target": ("r[/b.c]", "int s\n¦rel r = </b.c>"),
    "array of lines": ("p", 'token[] s = [\n"int p",\n"]",\n]\n¦int p'),
    "tuples": ("p", "matrix2d s = ( (1, 2),\n(3, 4) )\n¦int p"),
    "samples": ("p", 'string[] s.timeSamples = {\n1: ["int p = {", "}"],\n2: None,\n}\n¦int p'),
    "spline": (
        "p",
        "double s.spline = {\n bezier,\n 1: 5; post held; { string p = '}' },\n}\n¦int p",
    ),
    "value's metadata": (
        "p",
        "int s = 1 (\n doc = ')'\n customData = {\n int p = 1\n }\n)\n¦int p",
    ),
    "semicolons": ("p", "int s = 1; ¦int p = 2; int t = 3"),
    "array edit": ("p", "int[] s = edit [append 1; prepend 2]\n¦int p"),
    "named like a keyword": ("def", "int s = 1\n¦int def = 1"),
    "named like a suffix": ("timeSamples", "¦int timeSamples.timeSamples = {1: 2}"),
    "spaced suffix": ("p", "¦int p . timeSamples = {1: 2}"),
    "utf-8": ("n:é", 'string s = "é😀"; ¦int n:é = 1'),
    "asset with quotes": ("p", "asset s = @a\"'{#//.vdb@\nasset t = @@@a\\@@@{@@@@@\n¦int p"),
    "path with a selection": ("p", "rel r = </b{v=x}c>\n¦int p"),
    "after a child": ("p", "int s\ndef 'b' {\n int p\n}\n¦int p"),
    "prefix of another": ("p", "int p:q\nint pp\nint q:p\n¦int p"),
    "absent": ("p", "int p:q\nint q:p\nint q = 1 # int p\nstring t = 'int p'"),
    "type is no name": ("int", "int p = 1"),
}

SAMPLES = """#usda 1.0
def "a" {{
    {0}string p = "1: 2"
    {1}string p.timeSamples = {{ # 2: 3
        {2}1: "2: 3", {3}2.5: '3: 4',
        {4}-1.5e1 : None, # 9: 0
        {5}.5: /* 8: 1 */ "a, 7: b",
        {6}4:"x",{7}1e3: "y"
    }}
    {8}asset q.timeSamples = {{
        0: {9}@a.vdb@,
        1: {10}@a.vdb@, 2: {11}@@@b.vdb@@@
    }}
    {12}point3f[] r.timeSamples = {{
        {13}1: [(1, 2, 3),
               (4, 5, 6)],
        {14}2: [],
        {15}30: [],
    }}
    {16}int s = 1
}}
"""
SAMPLE_QUERIES: list[tuple[int, str, dict[str, Any]]] = [
    (0, "p", {}),
    (2, "p", {"time": 1}),
    (2, "p", {"time": 1.0000001}),
    (1, "p", {"time": 1.001}),
    (1, "p", {"time": 2}),
    (3, "p", {"time": 2.5}),
    (1, "p", {"time": 3}),
    (4, "p", {"time": -15}),
    (5, "p", {"time": 0.5}),
    (6, "p", {"time": 4}),
    (1, "p", {"time": 7}),
    (1, "p", {"time": 8}),
    (1, "p", {"time": 9}),
    (7, "p", {"time": 1000}),
    (1, "p", {"time": float("nan")}),
    (1, "p", {"time": float("inf")}),
    (9, "q", {"asset": "a.vdb"}),
    (9, "q", {"time": 0, "asset": "a.vdb"}),
    (10, "q", {"time": 1, "asset": "a.vdb"}),
    (11, "q", {"time": 2, "asset": "b.vdb"}),
    (9, "q", {"time": 3, "asset": "a.vdb"}),
    (8, "q", {"time": 3, "asset": "c.vdb"}),
    (8, "q", {"asset": "c.vdb"}),
    (13, "r", {"time": 1}),
    (14, "r", {"time": 2}),
    (12, "r", {"time": 3}),
    (15, "r", {"time": 30}),
    (16, "s", {"time": 1}),
]

ASSETS = """{0}#usda 1.0
( # @sub.usda@
    "@sub.usda@"
    subLayers = [
        {1}@sub.usda@,
        {2}@@@odd@name\\@@@@@@
    ]
)
{3}def "a" (
    references = {4}@ref.usda@</b>
    # @x.vdb@
)
{{
    {5}asset p = {6}@x.vdb@ (doc = "@y.vdb@")
    {7}asset[] q = [{8}@@@y.vdb@@@, @x.vdb@, {9}@@]
    {10}def "b" {{
        asset p = {11}@z.vdb@
    }}
}}
"""
ASSET_QUERIES = [
    (1, "/", "sub.usda"),
    (2, "/", "odd@name@@@"),
    (0, "/", "ref.usda"),
    (4, "/a", "ref.usda"),
    (6, "/a", "x.vdb"),
    (8, "/a", "y.vdb"),
    (9, "/a", ""),
    (3, "/a", "z.vdb"),
    (6, "/a.p", "x.vdb"),
    (5, "/a.p", "y.vdb"),
    (8, "/a.q", "y.vdb"),
    (7, "/a.q", "z.vdb"),
    (11, "/a/b", "z.vdb"),
    (10, "/a/b", "x.vdb"),
]


def with_mark(template: str, place: int) -> tuple[str, Position | None]:
    return marked(template.format(*(MARK if i == place else "" for i in range(30))))


@pytest.mark.parametrize(("path", "text"), PRIMS.values(), ids=PRIMS)
def test_prims(path: str, text: str) -> None:
    text, expected = marked(text)
    assert find(text, path) == expected


@pytest.mark.parametrize(("place", "path"), list(enumerate(VARIANT_PATHS)), ids=VARIANT_PATHS)
def test_variants(place: int, path: str) -> None:
    text, expected = with_mark(VARIANTS, place)
    assert find(text, path) == expected


@pytest.mark.parametrize(
    "path", ["/a{v=z}", "/a{u=}", "/a{w=y}b", "/a{v=x}c", "/a{v=y}b.p", "/b", "/a/b.q", "/a/b.p.q"]
)
def test_absent_from_variants(path: str) -> None:
    assert find(with_mark(VARIANTS, -1)[0], path) is None


@pytest.mark.parametrize(("name", "statements"), PROPERTIES.values(), ids=PROPERTIES)
def test_properties(name: str, statements: str) -> None:
    text, expected = marked(in_prim(statements))
    assert find(text, f"/a.{name}") == expected
    assert find(text.replace("\n", "\r\n"), f"/a.{name}") == expected


@pytest.mark.parametrize(("place", "name", "what"), SAMPLE_QUERIES)
def test_time_samples(place: int, name: str, what: dict[str, Any]) -> None:
    text, expected = with_mark(SAMPLES, place)
    assert find(text, f"/a.{name}", **what) == expected


@pytest.mark.parametrize(("place", "path", "asset"), ASSET_QUERIES)
def test_assets(place: int, path: str, asset: str) -> None:
    text, expected = with_mark(ASSETS, place)
    assert find(text, path, asset=asset) == expected


def test_byte_order_mark_is_no_character() -> None:
    text = '\ufeff#usda 1.0\ndef "a" {}\n'
    assert [find(text, "/"), find(text, "/a")] == [Position(1, 1), Position(2, 1)]
    assert find('\ufeffdef "a" {}', "/a") == Position(1, 1)


def test_lines_are_counted_across_a_large_text() -> None:
    text = "#usda 1.0\n" + "".join(f'def "p{i}"\n{{\n}}\n' for i in range(30_000))
    layer = TextLayer(text.encode())
    numbers = [29_999, 0, 7_000, 15_000]
    assert [layer.find(f"/p{i}") for i in numbers] == [Position(2 + 3 * i, 1) for i in numbers]


def read(text: str) -> Sdf.Layer:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(text)
    return layer


def paths_in(layer: Sdf.Layer) -> list[Sdf.Path]:
    paths: list[Sdf.Path] = []
    layer.Traverse(Sdf.Path.absoluteRootPath, paths.append)
    return paths


SPECIFIERS = {Sdf.SpecifierDef: "def", Sdf.SpecifierOver: "over", Sdf.SpecifierClass: "class"}


def opening(layer: Sdf.Layer, path: Sdf.Path) -> str:
    """A pattern of what the text says where the spec at `path` begins."""
    if path.IsTargetPath():
        return opening(layer, path.GetParentPath())
    if path == Sdf.Path.absoluteRootPath:
        return "#usda"
    if path.IsPrimVariantSelectionPath():
        variant_set, variant = path.GetVariantSelection()
        return rf"(['\"]){variant}\1" if variant else rf"variantSet (['\"]){variant_set}\1"
    spec = layer.GetObjectAtPath(path)
    if path.IsPrimPath():
        typed = rf"\s+{spec.typeName}\b" if spec.typeName else ""
        return rf"{SPECIFIERS[spec.specifier]}{typed}\s+(['\"]){spec.name}\1"
    words = r"(?:(?:add|append|prepend|delete|reorder|custom|uniform|config|varying)\s+)*"
    kind = (
        re.escape(str(spec.typeName)).replace(r"\[\]", r"\s*\[\s*\]")
        if isinstance(spec, Sdf.AttributeSpec)
        else "rel"
    )
    return rf"{words}{kind}\s+{re.escape(spec.name)}(?![\w:])"


def check_law(text: str) -> None:
    """Every spec that USD reads from the text is found, at a place of its own that names it."""
    layer = read(text)
    lines = text.split("\n")
    text_layer = TextLayer(text.encode())
    places: dict[Position, Sdf.Path] = {}
    for path in paths_in(layer):
        position = text_layer.find(str(path))
        assert position is not None, path
        here = re.sub(r"/\*.*?\*/", "", lines[position.line - 1][position.column - 1 :])
        assert re.match(opening(layer, path), here), (path, here)
        if not path.IsTargetPath():
            assert places.setdefault(position, path) == path
        for parent in path.GetPrefixes()[:-1]:
            outer = text_layer.find(str(parent))
            assert outer is not None
            assert outer <= position
        if path.IsPropertyPath():
            for key in layer.ListTimeSamplesForPath(path):
                found = text_layer.find(str(path), time=key)
                assert found is not None
                there = lines[found.line - 1][found.column - 1 :]
                assert float(there.partition(":")[0]) == key, (path, key)


SPECIMENS = {
    **{
        f"prims: {name}": marked(text)[0] for name, (_, text) in PRIMS.items() if name != "metadata"
    },
    **{
        f"properties: {name}": in_prim(marked(statements)[0])
        for name, (_, statements) in PROPERTIES.items()
        # Arrays could not be edited in USD 24.11; a selection in a target was never right.
        if name not in ("array edit", "path with a selection")
    },
    "variants": with_mark(VARIANTS, -1)[0],
    "samples": with_mark(SAMPLES, -1)[0].replace("/* 8: 1 */", ""),
    "assets": with_mark(ASSETS, -1)[0],
    "tricky": r'''#usda 1.0
( # not ( a paren
    """A layer "with" {many} @traps@ and \""" a quote
    def "World" {"""
    customLayerData = {
        dictionary "def \"World\" {" = { asset a = @}@; string[] b = ["}", '{'] }
    }
    defaultPrim = "World"
    subLayers = [ @sub{.usda@ (offset = 1; scale = 2), @@@other@@.usda@@@ ]
    relocates = { </World/old>: </World/new> }
)
/* def "World" {
*/ // def "World" {
reorder rootPrims = ["World", "Class"]

class "Class" { }

def Xform "World"   (
    kind = 'component' ; assetInfo = { asset identifier = @a@ }
    inherits = </Class>
    payload = [ @p"{.usda@</x> (offset = 3), </y> ]
    prepend variantSets = ["look", "lod"]
    variants = { string look = "red" ; string lod = "high" }
    permission = public
)

# between
{
    reorder nameChildren = [ "World", "smoke" ]
    reorder properties = ["over", "class"]
    custom rel over = </World> (doc = "no") ; custom int class = 3;
    custom uniform token[] ns:sub:name.timeSamples = { 1: ["def \"x\" {"], 2: None, # 3: 4
        4: [],
    };
    float3[] extent = [ (-1, -1, -1), # ] }
        (1, 1, 1) /* ] */ ] ( interpolation = "vertex" )
    asset file = @a{b}"'.vdb@
    add asset file.connect = </World.file> ; delete asset file.connect = [</World.over>, </a.b>]
    append rel over = [</x>, </y.z>,]
    double curve.spline = { bezier, pre: held, 1: 5; post curve (1, 2); { string s = "}" }, 2: 6 }
    def "World" { int p; }
'''
    + r"""
    over Mesh "smoke" { string s = '\'}' ; string t = "" ; string u = '''''' ; asset v = @@ ; }
    def "def" { rel def
        def Scope "over" {
            int over = 1;
        }
    }
    variantSet "look" = {
        'red' ( customData = { string s = "}" } ) {
            int p = 1
            def "smoke" { int p = 2;
            }
            variantSet "lod" = {
                "high" { def "smoke" {
                        int p = 3; }
                }
                "low" { int p = 4;
                }
            }
        }
        "blue-1|x" {
        }
    }
    variantSet "lod"={
        "high" { int q; }
        "low"{ int q; }
    }
}

over "é" ( "doc" ) { string ü:ß = "é" ; int y = 1; }
""",
}


@pytest.mark.parametrize("text", SPECIMENS.values(), ids=SPECIMENS)
def test_law_holds_for_specimens(text: str) -> None:
    check_law(text)


TRICKY = st.text("def \"'{}()[]@#/*<>\\\n;=,:1é😀", max_size=12)
NAMES = st.sampled_from(["a", "b", "def", "over", "variantSet", "timeSamples", "rel", "é"])
PROPERTY_NAMES = st.builds(":".join, st.lists(NAMES, min_size=1, max_size=2))
PROPERTY = st.tuples(
    st.sampled_from(["string", "asset", "float3[]", "rel"]),
    st.booleans(),
    st.lists(st.floats(-1e6, 1e6) | st.integers(0, 9).map(float), max_size=3, unique=True),
    TRICKY,
)
PROPERTIES_OF = st.dictionaries(PROPERTY_NAMES, PROPERTY, max_size=3)
SPECIFIER = st.sampled_from(list(SPECIFIERS))


def prims(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.tuples(
        SPECIFIER,
        TRICKY,
        PROPERTIES_OF,
        st.dictionaries(NAMES, inner, max_size=2),
        st.dictionaries(NAMES, st.dictionaries(NAMES, inner, min_size=1, max_size=2), max_size=2),
    )


PRIM: st.SearchStrategy[Any] = st.recursive(
    st.tuples(SPECIFIER, TRICKY, PROPERTIES_OF, st.just({}), st.just({})), prims, max_leaves=6
)


def fill(prim: Sdf.PrimSpec, drawn: Any, numbers: Iterator[int]) -> None:
    _, tricky, properties, children, variant_sets = drawn
    prim.documentation = f"{prim.path}|{tricky}"
    prim.customData = {"def": tricky, "inner": {"over": tricky}}
    for name, (kind, has_default, times, text) in properties.items():
        if kind == "rel":
            spec = Sdf.RelationshipSpec(prim, name, custom=has_default)
            spec.targetPathList.prependedItems = [Sdf.Path("/a/b.def"), Sdf.Path("/over")]
            spec.targetPathList.deletedItems = [Sdf.Path("/é")]
        else:
            spec = Sdf.AttributeSpec(prim, name, getattr(Sdf.ValueTypeNames, VALUE_TYPES[kind]))
            if has_default:
                spec.default = value(kind, text, numbers)
                spec.connectionPathList.appendedItems = [Sdf.Path("/a.b")]
            for key in times:
                prim.layer.SetTimeSample(spec.path, key, value(kind, text, numbers))
        spec.documentation = f"{spec.path}|{text}"
    for name, child in children.items():
        fill(Sdf.PrimSpec(prim, name, child[0], "Scope"), child, numbers)
    for set_name, variants in variant_sets.items():
        variant_set = Sdf.VariantSetSpec(prim, set_name)
        for name, variant in variants.items():
            fill(Sdf.VariantSpec(variant_set, name).primSpec, variant, numbers)


VALUE_TYPES = {"string": "String", "asset": "Asset", "float3[]": "Float3Array"}


def value(kind: str, text: str, numbers: Iterator[int]) -> Any:
    if kind == "asset":
        return Sdf.AssetPath(re.sub(r"[\\\n]", "", f"{text}{next(numbers)}.vdb"))
    return text if kind == "string" else [(1, 2, 3), (4, 5, 6)]


@settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.dictionaries(NAMES, PRIM, min_size=1, max_size=2))
def test_law_holds_for_what_usd_writes(drawn: dict[str, Any]) -> None:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    numbers = count()
    for name, prim in drawn.items():
        fill(Sdf.PrimSpec(layer, name, prim[0]), prim, numbers)
    text = layer.ExportToString()
    check_law(text)

    lines = text.split("\n")
    text_layer = TextLayer(text.encode())
    for path in paths_in(layer):
        spec = layer.GetObjectAtPath(path)
        if not isinstance(spec, Sdf.PrimSpec | Sdf.PropertySpec | Sdf.VariantSpec):
            continue
        if path == Sdf.Path.absoluteRootPath:
            continue
        line, column = text_layer.find(str(path)) or Position(0, 0)
        rest = "\n".join([lines[line - 1][column - 1 :], *lines[line:]])
        documented = re.search("doc = (?:\"\"\"|'''|\"|')(.*?)\\|", rest)
        assert documented
        assert documented[1] == str(path)
        for asset in assets_of(layer, spec):
            line, column = text_layer.find(str(path), asset=asset) or Position(0, 0)
            literal = (
                f"@@@{asset.replace('@@@', chr(92) + '@@@')}@@@" if "@" in asset else f"@{asset}@"
            )
            assert lines[line - 1][column - 1 :].startswith(literal)


def assets_of(layer: Sdf.Layer, spec: Sdf.Spec) -> list[str]:
    if not isinstance(spec, Sdf.AttributeSpec):
        return []
    values = [spec.default] if spec.default is not None else []
    values += [layer.QueryTimeSample(spec.path, t) for t in layer.ListTimeSamplesForPath(spec.path)]
    return [v.path for v in values if isinstance(v, Sdf.AssetPath)]


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
