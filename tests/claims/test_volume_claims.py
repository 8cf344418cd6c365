"""What the pages of rules/volume say of USD, asked of USD."""

from __future__ import annotations

import pytest
from answers import Said, bounds, stage
from pxr import UsdVol

FIELD = 'def OpenVDBAsset "density"\n{\n    token fieldName = "density"\n}\n'


def fields(text: str, **layers: str) -> dict[str, str]:
    """What `GetFieldPaths()` says of `/cloud`, which warns of nothing."""
    asked = stage(text, **layers)
    with Said() as said:
        found = UsdVol.Volume(asked.GetPrimAtPath("/cloud")).GetFieldPaths()
    assert said == []
    return {name: str(path) for name, path in found.items()}


def cloud(*properties: str) -> str:
    lines = "".join(f"    {line}\n" for line in properties)
    return f'def Volume "cloud"\n{{\n{lines}}}\n'


def test_VOL001_a_missing_target_is_returned() -> None:
    assert fields(cloud("rel field:density = </nowhere>")) == {"density": "/nowhere"}


def test_VOL001_a_created_relationship_is_custom() -> None:
    asked = stage(cloud())
    UsdVol.Volume(asked.GetPrimAtPath("/cloud")).CreateFieldRelationship("density", "/d")
    assert "custom rel field:density" in asked.GetRootLayer().ExportToString()


def test_VOL002_the_type_is_not_checked() -> None:
    text = cloud("rel field:density = </group>") + 'def Xform "group"\n{\n}\n'
    assert fields(text) == {"density": "/group"}


@pytest.mark.parametrize("target", ["", " = None", " = []"])
def test_VOL003_no_target_is_left_out(target: str) -> None:
    assert fields(cloud(f"rel field:density{target}")) == {}


def test_VOL003_a_blocked_relationship_is_left_out() -> None:
    asked = stage(cloud("rel field:density = </density>") + FIELD)
    volume = UsdVol.Volume(asked.GetPrimAtPath("/cloud"))
    volume.BlockFieldRelationship("density")
    assert volume.GetFieldPaths() == {}


def test_VOL004_several_targets_are_left_out() -> None:
    assert fields(cloud("rel field:density = [</a>, </b>]")) == {}


def test_VOL005_a_property_is_left_out() -> None:
    assert fields(cloud("rel field:density = </density.filePath>") + FIELD) == {}


def test_VOL005_another_relationship_forwards() -> None:
    text = cloud("rel field:density = </cloud.which>", "rel which = </density>")
    assert fields(text + FIELD) == {"density": "/density"}


def test_VOL006_only_relationships_in_the_namespace_count() -> None:
    lines = ("rel density = </density>", "rel field = </density>", 'string field:heat = "/density"')
    assert fields(cloud(*lines) + FIELD) == {}


def test_VOL007_a_target_outside_is_lost_without_an_error() -> None:
    weak = cloud("rel field:density = </density>") + FIELD
    asked = stage('def "cloud" (references = @weak@</cloud>)\n{\n}\n', weak=weak)
    volume = asked.GetPrimAtPath("/cloud")
    with Said() as said:
        assert volume.GetRelationship("field:density").GetTargets() == []
    assert any("outside the scope" in text for text in said)
    if hasattr(asked, "GetCompositionErrors"):
        assert asked.GetCompositionErrors() == []


@pytest.mark.parametrize("spec", ["over", "class"])
def test_VOL008_what_is_not_defined_looks_like_a_field(spec: str) -> None:
    text = cloud("rel field:density = </density>") + FIELD.replace("def", spec)
    looks_like_a_field(text)


def test_VOL008_what_is_inactive_looks_like_a_field() -> None:
    text = cloud("rel field:density = </density>")
    looks_like_a_field(text + FIELD.replace("\n", " (active = false)\n", 1))


def looks_like_a_field(text: str) -> None:
    assert fields(text) == {"density": "/density"}
    asked = stage(text)
    field = asked.GetPrimAtPath("/density")
    assert field.IsA(UsdVol.OpenVDBAsset)
    assert field.GetAttribute("fieldName").Get() == "density"
    assert field not in list(asked.Traverse())


def test_VOL008_below_an_inactive_prim_there_is_nothing() -> None:
    inside = f'def "group" (active = false)\n{{\n{FIELD}}}\n'
    text = cloud("rel field:density = </group/density>") + inside
    assert fields(text) == {"density": "/group/density"}
    assert not stage(text).GetPrimAtPath("/group/density")


def test_VOL009_the_last_name_counts() -> None:
    assert fields(cloud("rel field:smoke:density = </a>")) == {"density": "/a"}


def test_VOL009_one_of_two_is_dropped() -> None:
    both = cloud("rel field:density = </a>", "rel field:smoke:density = </b>")
    assert len(fields(both)) == 1


@pytest.mark.parametrize("field", ["", 'def OpenVDBAsset "density"\n{\n%s}\n'])
def test_VOL013_fields_are_no_part_of_the_bounds(field: str) -> None:
    moved(field)


def test_VOL015_the_bounds_are_those_of_the_volume() -> None:
    moved('def OpenVDBAsset "density"\n{\n%s}\n')


MOVED = """
    double3 xformOp:translate = (50, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
"""


def moved(field: str) -> None:
    """A field that is moved, or that is not there, changes nothing of the bounds."""
    inside = field.replace("%s", MOVED)
    lines = ("float3[] extent = [(0, 0, 0), (1, 1, 1)]", "rel field:density = </cloud/density>")
    found = bounds(stage(cloud(*lines, inside)), "/cloud")
    assert (found.GetMin(), found.GetMax()) == ((0, 0, 0), (1, 1, 1))


def test_VOL003_a_weaker_target_stands() -> None:
    weak = cloud("rel field:density = </cloud/density>")
    strong = 'def "cloud" (references = @weak@</cloud>)\n{\n    rel field:density\n}\n'
    assert fields(strong, weak=weak) == {"density": "/cloud/density"}


def test_VOL004_two_layers_that_prepend_make_two_targets() -> None:
    weak = cloud("prepend rel field:density = </cloud/a>")
    strong = 'def "cloud" (references = @weak@</cloud>)\n{\n    %s\n}\n'
    assert fields(strong % "prepend rel field:density = </cloud/b>", weak=weak) == {}
    assert fields(strong % "rel field:density = </cloud/b>", weak=weak) == {"density": "/cloud/b"}
