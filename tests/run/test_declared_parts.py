"""Stages that a configuration declares to be wholes, and all others, which are parts."""

from __future__ import annotations

from pathlib import Path

from partlayers import (
    APIS,
    BASE,
    COLOUR,
    DEGREE,
    EXTENT,
    FILE,
    REFERENCE,
    ROOT_PRIM,
    SPLAT,
    fields,
    layer,
    over,
    splats,
    volume,
    write,
)

from usdvol_lint.config import Config, Glob
from usdvol_lint.results import Report
from usdvol_lint.run.lint import lint

CHOSEN = ("AST001", "VOL004")


def told(report: Report) -> list[str]:
    return [
        f"{report.stages[place.stage].path.rpartition('/')[2]} {cause.code}"
        for cause in report.causes
        for place in cause.places
    ]


def test_a_part_lacks_nothing_and_a_whole_is_completed_by_nothing(tmp_path: Path) -> None:
    write(tmp_path, {"asset": layer(BASE, ROOT_PRIM)})
    shot = over("smoke", over("density", FILE), REFERENCE, "def")
    (tmp_path / "shot.usda").write_text(layer(shot), encoding="utf-8")

    def check(pattern: str, *names: str) -> Report:
        stages = (Glob(str(tmp_path), pattern),) if pattern else ()
        paths = [str(tmp_path / f"{name}.usda") for name in names]
        return lint(paths, Config(select=CHOSEN, stages=stages))

    assert told(check("", "asset")) == ["asset.usda AST001"]
    assert told(check("", "asset", "shot")) == []
    report = check("shot.usda", "asset")
    assert (told(report), [stage.part for stage in report.stages]) == ([], [True])
    report = check("shot.usda", "asset", "shot")
    assert (told(report), [stage.part for stage in report.stages]) == ([], [True, False])
    assert report.summary.parts == 1
    assert told(check("*.usda", "asset", "shot")) == ["asset.usda AST001"]


def test_a_part_lacks_no_apis_and_no_degree(tmp_path: Path) -> None:
    inside = f"{EXTENT}\n{SPLAT}{COLOUR}".replace(DEGREE, "")
    bare = fields(inside).replace("splats", "bare")
    (tmp_path / "asset.usda").write_text(layer(bare + splats(inside)), encoding="utf-8")
    codes = ("PRT001", "PRT002", "PRT003", "PRT007", "ARR004")

    def check(*patterns: str) -> set[str]:
        stages = tuple(Glob(str(tmp_path), pattern) for pattern in patterns)
        config = Config(select=codes, stages=stages)
        return {line.split()[1] for line in told(lint([str(tmp_path / "asset.usda")], config))}

    assert check("shot.usda") == set()
    assert check() == set(codes)


def test_a_misspelt_api_of_a_part_is_told(tmp_path: Path) -> None:
    """Also by the rule that is left to tell it."""
    misspelt = fields(f"{EXTENT}\n{SPLAT}", APIS[0].replace("Attribute", "Atribute"))
    (tmp_path / "asset.usda").write_text(layer(misspelt), encoding="utf-8")
    stages = (Glob(str(tmp_path), "shot.usda"),)
    config = Config(select=("PRT001", "PRT002", "PRT007"), stages=stages)
    assert told(lint([str(tmp_path / "asset.usda")], config)) == [
        "asset.usda PRT001",
    ]


def test_what_is_wrong_in_a_part_is_told(tmp_path: Path) -> None:
    wrong = volume("rel field:density = [</smoke/a>, </smoke/b>]")
    (tmp_path / "asset.usda").write_text(layer(wrong), encoding="utf-8")
    config = Config(select=CHOSEN, stages=(Glob(str(tmp_path), "shot.usda"),))
    assert told(lint([str(tmp_path / "asset.usda")], config)) == ["asset.usda VOL004"]


def test_what_a_shot_shows_of_an_excluded_layer_is_told(tmp_path: Path) -> None:
    write(tmp_path, {"asset": layer(BASE, ROOT_PRIM)})
    (tmp_path / "shot.usda").write_text(layer(over("smoke", "", REFERENCE, "def")), "utf-8")
    report = lint([str(tmp_path)], Config(select=CHOSEN, exclude=(Glob(str(tmp_path), "asset.*"),)))
    assert told(report) == ["shot.usda AST001"]
    source = report.causes[0].source.layer or ""
    assert source.endswith("/asset.usda")
