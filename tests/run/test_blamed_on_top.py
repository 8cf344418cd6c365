"""A sublayer that is clean opened alone is not to blame for what other layers of the stage make."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from identities import CLEAN, LAYER, META, SPLATS, STAGE, Find, refers
from process import ASSETS, write

CENTIMETRES = LAYER.replace("metersPerUnit = 1", "metersPerUnit = 0.01") + CLEAN
SCALED = 'float3 xformOp:scale = (0.01, 0.01, 0.01)\ntoken[] xformOpOrder = ["xformOp:scale"]\n'
CORRECTED = STAGE + refers("set", "./centimetres.usda", inside=SCALED)
UNSCALED = 'over "set"\n{\nuniform token[] xformOpOrder = []\n}\n'
LOOKED_AT = f"""{STAGE}
def Xform "set" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{{
    rel material:binding = </set/look>
    def Material "look"
    {{
    }}
    {SPLATS.replace("radiance", "other")}
}}
"""
UNBOUND = 'over "set"\n{\nrel material:binding = None\n}\n'
HIDDEN = 'over "set"\n{\ntoken purpose = "render"\n}\n'


def on_top(*paths: str, said: str = "") -> str:
    names = ", ".join(f"@{path}@" for path in paths)
    return STAGE.replace(META, f"{META}subLayers = [{names}]\n") + said


@pytest.fixture
def base(shots: Path) -> Path:
    write(shots, centimetres=CENTIMETRES, corrected=CORRECTED, looked_at=LOOKED_AT)
    return shots


@pytest.mark.parametrize(
    ("sublayer", "said", "code", "path"),
    [
        ("corrected", UNSCALED, "STG009", "/set"),
        ("looked_at", UNBOUND, "ARR017", "/set"),
    ],
)
def test_an_edit_on_top_is_to_blame(
    sublayer: str, said: str, code: str, path: str, find: Find, base: Path
) -> None:
    write(base, one=on_top(f"./{sublayer}.usda", said=said))
    write(base, two=on_top("./one.usda"), again=on_top("./one.usda", said=said))
    write(base, edit=STAGE + said, beside=on_top("./edit.usda", f"./{sublayer}.usda"))
    assert find(f"shots/{sublayer}.usda", rules=(code,)) == []
    [cause] = find("shots/one.usda", "shots/two.usda", "shots/again.usda", rules=(code,))
    assert (cause.source.layer, cause.source.path) == ("shots/one.usda", path)
    ending = f" ('{sublayer}.usda' by itself has no such problem)"
    assert cause.first.message.endswith(ending)
    [beside] = find("shots/beside.usda", rules=(code,))
    assert (beside.source.layer, beside.source.path) == ("shots/edit.usda", path)


def test_an_edit_that_makes_nothing_wrong_moves_no_blame(find: Find, base: Path) -> None:
    """On top of a sublayer that is wrong by itself, or of a layer that has none."""
    write(base, wrong=STAGE + refers("set", "./centimetres.usda"))
    write(base, one=on_top("./wrong.usda", said=HIDDEN))
    [alone] = find("shots/wrong.usda", rules=("STG009",))
    [cause] = find("shots/one.usda", rules=("STG009",))
    assert cause.fingerprint == alone.fingerprint
    write(base, above=on_top("./corrected.usda", said=UNSCALED), two=on_top("./above.usda"))
    write(base, three=on_top("./two.usda", said=HIDDEN))
    [cause] = find("shots/two.usda", "shots/three.usda", rules=("STG009",))
    assert (cause.source.layer, cause.source.path) == ("shots/above.usda", "/set")


def test_where_no_edit_makes_it_wrong_the_sublayer_stays_to_blame(
    find: Find, base: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where the root itself does: here every layer by itself is taken for clean."""
    from usdvol_lint.engine.alone import Alone

    monkeypatch.setattr(Alone, "is_clean", lambda *asked: True)
    write(base, wrong=STAGE + refers("set", "./centimetres.usda"))
    write(base, hiding=on_top("./wrong.usda", said=HIDDEN))
    write(base, one=on_top("./hiding.usda"))
    [cause] = find("shots/one.usda", rules=("STG009",))
    assert (cause.source.layer, cause.source.path) == ("shots/wrong.usda", "/set")


FIELD = CLEAN[CLEAN.index("    def OpenVDBAsset") : CLEAN.rindex("}")]
SHIFT = (
    'double3 xformOp:translate = (10, 0, 0)\nuniform token[] xformOpOrder = ["xformOp:translate"]'
)
APART = f"""{STAGE}
def Volume "tank"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </fields/density>
    {SHIFT}
}}
def Xform "fields"
{{
    {SHIFT}
{FIELD}
}}
class "_look"
{{
}}
def Scope "set" (
    inherits = </_look>
)
{{
    rel unbound = </tank>
}}
"""
STOPPED = 'over "fields"\n{\ntoken[] xformOpOrder = []\n}\n'
GONE = 'over "tank" (\nactive = false\n)\n{\n}\n'
RETYPED = 'def OpenVDBAsset "set"\n{\n}\n'


@pytest.mark.parametrize(
    ("said", "code", "path", "property_"),
    [
        (STOPPED, "VOL013", "/fields", "xformOpOrder"),  # of a prim that the problem is not at
        (GONE, "VOL012", "/", None),  # of another prim, which no rule tells of
        (RETYPED, "FLD008", "/set", "extent"),  # by the type alone
    ],
)
def test_an_edit_of_another_prim_is_to_blame_and_one_of_metadata(
    said: str, code: str, path: str, property_: str | None, find: Find, shots: Path
) -> None:
    measured = APART.replace("rel unbound = </tank>", "float3[] extent = [(0, 0, 0), (1, 1, 1)]")
    write(shots, apart=measured, one=on_top("./apart.usda", said=said))
    shutil.copy(ASSETS / "cloud.vdb", shots)
    assert find("shots/apart.usda", rules=(code,)) == []
    [cause] = find("shots/one.usda", rules=(code,))
    source = cause.source
    assert (source.layer, source.path, source.property) == ("shots/one.usda", path, property_)
    assert cause.first.site.line == {"VOL013": 10, "VOL012": 6, "FLD008": 8}[code]
    write(shots, again=on_top("./one.usda", said=said))
    assert [each.source for each in find("shots/again.usda", rules=(code,))] == [source]


def test_what_is_said_beside_a_piece_pulls_no_blame_from_its_arc(find: Find, shots: Path) -> None:
    own = 'custom string note = "own"'
    piece = STAGE + refers("density", "./tank.usda@</tank/density>", inside=own).replace(">@", ">")
    write(shots, tank=LAYER + CLEAN, base=piece)
    note = 'over "density"\n{\ncustom string note = "x"\n}\n'
    write(shots, one=on_top("./base.usda", said=note))
    [alone] = find("shots/base.usda", rules=("VOL012",))
    assert (alone.source.layer, alone.source.path) == ("shots/base.usda", "/density")
    assert alone.source.property is None
    [cause] = find("shots/one.usda", rules=("VOL012",))
    assert cause.fingerprint == alone.fingerprint
