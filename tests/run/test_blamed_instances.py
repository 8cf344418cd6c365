"""What many instances show is one cause, whichever of them USD made a prototype of."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from identities import CLEAN, HEAD, LAYER, META, SPLATS, STAGE, Find, refers
from process import ASSETS, write
from pxr import Usd

from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.model import Source

INSTANCE = "instanceable = true"
NAMES = "ABCDEFGH"
INHERITING = CLEAN.replace('"tank"', '"tank" (\ninherits = </_tank>\n)', 1)
CLASS = 'class "_tank"\n{\nover "density"\n{\n%s\n}\n}\n'


def test_the_first_place_stands_for_all(find: Find, shots: Path) -> None:
    """USD takes another instance in each run: of eight one of which it is likely not the first."""
    write(shots.parent / "assets", tank=LAYER + CLEAN)
    instances = "".join(refers(name, meta=INSTANCE) for name in NAMES)
    write(shots, one=STAGE + instances)
    stage = Usd.Stage.Open(str(shots / "one.usda"))
    density = stage.GetPrimAtPath("/H/density")
    for prim in (density, density.GetPrimInPrototype()):
        assert str(index_of(prim).rootNode.path) == "/A/density"
    assert index_of(stage.GetPrimAtPath("/H")).rootNode.path == "/H"


@pytest.mark.parametrize(
    ("said", "code", "source"),
    [
        ('token fieldName = "nope"', "GRD003", ("/_tank/density", "fieldName")),
        ('token fieldDataType = "double3"', "GRD005", ("/_tank/density", "fieldDataType")),
        ('token fieldClass = "levelSet"', "GRD006", ("/_tank/density", "fieldClass")),
    ],
)
@pytest.mark.parametrize("meta", ["", INSTANCE])
def test_a_class_of_the_shot_is_one_cause(
    meta: str,
    said: str,
    code: str,
    source: tuple[str, str],
    find: Find,
    shots: Path,
) -> None:
    write(shots.parent / "assets", tank=LAYER + INHERITING)
    write(shots, one=STAGE + CLASS % said + refers("A", meta=meta) + refers("B", meta=meta))
    [cause] = find("shots/one.usda", rules=(code,))
    assert cause.source == Source("shots/one.usda", *source)


def test_a_nested_instance_is_that_of_the_asset(find: Find, shots: Path) -> None:
    """Here a Gprim below a Volume, in an asset that refers to another as an instance."""
    nested = CLEAN.replace("rel field", 'def Mesh "proxy"\n{\n}\nrel field', 1)
    write(
        shots.parent / "assets",
        tank=LAYER + nested,
        set=LAYER.replace("tank", "set")
        + f'def Xform "set"\n{{\n{refers("cloud", "./tank.usda", INSTANCE)}}}\n',
    )
    write(shots, one=STAGE + "".join(refers(name, "../assets/set.usda") for name in "AB"))
    alone = find("assets/tank.usda", rules=("SCH009",))
    shown = find("shots/one.usda", rules=("SCH009",))
    assert [each.fingerprint for each in shown] == [each.fingerprint for each in alone]


def test_units_begin_to_differ_at_a_sublayer(find: Find, shots: Path) -> None:
    """What it refers to has the same: the line in which the shot names it is to blame."""
    write(shots.parent / "assets", tank=LAYER + CLEAN)
    write(shots, layout=STAGE + refers("a"))
    other = META.replace("metersPerUnit = 1", "metersPerUnit = 0.01")
    write(shots, one=f"#usda 1.0\n(\n{other}subLayers = [@./layout.usda@]\n)\n")
    [cause] = find("shots/one.usda", rules=("STG009",))
    assert (cause.source.layer, cause.source.path) == ("shots/one.usda", "/")


def test_a_sublayer_is_one_cause_for_all_fields(find: Find, shots: Path) -> None:
    samples = "filePath.timeSamples = {\n1: @./cloud.vdb@,\n2: @./two_grids.vdb@,\n}\n"
    animated = CLEAN.replace("filePath = @./cloud.vdb@", samples)
    two = animated.rstrip().removesuffix("}") + (
        f'rel field:heat = </tank/heat>\ndef OpenVDBAsset "heat"\n{{\nasset {samples}\n}}\n}}\n'
    )
    write(shots.parent / "assets", tank=LAYER + two)
    ranged = META + "startTimeCode = 1001\nendTimeCode = 1002\n"
    write(shots, one=f"#usda 1.0\n(\n{ranged}subLayers = [@../assets/tank.usda@]\n)\n")
    [cause] = find("shots/one.usda", rules=("AST012",))
    assert (cause.source.path, cause.source.subject, cause.count) == (
        "/",
        "../assets/tank.usda",
        2,
    )


APIS = 'prepend apiSchemas = ["ColorSpaceDefinitionAPI:studio", "ColorSpaceAPI"]'
SPACES = """uniform token colorSpace:name = "wide"
uniform token colorSpaceDefinition:studio:name = "wide"
"""
WIDE = SPLATS.replace('"tank"\n{\n', f'"tank" (\n{APIS}\n)\n{{\n{SPACES}')


@pytest.mark.parametrize("asset", [WIDE, CLEAN.replace("</tank/density>", "<density>")])
def test_an_instance_shows_what_a_reference_shows(asset: str, find: Find, shots: Path) -> None:
    inside = LAYER.replace("tank", "set") + f'def Xform "set"\n{{\n{asset}\n}}\n'
    write(shots.parent / "assets", set=inside, tank=LAYER + asset)
    for name in ("set", "tank"):
        path = f"../assets/{name}.usda"
        write(shots, one=STAGE + refers("A", path), two=STAGE + refers("A", path, INSTANCE))
        plain, instance = (
            [(each.code, each.source) for each in find(f"shots/{shot}.usda", rules=("ALL",))]
            for shot in ("one", "two")
        )
        assert [each for each in instance if each[0] != "STG007"] == plain


def test_a_field_of_an_instance_is_compared_with_its_siblings(find: Find, shots: Path) -> None:
    """One that stands still beside one that plays: the Volume is the instance itself."""
    for frame in range(1, 5):
        shutil.copy(ASSETS / "cloud.vdb", shots.parent / "assets" / f"puff.{frame:04}.vdb")
    samples = "".join(f"{100 + n}: @./puff.{n:04}.vdb@,\n" for n in range(1, 5))
    field = 'def OpenVDBAsset "{}"\n{{\nasset filePath.timeSamples = {{\n{}}}\n}}\n'
    still = "".join(f"{100 + n}: @./puff.0001.vdb@,\n" for n in range(1, 5))
    fields = field.format("density", samples) + field.format("heat", still)
    bound = "rel field:density = </tank/density>\nrel field:heat = </tank/heat>\n"
    write(shots.parent / "assets", tank=f'{LAYER}def Volume "tank"\n{{\n{bound}{fields}}}\n')
    write(shots, one=STAGE + refers("A"), two=STAGE + refers("A", meta=INSTANCE))
    plain, instance = (find(f"shots/{shot}.usda", rules=("AST017",)) for shot in ("one", "two"))
    assert [each.fingerprint for each in plain] == [each.fingerprint for each in instance]
    assert [each.code for each in plain] == ["AST017"]


FORWARDING = CLEAN.replace("</tank", "</tank/tank").replace("</tank/tank/density>", "</tank.proxy>")
FORWARDED = f'def Xform "tank"\n{{\nrel %s = </tank/tank/density>\n{FORWARDING}\n}}\n'


@pytest.mark.parametrize("name", ["proxy", "field:density"])
def test_what_only_an_instance_breaks_is_no_mistake_of_the_asset(
    name: str, find: Find, shots: Path
) -> None:
    """A prototype lacks the properties of its instances: what made them so is to blame, once."""
    asset = FORWARDED % name
    write(shots.parent / "assets", tank=LAYER + asset.replace("tank.proxy", f"tank.{name}"))
    instances = "".join(refers(each, meta=INSTANCE) for each in "AB")
    write(shots, one=STAGE + refers("A"), two=STAGE + instances)
    rules = ("VOL", "SCH014")
    assert find("assets/tank.usda", "shots/one.usda", rules=rules) == []
    [cause] = find("shots/two.usda", rules=rules)
    assert cause.code == "VOL005"
    assert (cause.source.layer, cause.source.path) == ("shots/two.usda", "/A")


def test_a_variant_above_an_instance_may_say_what_is_below_it(find: Find, shots: Path) -> None:
    meta = 'variants = {\nstring look = "thin"\n}\nprepend variantSets = "look"\n'
    misnamed = 'over "Tank"\n{\nfloat3[] extent = [(0, 0, 0), (1, 1, 1)]\n}\n'
    thick = 'variantSet "look" = {\n"thick" {\ndef Xform "Tank"\n{\n}\n}\n"thin" {\n}\n}\n'
    inside = LAYER.replace("tank", "set") + f'def Xform "set"\n{{\n{CLEAN}\n}}\n'
    chosen = refers("set", "./inner.usda", meta, misnamed + thick)
    write(shots.parent / "assets", inner=inside, set=LAYER.replace("tank", "set") + chosen)
    write(shots, one=STAGE + refers("A", "../assets/set.usda", INSTANCE))
    assert find("assets/set.usda", "shots/one.usda", rules=("STG010",)) == []
    other = LAYER.replace("tank", "set") + chosen.replace('def Xform "Tank"', 'def Xform "Jar"')
    write(shots.parent / "assets", set=other)
    both = find("assets/set.usda", "shots/one.usda", rules=("STG010",))
    assert [(each.source.layer, each.count) for each in both] == [("assets/set.usda", 2)]


CLIPS = (
    "asset[] assetPaths = [@./clip.usda@]",
    'string primPath = "/tank"',
    "double2[] active = [(1, 0)]",
    "asset manifestAssetPath = @./manifest.usda@",
)
UNTOLD = CLEAN.replace("asset filePath = @./cloud.vdb@\n", "")


@pytest.mark.parametrize(
    ("keys", "code"),
    [
        (CLIPS, "AST014"),
        (CLIPS[:2], "AST016"),
        ((CLIPS[0], CLIPS[1].replace("tank", "tnak"), CLIPS[2]), "AST016"),
    ],
)
@pytest.mark.parametrize("is_below", [False, True])
def test_clips_that_are_faulty_are_one_cause_on_instances_too(
    is_below: bool, keys: tuple[str, ...], code: str, find: Find, shots: Path
) -> None:
    """Also where they would not reach into these if they were not."""
    meta = "clips = {{\ndictionary default = {{\n{}\n}}\n}}".format("\n".join(keys))
    ranged = META + "startTimeCode = 1\nendTimeCode = 2\n"
    said = 'over "density"\n{\nasset filePath.timeSamples = { 1: @./cloud.vdb@ }\n}\n'
    inside = UNTOLD
    if is_below:
        inside = UNTOLD.replace("</tank", "</tank/smoke").replace('"tank"', '"smoke"')
        inside = f'def Xform "tank"\n{{\n{inside}}}\n'
        said = f'over "smoke"\n{{\n{said}}}\n'
    bearing = inside.replace('"tank"', f'"tank" (\n{meta}\n)', 1)
    write(
        shots.parent / "assets",
        tank=LAYER.replace(META, ranged) + bearing,
        clip=HEAD + f'over "tank"\n{{\n{said}}}\n',
        manifest=HEAD + 'over "tank"\n{\n}\n',
    )
    instances = "".join(refers(name, meta=INSTANCE) for name in "AB")
    write(shots, one=STAGE.replace(META, ranged) + instances)
    rules = ("AST001", "AST014", "AST016")
    [cause] = find("assets/tank.usda", "shots/one.usda", rules=rules)
    assert (cause.code, cause.source.layer, cause.count) == (code, "assets/tank.usda", 3)


def test_what_two_layers_say_below_an_instance_are_two(find: Find, shots: Path) -> None:
    """What a layer on top adds moves nothing."""
    inside = LAYER.replace("tank", "set") + f'def Xform "set"\n{{\n{CLEAN}\n}}\n'
    write(shots.parent / "assets", set=inside)
    lost = 'over "tank"\n{\nover "density"\n{\ntoken fieldName = "fuel"\n}\n}\n'
    write(shots, layout=STAGE + refers("a", "../assets/set.usda", INSTANCE, lost))
    more = 'over "a"\n{\nover "tank"\n{\nfloat3[] extent = [(0, 0, 0), (9, 9, 9)]\n}\n}\n'
    write(shots, top=STAGE.replace(META, f"{META}subLayers = [@./layout.usda@]\n") + more)
    [alone] = find("shots/layout.usda", rules=("STG006",))
    causes = find("shots/top.usda", rules=("STG006",))
    assert alone.source == Source(
        "shots/layout.usda", "/a/tank/density", "fieldName", "instanceable"
    )
    assert {each.source for each in causes} == {
        alone.source,
        Source("shots/top.usda", "/a/tank", "extent", "instanceable"),
    }
