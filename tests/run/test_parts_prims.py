"""Particles, extents, types and clips in one stage of a run, and what they lack in another."""

from __future__ import annotations

import pytest
from partlayers import (
    ACTIVE,
    APIS,
    BOUND,
    COLOUR,
    DEGREE,
    EXTENT,
    FILE,
    MANIFEST,
    NAME,
    PATHS,
    RANGE,
    REFERENCE,
    ROOT_PRIM,
    SPLAT,
    WHOLE,
    Files,
    Judge,
    check_completed,
    clip,
    clips,
    field,
    fields,
    layer,
    over,
    splats,
    sublayers,
    volume,
)

from usdvol_lint import schema

OPACITY = "ParticleFieldOpacityAttributeAPI"
SIZED = COLOUR.replace(DEGREE, "").rstrip() + " (elementSize = 1)\n"
COMPLETED: dict[str, tuple[Files, set[str]]] = {
    "positions in the shot": (
        {
            "asset": layer(splats(EXTENT), 'defaultPrim = "splats"'),
            "shot": layer(splats(SPLAT + COLOUR, REFERENCE, "def")),
        },
        {"asset ARR001 warning"},
    ),
    "positions in half precision, and colours": (
        {
            "asset": layer(splats(EXTENT), 'defaultPrim = "splats"'),
            "colour": layer(splats(f"{EXTENT}\n{SPLAT}"), 'defaultPrim = "splats"'),
            "shot": layer(
                splats(
                    SPLAT.replace("point3f[] positions", "point3h[] positionsh") + COLOUR,
                    REFERENCE,
                    "def",
                )
                + over("more", COLOUR, "(prepend references = @./colour.usda@)", "def")
            ),
        },
        {"asset ARR001 warning", "colour ARR017 warning"},
    ),
    "the APIs of a particle field, with what they read": (
        {
            "part": layer(fields(EXTENT)),
            "shot": layer(fields(SPLAT + COLOUR, *APIS, OPACITY, what="over"), sublayers("part")),
        },
        {"part PRT001 error", "part PRT002 error", "part PRT003 error"},
    ),
    "the APIs that read what is there": (
        {
            "part": layer(fields(f"{EXTENT}\n{SPLAT}{COLOUR}", APIS[1])),
            "shot": layer(fields("", *APIS, OPACITY, what="over"), sublayers("part")),
        },
        {"part PRT001 error", "part PRT003 error", "part PRT007 warning"},
    ),
    "a type that has the APIs": (
        {
            "asset": layer(fields(EXTENT), 'defaultPrim = "splats"'),
            "shot": layer(splats(SPLAT + COLOUR, REFERENCE)),
        },
        {"asset PRT001 error", "asset PRT002 error", "asset PRT003 error"},
    ),
    "an API that provides what another one marks": (
        {
            "part": layer(
                fields(f"{EXTENT}\n{SPLAT}{COLOUR}", *APIS[::2], OPACITY, schema.KERNEL_BASE)
            ),
            "shot": layer(fields("", *APIS, what="over"), sublayers("part")),
        },
        {"part PRT004 warning"},
    ),
    "positions of two that have a degree": (
        {
            "part": layer(
                splats(f"{EXTENT}\n{DEGREE}") + splats(f"{EXTENT}\n{DEGREE}").replace("splats", "b")
            ),
            "shot": layer(
                splats(SPLAT + COLOUR, what="over") + over("b", SPLAT + COLOUR), sublayers("part")
            ),
        },
        {"part ARR001 warning"},
    ),
    "a degree": (
        {
            "part": layer(splats(f"{EXTENT}\n{SPLAT}{COLOUR}".replace(DEGREE, ""))),
            "sized": layer(
                over("other", f"{EXTENT}\n{SPLAT}{SIZED}", what="def ParticleField3DGaussianSplat")
            ),
            "shot": layer(
                splats(DEGREE, what="over") + over("other", DEGREE), sublayers("part", "sized")
            ),
        },
        {"part ARR004 error", "sized ARR004 error"},
    ),
    "an extent": (
        {
            "asset": layer(volume(BOUND.replace(EXTENT, "") + field(f"{NAME}\n{FILE}")), ROOT_PRIM),
            "shot": layer(over("smoke", EXTENT, REFERENCE, "def")),
        },
        {"asset SCH007 warning"},
    ),
    "a hint of the model above": (
        {
            "asset": layer(volume(BOUND.replace(EXTENT, "") + field(f"{NAME}\n{FILE}")), ROOT_PRIM),
            "shot": layer(
                over(
                    "set",
                    "float3[] extentsHint = [(-1, -1, -1), (3, 3, 3)]\n"
                    + over("smoke", "", REFERENCE, "def"),
                    '(kind = "component")',
                    "def Xform",
                )
            ),
        },
        {"asset SCH007 warning"},
    ),
    "prims that another layer defines": (
        {
            "fx": layer(over("set", over("fx", WHOLE), what="def Xform")),
            "layout": layer(over("set", over("fx", "", what="def Xform"), what="def Xform")),
            "other": layer(over("effects", WHOLE) + over("efects", "", what="def Xform")),
            "sets": layer(over("effects", "", what="def Xform")),
            "all": layer("", sublayers("other", "sets")),
            "shot": layer("", sublayers("fx", "layout")),
        },
        {"fx STG005 info", "other STG005 warning"},
    ),
    "a type": (
        {
            "asset": layer(WHOLE.replace("def Volume", "def"), ROOT_PRIM),
            "shot": layer(over("smoke", "", REFERENCE, "def Volume")),
        },
        {"asset SCH014 warning"},
    ),
    "an empty sublayer": (
        {"empty": layer(""), "shot": layer(WHOLE, sublayers("empty"))},
        {"empty STG003 warning"},
    ),
    "what the clips need": (
        {
            "asset": layer(
                clips(PATHS, "def Volume", BOUND + field(NAME)),
                *RANGE,
                ROOT_PRIM,
            ),
            "c1": clip(1, "over"),
            "c2": clip(2, "over"),
            "shot": layer(
                clips(ACTIVE).replace("(clips", "(prepend references = @./asset.usda@\nclips"),
                *RANGE,
            ),
        },
        {"asset AST016 error"},
    ),
    "a manifest that lacks the paths": (
        {
            "asset": layer(
                clips(f"{PATHS}\n{ACTIVE}\n{MANIFEST}", "def Volume", BOUND + field(NAME)),
                *RANGE,
                ROOT_PRIM,
            ),
            "c1": clip(1, "over"),
            "c2": clip(2, "over"),
            "manifest": layer(over("smoke", "")),
            "again": layer(over("smoke", field("asset filePath"))),
            "shot": layer(
                clips("asset manifestAssetPath = @./again.usda@").replace(
                    "(clips", "(prepend references = @./asset.usda@\nclips"
                ),
                *RANGE,
            ),
        },
        {"asset AST014 error"},
    ),
    "clips with their manifest": (
        {
            "c1": clip(1),
            "c2": clip(2),
            "manifest": layer(over("smoke", field("asset filePath"), what="def Volume")),
            "topology": layer(volume(BOUND + field(f"{NAME}\nasset filePath")), *RANGE),
            "result": layer(
                clips(f"{PATHS}\n{ACTIVE}\n{MANIFEST}", "over"), sublayers("topology"), *RANGE
            ),
        },
        {"c1 FLD001 warning", "c1 SCH007 warning", "manifest AST001 info", "topology AST001 info"},
    ),
}


@pytest.mark.parametrize("name", COMPLETED)
def test_what_another_stage_has_is_not_told(judge: Judge, name: str) -> None:
    check_completed(judge, *COMPLETED[name])
