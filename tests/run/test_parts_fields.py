"""Fields and Volumes in one stage of a run, and what they lack in another: that is fine."""

from __future__ import annotations

import pytest
from partlayers import (
    BOUND,
    EXTENT,
    FILE,
    NAME,
    RANGE,
    REFERENCE,
    RIG_AND_CACHE,
    ROOT_PRIM,
    SELECTING_SHOT,
    TWO_HALVES,
    VERSIONED,
    Files,
    Judge,
    check_completed,
    field,
    layer,
    over,
    sublayers,
    volume,
)

COMPLETED: dict[str, tuple[Files, set[str]]] = {
    "caches in a stronger layer": (
        {
            "base": layer(volume(BOUND + field(NAME)), *RANGE),
            "shot": layer(
                over(
                    "smoke",
                    over(
                        "density",
                        "asset filePath.timeSamples = "
                        "{ 1: @./puff.0001.vdb@, 2: @./puff.0002.vdb@ }",
                    ),
                ),
                sublayers("base"),
                *RANGE,
            ),
        },
        {"base AST001 error"},
    ),
    "declared, or empty, or blocked": (
        {
            "asset": layer(volume(BOUND + field(f"{NAME}\nasset filePath")), ROOT_PRIM),
            "blank": layer(volume(BOUND + field(f"{NAME}\nasset filePath = @@")), ROOT_PRIM),
            "block": layer(volume(BOUND + field(f"{NAME}\nasset filePath = None")), ROOT_PRIM),
            "shot": layer(
                "".join(
                    over(
                        f"s_{name}",
                        over("density", FILE),
                        f"(prepend references = @./{name}.usda@)",
                        what="def",
                    )
                    for name in ("asset", "blank", "block")
                )
            ),
        },
        {"asset AST001 info", "blank AST001 error", "block AST001 error"},
    ),
    "a rig that names the fields of a cache": (
        RIG_AND_CACHE,
        {"rig VOL001 error"},
    ),
    "two sublayers that need each other": (
        TWO_HALVES,
        {"one SCH007 warning", "one VOL001 error", "one VOL010 warning"},
    ),
    "an asset in which the shot selects a version": (
        {
            "asset": VERSIONED,
            "shot": SELECTING_SHOT,
        },
        {"asset AST001 info"},
    ),
    "a variant that defines the field": (
        {
            "asset": layer(
                volume(
                    f"{BOUND}\n"
                    + 'variantSet "version" = {\n"v1" {\n'
                    + field(f"{NAME}\n{FILE}")
                    + "}\n}\n",
                    meta='(prepend variantSets = "version")',
                ),
                ROOT_PRIM,
            ),
            "shot": SELECTING_SHOT,
        },
        {"asset VOL001 error"},
    ),
    "an assembly that says nothing of the prim": (
        {
            "asset": layer(volume(BOUND + field(NAME)), ROOT_PRIM),
            "assembly": layer(over("set", over("fog", "", REFERENCE, "def"), what="def Xform")),
            "shot": layer(over("set", over("fog", over("density", FILE))), sublayers("assembly")),
        },
        {"asset AST001 error", "assembly AST001 error"},
    ),
    "names, with the files": (
        {
            "asset": layer(volume(BOUND + field()), ROOT_PRIM),
            "shot": layer(over("smoke", over("density", f"{NAME}\n{FILE}"), REFERENCE, "def")),
        },
        {"asset AST001 error", "asset FLD001 warning"},
    ),
    "what a Volume declares": (
        {
            "asset": layer(
                volume(f"{EXTENT}\nrel field:density")
                + volume(BOUND + over("density", ""), "fire")
                + volume(BOUND + over("density", "", what="def"), "fog")
            ),
            "shot": layer(
                over("smoke", BOUND + field(f"{NAME}\n{FILE}"))
                + "".join(over(each, field(f"{NAME}\n{FILE}")) for each in ("fire", "fog")),
                sublayers("asset"),
            ),
        },
        {"asset VOL002 error", "asset VOL003 warning", "asset VOL008 error"},
    ),
    "fields": (
        {
            "asset": layer(volume(EXTENT), ROOT_PRIM),
            "fields": layer(field(f"{NAME}\n{FILE}"), 'defaultPrim = "density"'),
            "shot": layer(
                over(
                    "smoke",
                    "rel field:density = <density>\n"
                    + over("density", "", "(prepend references = @./fields.usda@)", "def"),
                    REFERENCE,
                    "def",
                )
            ),
        },
        {"asset VOL010 info", "fields VOL012 info"},
    ),
}


@pytest.mark.parametrize("name", COMPLETED)
def test_what_another_stage_has_is_not_told(judge: Judge, name: str) -> None:
    check_completed(judge, *COMPLETED[name])
