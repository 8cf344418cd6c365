"""Positions of specs in usda text, as a law over whatever USD can read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from marks import ASSETS, PRIMS, PROPERTIES, SAMPLES, VARIANTS, in_prim, marked, with_mark
from pxr import Sdf, Usd

from usdvol_lint.layertext.lines import Position, TextLayer

# USD 24.11 can only read layers with Sdf once the Usd library is loaded.
assert Usd.GetVersion() >= (0, 24, 11)


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
        found = text_layer.find(str(path)) or Position(0, 0)
        line, column = found.line, found.column
        rest = "\n".join([lines[line - 1][column - 1 :], *lines[line:]])
        documented = re.search("doc = (?:\"\"\"|'''|\"|')(.*?)\\|", rest)
        assert documented
        assert documented[1] == str(path)
        for asset in assets_of(layer, spec):
            found = text_layer.find(str(path), asset=asset) or Position(0, 0)
            line, column = found.line, found.column
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
