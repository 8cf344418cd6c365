"""What is wrong in one stage of a run is told, whatever the others have."""

from __future__ import annotations

import pytest
from partlayers import (
    APIS,
    BASE,
    BOUND,
    COLOUR,
    DEGREE,
    EXTENT,
    FILE,
    NAME,
    REFERENCE,
    ROOT_PRIM,
    SPLAT,
    VERSIONED,
    WHOLE,
    Files,
    Judge,
    field,
    fields,
    layer,
    over,
    splats,
    sublayers,
    volume,
)

OPACITY = "ParticleFieldOpacityAttributeAPI"
WRONG = "asset filePath = @./pufff.0001.vdb@"
STAYS: dict[str, tuple[Files, list[str]]] = {
    "a part that nobody composes": (
        {"asset": layer(BASE, ROOT_PRIM), "shot": layer(WHOLE)},
        ["asset AST001 error"],
    ),
    "a part without a stage that completes it": (
        {"asset": layer(BASE, ROOT_PRIM), "shot": layer(over("smoke", "", REFERENCE, "def"))},
        ["asset AST001 error", "shot AST001 error"],
    ),
    "a declaration that no stage gives a value": (
        {
            "asset": layer(volume(BOUND + field(f"{NAME}\nasset filePath")), ROOT_PRIM),
            "shot": layer(over("smoke", "", REFERENCE, "def")),
        },
        ["asset AST001 info", "shot AST001 error"],
    ),
    "what is wrong in a part, and put right elsewhere": (
        {
            "asset": layer(volume(BOUND + field(f"{NAME}\n{WRONG}")), ROOT_PRIM),
            "shot": layer(over("smoke", over("density", FILE), REFERENCE, "def")),
        },
        ["asset AST002 error"],
    ),
    "a wrong name that another stage brings": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(over("smoke", over("density", WRONG), REFERENCE, "def")),
        },
        ["shot AST002 error"],
    ),
    "an empty path that another stage brings": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(over("smoke", over("density", "asset filePath = @@"), REFERENCE, "def")),
        },
        ["asset AST001 error", "shot AST001 error"],
    ),
    "a path that another stage blocks at all times": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(
                over(
                    "smoke",
                    over("density", "asset filePath.timeSamples = { 1: None }"),
                    REFERENCE,
                    "def",
                )
            ),
        },
        ["asset AST001 error", "shot AST001 error"],
    ),
    "a path that another stage brings as a string": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(
                over("smoke", over("density", 'string filePath = "./a.vdb"'), REFERENCE, "def")
            ),
        },
        ["asset AST001 error", "shot SCH003 error"],
    ),
    "particles that another stage does not bring": (
        {
            "asset": layer(
                splats(f"{EXTENT}\npoint3f[] positions = []\n"), 'defaultPrim = "splats"'
            ),
            "shot": layer(over("splats", "", REFERENCE, "def")),
        },
        ["asset ARR001 warning", "shot ARR001 warning"],
    ),
    "a shot that lacks what another shot brings to their asset": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "bare": layer(over("smoke", "", REFERENCE, "def")),
            "shot": layer(over("smoke", over("density", FILE), REFERENCE, "def")),
        },
        ["bare AST001 error"],
    ),
    "one of two places of an asset": (
        {
            "asset": layer(BASE, ROOT_PRIM),
            "shot": layer(
                over("one", over("density", FILE), REFERENCE, "def")
                + over("two", "", REFERENCE, "def")
            ),
        },
        ["shot AST001 error"],
    ),
    "a version that the shot does not select": (
        {
            "asset": VERSIONED,
            "shot": layer(over("smoke", "", REFERENCE, "def")),
        },
        ["asset AST001 info", "shot AST001 info"],
    ),
    "a target that is nowhere": (
        {
            "cache": layer(over("fx", field(f"{NAME}\n{FILE}"), what="def Scope")),
            "rig": layer(
                over("fx", volume(f"{EXTENT}\nrel field:density = </fx/denstiy>"), what="def Scope")
            ),
            "shot": layer("", sublayers("cache", "rig")),
        },
        ["cache VOL012 info", "rig VOL001 error", "shot VOL001 error"],
    ),
    "positions without extent": (
        {
            "asset": layer(splats(""), 'defaultPrim = "splats"'),
            "shot": layer(splats(SPLAT + COLOUR, REFERENCE, "def")),
        },
        ["asset SCH007 warning", "shot SCH007 warning"],
    ),
    "APIs that a mistake takes away": (
        {
            "part": layer(
                fields(f"{EXTENT}\n{SPLAT}", "ParticleFieldPositionAtributeAPI", APIS[1])
            ),
            "shot": layer(fields(COLOUR, *APIS, OPACITY, what="over"), sublayers("part")),
        },
        ["part PRT006 error", "shot PRT006 warning"],
    ),
    "a part whose whole lacks an API too": (
        {
            "part": layer(fields(EXTENT)),
            "shot": layer(
                fields(SPLAT + COLOUR, *APIS[::2], OPACITY, what="over"), sublayers("part")
            ),
        },
        ["part PRT002 error", "shot PRT002 error"],
    ),
    "coefficients that no degree fits": (
        {
            "part": layer(
                splats(
                    f"{EXTENT}\n{SPLAT}"
                    + COLOUR.replace("), (0", "), (0, 0, 0), (0").replace(DEGREE, "")
                )
            ),
            "shot": layer(splats(DEGREE, what="over"), sublayers("part")),
        },
        ["part ARR004 error", "shot ARR004 error"],
    ),
    "an empty stage": ({"empty": layer(""), "shot": layer(WHOLE)}, ["empty STG003 warning"]),
}


@pytest.mark.parametrize("name", STAYS)
def test_what_is_wrong_is_told(judge: Judge, name: str) -> None:
    layers, wanted = STAYS[name]
    assert judge(layers) == wanted
