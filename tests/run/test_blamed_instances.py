"""What many instances show is one cause, whichever of them USD made a prototype of."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import CLEAN, LAYER, META, STAGE, Find, refers
from process import write
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
