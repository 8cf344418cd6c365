"""Texts with a mark at the position that is to be found."""

from __future__ import annotations

from typing import Any

from usdvol_lint.layertext.lines import Position, TextLayer

MARK = "¦"


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


def with_mark(template: str, place: int) -> tuple[str, Position | None]:
    return marked(template.format(*(MARK if i == place else "" for i in range(30))))
