"""An edit that takes away what an asset brings is to blame for what is missing then."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import CLEAN, LAYER, META, STAGE, Find, refers
from process import write

FIELD = CLEAN[CLEAN.index("    def OpenVDBAsset") : CLEAN.rindex("}")]
BARE = CLEAN.replace(FIELD, "%s")
BROUGHT = LAYER.replace("tank", "density") + FIELD
REFERS = 'def "density" (\nreferences = @./density.usda@\n)\n{\n}\n'
CHOICE = BARE.replace(
    'Volume "tank"',
    'Volume "tank" (\nvariants = {\nstring look = "full"\n}\nprepend variantSets = "look"\n)',
)
TWO_LOOKS = 'variantSet "look" = {\n"full" {\n%s\n}\n"none" {\n%s\n}\n}\n'
WITHOUT_FILE = FIELD.replace("asset filePath = @./cloud.vdb@", "")
LOOK = 'variants = {\nstring look = "%s"\n}\n'


def edited(inside: str, meta: str = "", name: str = "tank") -> str:
    """A shot on top of the asset."""
    top = STAGE.replace(META, f"{META}subLayers = [@../assets/tank.usda@]\n")
    return f'{top}over "{name}" (\n{meta})\n{{\n{inside}\n}}\n'


@pytest.mark.parametrize(
    ("asset", "shot", "code", "path", "subject"),
    [
        (
            BARE % REFERS,
            edited('over "density" (\nreferences = None\n)\n{\n}'),
            "VOL002",
            "/tank/density",
            "/tank.field:density",
        ),
        (
            BARE % REFERS,
            edited('over "density" (\ndelete references = @../assets/density.usda@\n)\n{\n}'),
            "VOL002",
            "/tank/density",
            "/tank.field:density",
        ),
        (
            BARE % REFERS.replace("def", "over"),
            edited('over "density" (\nreferences = None\n)\n{\n}'),
            "VOL008",
            "/tank/density",
            "/tank.field:density",
        ),
        (CLEAN, edited('class "density"\n{\n}'), "VOL008", "/tank/density", "/tank.field:density"),
        (
            CLEAN,
            STAGE + refers("a", inside='class "density"\n{\n}'),
            "VOL008",
            "/a/density",
            "/a.field:density",
        ),
        (
            CHOICE % TWO_LOOKS % (FIELD, ""),
            STAGE + refers("a", meta=LOOK % "none"),
            "VOL001",
            "/a",
            "",
        ),
        (
            CHOICE % TWO_LOOKS % (FIELD, ""),
            STAGE + refers("a", meta=LOOK % "none" + "instanceable = true\n"),
            "VOL001",
            "/a",
            "",
        ),
        (CHOICE % TWO_LOOKS % (FIELD, ""), edited("", LOOK % "none"), "VOL001", "/tank", ""),
        (
            CHOICE % TWO_LOOKS % (FIELD, WITHOUT_FILE),
            STAGE + refers("a", meta=LOOK % "none"),
            "AST001",
            "/a",
            "/a/density.filePath",
        ),
    ],
)
def test_an_edit_is_to_blame_where_the_asset_alone_is_clean(
    asset: str, shot: str, code: str, path: str, subject: str, find: Find, shots: Path
) -> None:
    write(shots.parent / "assets", tank=LAYER + asset, density=BROUGHT)
    write(shots, one=shot)
    assert find("assets/tank.usda", rules=(code,)) == []
    [cause] = find("shots/one.usda", rules=(code,))
    source = cause.source
    assert (source.layer, source.path, source.subject) == ("shots/one.usda", path, subject)
    assert cause.first.message.endswith(" ('tank.usda' by itself has no such problem)")
    write(shots, two=STAGE.replace(META, f"{META}subLayers = [@./one.usda@]\n"))
    assert [each.source for each in find("shots/two.usda", rules=(code,))] == [source]


CLEARING = 'over "density" (\nreferences = None\n)\n{\n}'


@pytest.mark.parametrize(
    ("asset", "shot"),
    [
        (CHOICE % TWO_LOOKS % ("", ""), STAGE + refers("a", meta=LOOK % "none")),
        (BARE % 'def "density"\n{\n}\n', edited(CLEARING)),
        (BARE % REFERS.replace("density.usda", "hollow.usda"), edited(CLEARING)),
    ],
)
def test_an_edit_that_takes_away_nothing_moves_no_blame(
    asset: str, shot: str, find: Find, shots: Path
) -> None:
    hollow = LAYER.replace("tank", "density") + 'def "density"\n{\n}\n'
    write(shots.parent / "assets", tank=LAYER + asset, hollow=hollow)
    write(shots, one=shot)
    [alone] = find("assets/tank.usda", rules=("VOL001", "VOL002"))
    [shown] = find("shots/one.usda", rules=("VOL001", "VOL002"))
    assert shown.fingerprint == alone.fingerprint
    assert "by itself" not in shown.first.message


def test_an_edit_in_the_same_layer_says_nothing_of_it_by_itself(find: Find, shots: Path) -> None:
    """Which is not clean."""
    other = f'def "other" (\n{LOOK % "none"}\nreferences = </tank>\n)\n{{\n}}\n'
    write(shots.parent / "assets", tank=LAYER + CHOICE % TWO_LOOKS % (FIELD, "") + other)
    write(shots, one=STAGE + refers("a", "../assets/tank.usda@</other>", "").replace(">@", ">"))
    [cause] = find("shots/one.usda", rules=("VOL001",))
    assert (cause.source.layer, cause.source.path) == ("assets/tank.usda", "/other")
    assert "by itself" not in cause.first.message


def test_the_selection_of_a_set_is_to_blame_in_all_shots(find: Find, shots: Path) -> None:
    """One of the tool's own, which `--variants all` composes, is nowhere to blame."""
    assets = shots.parent / "assets"
    write(assets, tank=LAYER + CHOICE % TWO_LOOKS % (FIELD, ""))
    inner = refers("t", "./tank.usda", LOOK % "none")
    write(assets, set=LAYER.replace("tank", "set") + f'def Xform "set"\n{{\n{inner}}}\n')
    write(shots, one=STAGE + refers("a", "../assets/set.usda", "instanceable = true"))
    write(shots, two=STAGE + refers("a", "../assets/set.usda"))
    names = ("assets/set.usda", "shots/one.usda", "shots/two.usda")
    [cause] = find(*names, rules=("VOL001",))
    assert (cause.source.layer, cause.source.path, cause.count) == ("assets/set.usda", "/set/t", 3)
    [composed] = find("assets/tank.usda", rules=("VOL001",), selections=9)
    assert (composed.source.layer, composed.source.path) == ("assets/tank.usda", "/tank")
