"""Stages of one run that compose each other: what is absent in one and there in another is fine."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path

from partlayers import (
    APIS,
    BASE,
    COLOUR,
    EXTENT,
    FILE,
    REFERENCE,
    RIG_AND_CACHE,
    ROOT_PRIM,
    SPLAT,
    TWO_HALVES,
    WHOLE,
    fields,
    layer,
    over,
    splats,
    sublayers,
    write,
)
from process import run
from pxr import UsdUtils

from usdvol_lint.engine.engine import Engine


def test_a_run_hangs_on_neither_workers_nor_order(tmp_path: Path) -> None:
    write(tmp_path, TWO_HALVES)
    names = ["one.usda", "two.usda", "shot.usda"]
    for each in permutations(names):
        ran = run("--jobs", "2", *each, cwd=tmp_path)
        assert (ran.code, ran.err) == (0, "")
        assert "no findings in 3 stages" in ran.out
    assert run("one.usda", "two.usda", cwd=tmp_path).code == 1
    assert run("one.usda", cwd=tmp_path).code == 1


def test_stages_are_compared_by_what_they_are(tmp_path: Path) -> None:
    """A part that is reached through links is the same, whoever goes through one."""
    folder = tmp_path / "v002"
    folder.mkdir()
    write(folder, {"asset": layer(BASE, ROOT_PRIM)})
    (tmp_path / "current").symlink_to(folder, target_is_directory=True)
    (tmp_path / "link.usda").symlink_to(folder / "asset.usda")
    reference = REFERENCE.replace("./asset", "./current/asset")
    given = FILE.replace("./", "./v002/")
    shot = over("smoke", over("density", given), reference, "def")
    (tmp_path / "shot.usda").write_text(layer(shot), encoding="utf-8")
    for part in ("v002/asset.usda", "current/asset.usda", "link.usda"):
        assert run(part, cwd=tmp_path).code == 1
        assert run(part, "shot.usda", cwd=tmp_path).code == 0


def test_packages_are_parts_too(tmp_path: Path) -> None:
    write(tmp_path, {"asset": layer(BASE, ROOT_PRIM)})
    assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "asset.usda"), str(tmp_path / "asset.usdz"))
    reference = REFERENCE.replace("usda", "usdz")
    shot = over("smoke", over("density", FILE), reference, "def")
    (tmp_path / "shot.usda").write_text(layer(shot), encoding="utf-8")
    assert run("asset.usdz", cwd=tmp_path).code == 1
    assert run("asset.usdz", "shot.usda", cwd=tmp_path).code == 0


def test_reports_say_what_a_stage_completes(tmp_path: Path) -> None:
    write(tmp_path, RIG_AND_CACHE)
    json = ("--root", ".", "--output-format", "json")
    (rig,) = run("rig.usda", *json, cwd=tmp_path).json["stages"]
    (shot,) = run("shot.usda", *json, cwd=tmp_path).json["stages"]
    assert rig["completes"] is None
    assert shot["completes"] == {
        "layers": ["cache.usda", "rig.usda"],
        "specs": [
            {"layers": [layer], "path": path, "lacking": [lacking]}
            for layer in ("cache.usda", "rig.usda")
            for path, lacking in (("/fx/density", "field:"), ("/fx/smoke", "field:density"))
        ],
    }


def test_a_whole_stage_completes_nothing(engine: Engine, tmp_path: Path) -> None:
    """Also where it is of several layers, each whole, one of which refers to another."""
    write(tmp_path, {"asset": layer(WHOLE, ROOT_PRIM)})
    middle = over("smoke", "", REFERENCE, "def")
    (tmp_path / "middle.usda").write_text(layer(middle, ROOT_PRIM), encoding="utf-8")
    shot = over("smoke", "", REFERENCE.replace("asset", "middle"), "def")
    (tmp_path / "shot.usda").write_text(layer(shot), encoding="utf-8")
    for name in ("asset", "middle", "shot"):
        assert engine.lint(str(tmp_path / f"{name}.usda")).completes is None


def test_a_whole_particle_field_is_not_completed(engine: Engine, tmp_path: Path) -> None:
    """By its type or by a list of APIs, also where a stronger layer lists them again."""
    inside = f"{EXTENT}\n{SPLAT}{COLOUR}"
    listed = layer(fields(inside, *APIS))
    built_in = layer(splats(inside).replace("splats", "built_in"))
    again = fields(COLOUR, *APIS, what="over")
    shot = layer(again + again.replace("splats", "built_in"), sublayers("listed", "built_in"))
    write(tmp_path, {"listed": listed, "built_in": built_in, "shot": shot})
    assert engine.lint(str(tmp_path / "shot.usda")).completes is None
