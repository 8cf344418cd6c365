"""A sublayer that is clean opened alone is not to blame for what other layers of the stage make."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import CLEAN, LAYER, META, SPLATS, STAGE, Find, refers
from process import write

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
