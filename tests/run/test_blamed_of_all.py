"""What a layer says of all that it brings is to blame, where that is clean opened alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import CLEAN, HEAD, LAYER, META, SPLATS, STAGE, Find, refers
from process import write

VARIABLES = 'expressionVariables = {\nstring FILE = "%s"\nstring SEL = "%s"\n}\n'
FIELD = """def OpenVDBAsset "field"
{
    asset filePath = @../assets/cloud.vdb@
    token fieldName = "density"
    token fieldDataType = "float"
    token fieldClass = "fogVolume"
}
"""
TANK = """def Volume "tank" (
    variants = {
        string look = "`${SEL}`"
    }
    prepend variantSets = ["look"]
)
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:a = </tank/a>
    rel field:b = </tank/b>
    def "a" (
        references = @`"./${FILE}.usda"`@
    )
    {
    }
    variantSet "look" = {
        "thick" {
            def "b" (
                references = @./field.usda@
            )
            {
            }
        }
    }
}
"""
OWN = VARIABLES % ("field", "thick")


def said(metadata: str, *sublayers: str) -> str:
    paths = ", ".join(f"@./{name}.usda@" for name in sublayers)
    return STAGE.replace(META, f"{META}{metadata}subLayers = [{paths}]\n")


@pytest.fixture
def assets(find: Find, shots: Path) -> Path:
    field = LAYER.replace("tank", "field") + FIELD
    other = LAYER.replace("tank", "other") + CLEAN.replace("tank", "other")
    write(shots, field=field, other=other, tank=LAYER.replace(META, META + OWN) + TANK)
    assert find("shots/tank.usda", rules=("VOL", "STG", "SCH009", "AST")) == []
    return shots


@pytest.mark.parametrize(
    ("variables", "codes"),
    [
        (VARIABLES % ("gone", "thick"), {"STG001"}),
        (VARIABLES % ("field", "none"), {"VOL001"}),
        (VARIABLES % ("other", "thick"), {"VOL002", "SCH009"}),
    ],
)
def test_variables_of_the_stage_are_to_blame_for_other_arcs(
    variables: str, codes: set[str], find: Find, assets: Path
) -> None:
    by_arc = STAGE.replace(META, META + variables) + refers("x", "./tank.usda")
    write(
        assets, one=by_arc, two=said(variables, "one"), three=STAGE + refers("y", "./one.usda@<>")
    )
    write(assets, four=STAGE + refers("z", "./one.usda@</x>").replace(">@", ">"))
    causes = find("shots/one.usda", "shots/four.usda", rules=("VOL", "STG", "SCH009"))
    assert {cause.code for cause in causes} == codes
    assert {cause.count for cause in causes} == {2}
    assert {(cause.source.layer, cause.source.path) for cause in causes} == {
        ("shots/one.usda", "/")
    }


@pytest.mark.parametrize("variables", [VARIABLES % ("field", "none"), ""])
def test_a_stage_is_to_blame_for_the_variables_of_a_sublayer_that_it_loses(
    variables: str, find: Find, assets: Path
) -> None:
    write(assets, one=said(variables, "tank"), two=said(variables, "one"))
    [cause] = find("shots/one.usda", "shots/two.usda", rules=("VOL001",))
    assert (cause.source.layer, cause.source.path, cause.count) == ("shots/one.usda", "/", 2)


def test_variables_are_to_blame_where_a_sublayer_needs_none(find: Find, assets: Path) -> None:
    path = '`if(defined("TAKE"), "./${TAKE}.vdb", "../assets/cloud.vdb")`'
    write(assets, fog=LAYER + CLEAN.replace("./cloud.vdb", path))
    takes = 'expressionVariables = {\nstring TAKE = "gone"\n}\n'
    write(assets, one=said(takes, "fog"), two=said(takes, "one"))
    assert find("shots/fog.usda") == []
    [cause] = find("shots/one.usda", "shots/two.usda")
    assert (cause.source.layer, cause.source.path, cause.count) == ("shots/one.usda", "/", 2)


def test_relocates_are_to_blame_for_the_prims_that_they_take_away(find: Find, shots: Path) -> None:
    write(shots.parent / "assets", tank=LAYER + CLEAN)
    gone = "relocates = {\n</x/density>: <>\n}\n"
    write(shots, one=STAGE.replace(META, META + gone) + refers("x"))
    write(shots, two=said("", "one"))
    write(shots, three=STAGE + refers("y", "./one.usda@</x>").replace(">@", ">"))
    write(shots, right=STAGE.replace(META, META + gone.replace("<>", "</x/fog>")) + refers("x"))
    stages = [f"shots/{name}.usda" for name in ("one", "two", "three", "right")]
    [cause] = find(*stages, rules=("VOL",))
    assert (cause.source.layer, cause.source.path, cause.count) == ("shots/one.usda", "/", 3)


TURNED = f"""def Xform "tank"
{{
    double3 xformOp:scale = (0.01, 0.01, 0.01)
    uniform token[] xformOpOrder = ["xformOp:scale"]
    {CLEAN.replace("</tank", "</tank/tank")}
}}
"""


def test_an_edit_above_what_an_arc_brings_is_to_blame_wherever_it_is_brought(
    find: Find, shots: Path
) -> None:
    assets = shots.parent / "assets"
    small = HEAD + LAYER.removeprefix(HEAD).replace("metersPerUnit = 1", "metersPerUnit = 0.01")
    write(assets, small=small + TURNED, tank=LAYER + refers("tank", "./small.usda"))
    seen = 'over "tank" (\ndoc = "seen"\n)\n{\n}'
    edit = refers("x", inside=f"uniform token[] xformOpOrder = []\n{seen}")
    note = 'over "x"\n{\nstring note = "seen"\n}\n'
    write(shots, one=STAGE + edit, two=said("", "one") + note)
    write(shots, three=STAGE + refers("y", "./one.usda@</x>").replace(">@", ">"))
    assert find("assets/tank.usda", rules=("STG009",)) == []
    stages = [f"shots/{name}.usda" for name in ("one", "two", "three")]
    [cause] = find(*stages, rules=("STG009",))
    source = cause.source
    assert (source.layer, source.path, source.property) == ("shots/one.usda", "/x", "xformOpOrder")
    assert cause.count == 3


def test_a_class_is_to_blame_for_what_a_sublayer_defines_below_an_over(
    find: Find, shots: Path
) -> None:
    world = CLEAN.replace("</tank", "</World/tank").replace("./cloud", "../assets/cloud")
    fields = 'over "World"\n{\nover "tank"\n{\nclass "density"\n{\n}\n}\n}\n'
    write(shots, fx=STAGE + f'over "World"\n{{\n{world}}}\n')
    write(shots, lay=STAGE + 'def Xform "World"\n{\n}\n', base=said("", "fx", "lay"))
    write(shots, one=said("", "base") + fields, two=said("", "one") + fields)
    assert find("shots/base.usda", "shots/fx.usda", rules=("VOL",)) == []
    [cause] = find("shots/one.usda", "shots/two.usda", rules=("VOL",))
    assert (cause.source.layer, cause.source.path) == ("shots/one.usda", "/World/tank/density")


def test_a_target_in_a_class_is_to_blame_and_not_the_prim_that_it_leads_to(
    find: Find, shots: Path
) -> None:
    write(shots.parent / "assets", tank=LAYER + CLEAN)
    below = refers("v", "../assets/tank.usda")
    heirs = "".join(f'def Xform "{each}" (\ninherits = </_c>\n)\n{{\n}}\n' for each in "ab")
    write(shots, base=STAGE + f'class "_c"\n{{\n{below}}}\n{heirs}')
    edit = 'over "_c"\n{\nover "v"\n{\nrel field:density = </a>\n}\n}\n'
    write(shots, one=said("", "base") + edit)
    assert find("shots/base.usda", rules=("VOL002",)) == []
    causes = find("shots/one.usda", rules=("VOL002",))
    assert {(cause.source.layer, cause.source.path) for cause in causes} == {
        ("shots/one.usda", "/_c/v")
    }


APIS = [
    f"ParticleField{name}API"
    for name in (
        "PositionAttribute",
        "KernelGaussianEllipsoid",
        "SphericalHarmonicsAttribute",
    )
]
SURFLET = '["ParticleFieldKernelGaussianSurfletAPI"]'
EXCHANGED = f'delete apiSchemas = ["{APIS[1]}"]\nprepend apiSchemas = {SURFLET}'


@pytest.mark.parametrize("by_class", [False, True])
def test_an_edit_of_apis_is_to_blame_and_not_the_arc(
    by_class: bool, find: Find, shots: Path
) -> None:
    splats = SPLATS.replace("3DGaussianSplat", "").replace("tank", "splat")
    listed = ", ".join(f'"{each}"' for each in APIS)
    splats = splats.replace('"splat"', f'"splat" (\nprepend apiSchemas = [{listed}]\n)')
    exchanged = over("splat", EXCHANGED)
    write(shots, base=LAYER + f'def Xform "tank"\n{{\n{splats}}}\n')
    above = LAYER.replace(META, f"{META}subLayers = [@./base.usda@]\n")
    write(shots, tank=above + f'over "tank"\n{{\n{exchanged}}}\n')
    if by_class:
        heir = 'def Xform "x" (\ninherits = </_c>\n)\n{\n}\n'
        write(shots, arc=STAGE + refers("_c", "./tank.usda").replace("def", "class") + heir)
    else:
        write(shots, arc=STAGE + refers("x", "./tank.usda"))
    taken = over("splat", f"delete apiSchemas = {SURFLET}")
    write(shots, one=said("", "arc") + f'over "x"\n{{\n{taken}}}\n')
    assert find("shots/tank.usda", "shots/arc.usda", rules=("PRT010",)) == []
    [cause] = find("shots/one.usda", rules=("PRT010",))
    assert (cause.source.layer, cause.source.path) == ("shots/one.usda", "/x/splat")


def over(name: str, metadata: str) -> str:
    return f'over "{name}" (\n{metadata}\n)\n{{\n}}\n'


@pytest.mark.parametrize(
    ("code", "edit", "path"),
    [
        ("FLD008", 'over OpenVDBAsset "tank"\n{\n}\n', "/tank"),
        ("VOL002", 'over "tank"\n{\nover Mesh "density"\n{\n}\n}\n', "/tank/density"),
        ("VOL001", "relocates", "/"),
    ],
)
def test_an_edit_inside_of_what_an_arc_brings_is_to_blame(
    code: str, edit: str, path: str, find: Find, shots: Path
) -> None:
    """It stands on top of a sublayer there, with its stage alone and with any that refers to it."""
    says_of_all = edit == "relocates"
    gone = "relocates = {\n</tank/density>: <>\n}\n" if says_of_all else ""
    write(shots, lib=STAGE + CLEAN.replace("./cloud", "../assets/cloud"))
    top = LAYER.replace(META, f"{META}{gone}subLayers = [@./lib.usda@]\n")
    write(shots, tank=top + ("" if says_of_all else edit))
    write(shots, one=STAGE + refers("x", "./tank.usda"), two=STAGE + refers("y", "./tank.usda"))
    assert find("shots/lib.usda", rules=(code,)) == []
    stages = [f"shots/{name}.usda" for name in ("tank", "one", "two")]
    [cause] = find(*stages, rules=(code,))
    assert (cause.source.layer, cause.source.path) == ("shots/tank.usda", path)
    assert cause.count == 3


def test_a_relationship_in_the_place_of_an_attribute_is_another_kind(
    find: Find, shots: Path
) -> None:
    """Which brings nothing to what lacks the attribute, such as a prim with clips."""
    clips = """clips = { dictionary default = {
        asset[] assetPaths = [@./clip.usda@]
        string primPath = "/tank"
        double2[] active = [(1, 0)]
    } }"""
    write(shots, clip=HEAD + 'over "tank"\n{\n}\n')
    write(shots, base=STAGE + CLEAN.replace('"tank"', f'"tank" (\n{clips}\n)', 1))
    write(shots, one=said("", "base") + 'over "tank"\n{\ncustom rel extent = </tank>\n}\n')
    assert "LNT002" not in {cause.code for cause in find("shots/one.usda", rules=("ALL",))}


NOTE = 'custom string note = "seen"'


def test_a_note_beside_an_edit_changes_nothing(find: Find, assets: Path) -> None:
    variables = VARIABLES % ("gone", "none")
    for name, inside in (("one", ""), ("two", NOTE)):
        arc = refers("x", "./tank.usda", inside=inside)
        write(assets, **{name: STAGE.replace(META, META + variables) + arc})
        causes = find(f"shots/{name}.usda", rules=("VOL001", "STG001"))
        assert {cause.code for cause in causes} == {"VOL001", "STG001"}
        assert {cause.source.path for cause in causes} == {"/"}
        assert {cause.source.property for cause in causes} <= {None, "field:b"}


def test_variables_are_to_blame_for_a_sublayer_that_is_not_there(find: Find, shots: Path) -> None:
    path = '`"./${FILE}.usda"`'
    own = f"subLayers = [@{path}@]\n{VARIABLES % ('below', 'thick')}"
    write(shots, below=STAGE + 'def Xform "tank"\n{\n}\n', lib=LAYER.replace(META, META + own))
    gone = VARIABLES % ("gone", "thick")
    write(shots, one=said(gone, "lib"), two=said(gone, "one"))
    write(shots, three=STAGE.replace(META, META + gone) + refers("x", "./lib.usda"))
    assert find("shots/lib.usda", rules=("STG001",)) == []
    [cause] = find("shots/one.usda", "shots/two.usda", rules=("STG001",))
    assert (cause.source.layer, cause.source.path, cause.count) == ("shots/one.usda", "/", 2)
    [other] = find("shots/three.usda", rules=("STG001",))
    assert (other.source.layer, other.source.path) == ("shots/three.usda", "/")


LOOKS = CLEAN.replace(
    'def Volume "tank"',
    'def Volume "tank" (\nvariants = { string look = "a" }\nprepend variantSets = ["look"]\n)',
).replace("rel field:density = </tank/density>", "rel field:density = </tank/other>")
LOOKS = (
    LOOKS.rstrip().removesuffix("}")
    + """variantSet "look" = {
    "a" {
        def OpenVDBAsset "other" {
            asset filePath = @./cloud.vdb@
            token fieldName = "density"
            token fieldDataType = "float"
        }
    }
    "b" {
    }
}
}
"""
)


def test_a_selection_that_the_tool_made_is_nobodys_edit(find: Find, shots: Path) -> None:
    """Nor is an arc of a shot, whose prim may have the name of one in the asset."""
    write(shots.parent / "assets", tank=LAYER + LOOKS)
    write(shots, mid=LAYER + refers("tank", "../assets/tank.usda"))
    write(shots, one=STAGE + refers("tank", "./mid.usda"))
    write(shots, two=STAGE + refers("tank", "./mid.usda", inside=NOTE))
    stages = ["assets/tank.usda", *(f"shots/{name}.usda" for name in ("mid", "one", "two"))]
    [cause] = find(*stages, rules=("VOL001",), selections=10)
    assert (cause.source.layer, cause.count) == ("assets/tank.usda", 4)
    assert find(*stages, rules=("VOL001",)) == []


def test_an_edit_is_one_cause_under_every_selection(find: Find, shots: Path) -> None:
    other = 'variantSet "look" = {\n"a" {\n}\n"b" {\n}\n}\n'
    variants = 'variants = { string look = "a" }\nprepend variantSets = ["look"]'
    tank = CLEAN.replace('"tank"', f'"tank" (\n{variants}\n)', 1).rstrip().removesuffix("}")
    write(shots.parent / "assets", tank=LAYER + tank + other + "}\n")
    gone = "relocates = {\n</x/density>: <>\n}\n"
    write(shots, one=STAGE.replace(META, META + gone) + refers("x"))
    for selections in (0, 10):
        [cause] = find("shots/one.usda", rules=("VOL001",), selections=selections)
        assert (cause.source.layer, cause.source.path) == ("shots/one.usda", "/")


def test_a_rate_that_is_undone_is_not_to_blame(find: Find, shots: Path) -> None:
    frames = ", ".join(f"{n}: [({n}, 0, 0), (9, 9, 9)]" for n in range(1, 5))
    moving = f"float3[] extent.timeSamples = {{ {frames} }}"
    extent = "float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]"
    write(shots, lib=HEAD + CLEAN.replace(extent, moving))
    head = "(\ntimeCodesPerSecond = %s\nsubLayers = [@./%s.usda@%s]\n)\n"
    write(shots, mid=HEAD + head % (48, "lib", " (scale = 0.5)"))
    write(shots, one=HEAD + head % (25, "mid", ""), two=HEAD + head % (25, "one", ""))
    assert find("shots/mid.usda", rules=("STG008",)) == []
    [cause] = find("shots/one.usda", "shots/two.usda", rules=("STG008",))
    assert (cause.source.layer, cause.count) == ("shots/one.usda", 2)
