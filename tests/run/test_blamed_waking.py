"""What is inactive in its layer is clean there: who makes it active is to blame for what it is."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import LAYER, META, STAGE, Find, refers
from process import write


def volume(name: str, active: str = "false") -> str:
    return f"""def Volume "{name}" (
    active = {active}
)
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </tank/density>
    rel field:heat = </tank/density>
    def OpenVDBAsset "lost"
    {{
        asset filePath = @./lost.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
    }}
}}
"""


def over(name: str, active: str, inside: str = "") -> str:
    return f'over "{name}" (\nactive = {active}\n)\n{{\n{inside}\n}}\n'


def on_top(path: str, said: str) -> str:
    return STAGE.replace(META, f"{META}subLayers = [@{path}@]\n") + said


ASSET = LAYER + 'def Xform "tank"\n{\n' + volume("a") + volume("b") + "}\n"
AWAKE = ASSET.replace("active = false", "active = true")
WAKE = over("a", "true")
WAKE_IN = over("tank", "true", WAKE)


@pytest.fixture
def asset(shots: Path) -> Path:
    write(shots, asset=ASSET)
    return shots


@pytest.mark.parametrize("by", ["reference", "sublayer"])
def test_who_wakes_it_is_to_blame(by: str, find: Find, asset: Path) -> None:
    if by == "reference":
        write(asset, one=STAGE + refers("tank", "./asset.usda", inside=WAKE))
    else:
        write(asset, one=on_top("./asset.usda", WAKE_IN))
    write(asset, two=on_top("./one.usda", WAKE_IN))
    write(asset, three=on_top("./two.usda", over("tank", "true")))
    assert find("shots/asset.usda") == []
    [cause] = find("shots/one.usda", "shots/two.usda", "shots/three.usda")
    source = cause.source
    assert (source.layer, source.path) == ("shots/one.usda", "/tank/a")
    assert source.subject == "/tank/a/lost.filePath"
    assert cause.first.message.endswith("('asset.usda' by itself has no such problem)")


def test_what_is_found_several_times_on_a_prim_stays_several_causes(
    find: Find, asset: Path
) -> None:
    write(asset, one=STAGE + refers("tank", "./asset.usda", inside=WAKE))
    causes = find("shots/one.usda", rules=("VOL001",))
    assert [cause.source.property for cause in causes] == ["field:density", "field:heat"]


def test_with_a_prim_above_the_edit_of_that_is_to_blame(find: Find, shots: Path) -> None:
    asleep = AWAKE.replace('Xform "tank"', 'Xform "tank" (\nactive = false\n)')
    write(shots, asset=asleep)
    write(shots, one=STAGE + refers("tank", "./asset.usda", "active = true", WAKE))
    assert find("shots/asset.usda") == []
    causes = find("shots/one.usda")
    assert {(cause.source.layer, cause.source.path) for cause in causes} == {
        ("shots/one.usda", "/tank")
    }
    assert [cause.source.subject for cause in causes] == [
        "/tank/a/lost.filePath",
        "/tank/b/lost.filePath",
    ]


def test_who_wakes_what_is_awake_in_its_layer_is_not_to_blame(find: Find, shots: Path) -> None:
    """Not even where another one took it away in between."""
    write(shots, asset=AWAKE)
    write(shots, taken=on_top("./asset.usda", over("tank", "true", over("a", "false"))))
    write(shots, one=on_top("./taken.usda", WAKE_IN))
    alone = find("shots/asset.usda")
    assert len(alone) == 2
    found = find("shots/one.usda")
    assert {cause.fingerprint for cause in found} == {cause.fingerprint for cause in alone}
    assert len(find("shots/taken.usda")) == 1


def test_what_is_found_on_several_prims_with_one_subject_stays_several_causes(
    find: Find, shots: Path
) -> None:
    order = 'uniform token[] xformOpOrder = ["xformOp:scale"]\n'
    lost = AWAKE.replace("float3[] extent", f"{order}float3[] extent")
    write(shots, asset=lost.replace('Xform "tank"', 'Xform "tank" (\nactive = false\n)'))
    write(shots, one=STAGE + refers("tank", "./asset.usda", "active = true"))
    causes = find("shots/one.usda", rules=("SCH015",))
    assert [cause.source.subject for cause in causes] == [
        "/tank/a.xformOpOrder xformOp:scale",
        "/tank/b.xformOpOrder xformOp:scale",
    ]
