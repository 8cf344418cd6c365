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
    write(shots, again=on_top("./one.usda") + asset)
    assert find("assets/tank.usda", "shots/right.usda", rules=(code,)) == []
    [cause] = find("shots/one.usda", "shots/two.usda", "shots/again.usda", rules=(code,))
    source = cause.source
    assert (source.layer, source.path, source.subject) == ("shots/one.usda", "/", subject)
    [bare] = find("shots/bare.usda", "assets/bare.usda", rules=(code,))
    assert (bare.source.layer, bare.count) == ("assets/bare.usda", 2)


def take(name: str) -> str:
    return VARIABLE.replace("cloud", name)


def test_other_variables_than_those_of_a_sublayer_are_to_blame(find: Find, shots: Path) -> None:
    """USD does not read those of the sublayer, by which it is clean opened alone."""
    write(shots.parent / "assets", tank=LAYER.replace(META, META + VARIABLE) + TAKING)
    write(shots, one=on_top("../assets/tank.usda", take("gone")))
    write(shots, again=on_top("./one.usda", take("gone")), right=on_top("./one.usda", VARIABLE))
    assert not find("assets/tank.usda", "shots/right.usda")
    [cause] = find("shots/one.usda", "shots/again.usda")
    assert (cause.source.layer, cause.source.path, cause.count) == ("shots/one.usda", "/", 2)
    assert cause.source.subject == "/tank/density.filePath"


@pytest.mark.parametrize("again", ["gone", "lost"])
def test_variables_that_mend_nothing_move_no_blame(again: str, find: Find, shots: Path) -> None:
    """Said again, or others that lead to no file either; by a sublayer, and through an arc."""
    write(shots.parent / "assets", tank=LAYER.replace(META, META + take("gone")) + TAKING)
    write(shots, one=on_top("../assets/tank.usda", take(again)))
    write(shots, two=STAGE.replace(META, META + take(again)) + refers("a"))
    write(shots, three=on_top("./two.usda", take(again)))
    [alone] = find("assets/tank.usda")
    [cause] = find("assets/tank.usda", "shots/one.usda", "shots/two.usda", "shots/three.usda")
    assert (cause.fingerprint, cause.count) == (alone.fingerprint, 4)


def test_the_same_variables_again_are_not_to_blame_for_what_a_file_lacks(
    find: Find, shots: Path
) -> None:
    other = TAKING.replace('fieldName = "density"', 'fieldName = "smoke"')
    write(shots.parent / "assets", tank=LAYER.replace(META, META + VARIABLE) + other)
    write(shots, one=on_top("../assets/tank.usda", VARIABLE))
    [alone] = find("assets/tank.usda", rules=("GRD003",))
    [cause] = find("shots/one.usda", rules=("GRD003",))
    assert cause.fingerprint == alone.fingerprint


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
