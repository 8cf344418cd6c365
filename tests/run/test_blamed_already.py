"""What contradicts itself in a layer stays its own where another changes one side of it."""

from __future__ import annotations

from pathlib import Path

from identities import LAYER, META, SPLATS, STAGE, Find, refers
from process import write

FEW = SPLATS.replace("(0.01, 0.01, 0.01), (0.01", "(0.01")
MOVED = "point3f[] positions = [(0.3, 0.2, 0.2), (0.7, 0.8, 0.8)]"
MORE = "point3f[] positions = [(0.3, 0.2, 0.2), (0.7, 0.8, 0.8), (0.5, 0.5, 0.5)]"
SHORT = ("ARR002",)


def on_top(path: str, inside: str) -> str:
    top = STAGE.replace(META, f"{META}subLayers = [@{path}@]\n")
    return f'{top}over "tank"\n{{\n{inside}\n}}\n'


def test_other_positions_are_not_to_blame_for_scales_that_were_too_few(
    find: Find, shots: Path
) -> None:
    write(shots.parent / "assets", tank=LAYER + FEW)
    write(shots, one=STAGE + refers("a", inside=MOVED), two=on_top("../assets/tank.usda", MOVED))
    write(shots, three=on_top("./two.usda", MOVED))
    [alone] = find("assets/tank.usda", rules=SHORT)
    [cause] = find("shots/one.usda", "shots/two.usda", "shots/three.usda", rules=SHORT)
    assert (cause.fingerprint, cause.count) == (alone.fingerprint, 3)


def test_more_positions_are_to_blame_where_the_scales_were_enough(find: Find, shots: Path) -> None:
    write(shots.parent / "assets", tank=LAYER + SPLATS)
    write(shots, one=STAGE + refers("a", inside=MORE), two=on_top("../assets/tank.usda", MORE))
    causes = find("shots/one.usda", "shots/two.usda", rules=SHORT)
    assert {cause.source.layer for cause in causes} == {"shots/one.usda", "shots/two.usda"}


def test_other_scales_are_to_blame_for_themselves(find: Find, shots: Path) -> None:
    """To mend those of the asset would mend nothing of them."""
    write(shots.parent / "assets", tank=LAYER + FEW)
    write(shots, one=STAGE + refers("a", inside="float3[] scales = [(1, 1, 1)]"))
    [cause] = find("shots/one.usda", rules=SHORT)
    assert (cause.source.layer, cause.source.property) == ("shots/one.usda", "scales")


def test_frames_are_those_of_the_layer_that_had_it_already(find: Find, shots: Path) -> None:
    both = "scales.timeSamples = {3: [(1, 1, 1)], 4: [(1, 1, 1), (1, 1, 1)]}"
    samples = FEW.replace("scales = [(0.01, 0.01, 0.01)]", both)
    write(shots.parent / "assets", tank=LAYER + samples)
    moved = refers("a", inside=MOVED).replace("usda@", "usda@ (offset = 100)")
    write(shots, one=STAGE + moved)
    [alone] = find("assets/tank.usda", rules=SHORT)
    [cause] = find("shots/one.usda", rules=SHORT)
    assert (cause.fingerprint, cause.cover) == (alone.fingerprint, alone.cover)
    assert (cause.first.site.times, cause.cover.frames) == ((103.0,), (3.0,))
