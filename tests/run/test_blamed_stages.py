"""What only the root layer of a stage can say is lost where another layer brings that one."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import CLEAN, LAYER, META, STAGE, Find, refers
from process import write

VARIABLE = 'expressionVariables = {\nstring TAKE = "cloud"\n}\n'
TAKING = CLEAN.replace("@./cloud.vdb@", '@`"./${TAKE}.vdb"`@')
FALLBACK = 'fallbackPrimTypes = {\ntoken[] OpenVDBAset = ["OpenVDBAsset"]\n}\n'
UNKNOWN = CLEAN.replace("OpenVDBAsset", "OpenVDBAset")


def on_top(path: str, said: str = "") -> str:
    return STAGE.replace(META, f"{META}{said}subLayers = [@{path}@]\n")


@pytest.mark.parametrize(
    ("asset", "said", "code", "subject"),
    [
        (TAKING, VARIABLE, "AST004", "/tank/density.filePath"),
        (UNKNOWN, FALLBACK, "SCH001", "OpenVDBAset"),
    ],
)
def test_who_names_a_sublayer_loses_what_it_says(
    asset: str, said: str, code: str, subject: str, find: Find, shots: Path
) -> None:
    tank = LAYER.replace(META, META + said) + asset
    write(shots.parent / "assets", tank=tank, bare=LAYER + asset)
    write(shots, one=on_top("../assets/tank.usda"), two=on_top("./one.usda"))
    write(shots, right=on_top("../assets/tank.usda", said), bare=on_top("../assets/bare.usda"))
    assert find("assets/tank.usda", "shots/right.usda", rules=(code,)) == []
    [cause] = find("shots/one.usda", "shots/two.usda", rules=(code,))
    source = cause.source
    assert (source.layer, source.path, source.subject) == ("shots/one.usda", "/", subject)
    [bare] = find("shots/bare.usda", "assets/bare.usda", rules=(code,))
    assert (bare.source.layer, bare.count) == ("assets/bare.usda", 2)


def test_layers_in_a_circle_end(find: Find, shots: Path) -> None:
    asset = LAYER.replace(META, META + VARIABLE) + TAKING
    turning = asset.replace(META, f"{META}subLayers = [@../shots/one.usda@]\n")
    write(shots.parent / "assets", tank=turning)
    write(shots, one=on_top("../assets/tank.usda"))
    [cause] = find("shots/one.usda", rules=("AST004",))
    assert cause.source.layer == "shots/one.usda"


def test_a_reference_loses_the_fallback_for_a_type(find: Find, shots: Path) -> None:
    """An arc of a set is to blame in each shot that shows it."""
    write(shots.parent / "assets", tank=LAYER.replace(META, META + FALLBACK) + UNKNOWN)
    inner = f'def Xform "set"\n{{\n{refers("t", "./tank.usda")}}}\n'
    write(shots.parent / "assets", set=LAYER.replace("tank", "set") + inner)
    write(shots, one=STAGE + refers("a", "../assets/set.usda", "instanceable = true"))
    [cause] = find("assets/set.usda", "shots/one.usda", rules=("SCH001",))
    assert (cause.source.layer, cause.source.path, cause.count) == ("assets/set.usda", "/set/t", 2)
