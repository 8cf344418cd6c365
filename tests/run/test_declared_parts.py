"""Stages that a configuration declares to be wholes, and all others, which are parts."""

from __future__ import annotations

from pathlib import Path

from partlayers import BASE, FILE, REFERENCE, ROOT_PRIM, layer, over, volume, write

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
