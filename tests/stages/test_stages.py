"""Random stages: what is right is clean, a defect is found at its prim, and nothing else is.

What is blamed on another layer is found in that one alone.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from causes import told_twice

from stages.blaming import blamed_though_clean
from stages.defects import DEFECTS
from stages.generating import FEATURES, Generated, generate
from stages.judging import Found, misses
from stages.model import Expected
from stages.usda import layer_text
from stages.writing import write_scene, write_shared
from usdvol_lint.engine.engine import Engine

SEED = 26
COUNT = 2 * len(DEFECTS)
"""Every second one has a defect, so that each kind has its turn."""

PARTS = 8


@pytest.fixture(scope="module")
def batch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("stages")
    write_shared(folder)
    return folder


@pytest.mark.parametrize("part", range(PARTS))
def test_nothing_is_found_but_the_defect(
    part: int, engine: Engine, batch: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(batch)
    failures = []
    for number in range(part, COUNT, PARTS):
        made = generate(SEED, number)
        folder = batch / f"s{number:06}"
        path = write_scene(made.scene, folder)
        report = engine.lint(os.path.relpath(path))
        found = [
            Found(each.code, each.severity.label, each.site.prim, each.message)
            for each in report.findings
        ]
        missed = [*misses(made.expected, found), *told_twice(report.findings)]
        missed += blamed_though_clean(engine, path, report.findings)
        if missed:
            failures.append(failure(number, path, made, missed))
        else:
            shutil.rmtree(folder)
    assert not failures, "\n".join(["", *failures])


def failure(number: int, path: Path, made: Generated, missed: list[str]) -> str:
    """What a developer needs to see it again."""
    return "\n    ".join([f"seed {SEED}, number {number}: {made.story}", str(path), *missed])


def test_each_kind_of_defect_and_of_what_is_right_occurs() -> None:
    made = [generate(SEED, number) for number in range(COUNT)]
    assert {each.defect for each in made} == {None, *(defect.name for defect in DEFECTS)}
    assert frozenset().union(*(each.features for each in made)) == FEATURES


def test_a_seed_makes_the_same_stage_again() -> None:
    for number in range(40):
        texts = [
            [layer_text(layer) for layer in generate(SEED, number).scene.layers] for _ in range(2)
        ]
        assert texts[0] == texts[1]


FILE_MISSING = Found("AST002", "error", "/a/cloud/density", "no file")
EXTENT = Found("VOL013", "error", "/a/cloud", "reaches out")
UNUSED = Found("VOL012", "info", "/a/cloud/density", "no Volume targets it")


@pytest.mark.parametrize(
    ("expected", "found", "missed"),
    [
        (Expected(), [], []),
        (Expected(), [UNUSED], []),
        (Expected(), [EXTENT], ["error VOL013 at /a/cloud: reaches out"]),
        (Expected("VOL013", "/a/cloud"), [EXTENT], []),
        (Expected("VOL013", "/a/cloud"), [], ["no VOL013 at /a/cloud"]),
        (
            Expected("VOL013", "/b/cloud"),
            [EXTENT],
            ["no VOL013 at /b/cloud", "error VOL013 at /a/cloud: reaches out"],
        ),
        (
            Expected("VOL013", "/a/cloud"),
            [EXTENT, FILE_MISSING],
            ["error AST002 at /a/cloud/density: no file"],
        ),
        (Expected("VOL013", "/a/cloud", also=("AST002",)), [EXTENT, FILE_MISSING], []),
        (
            Expected("VOL013", "/a/cloud", also=("AST002",)),
            [EXTENT],
            ["no AST002, to which it leads"],
        ),
        (
            Expected("AST002", "/a/cloud/density", others=("/a/cloud/heat",)),
            [FILE_MISSING, FILE_MISSING._replace(prim="/a/cloud/heat")],
            [],
        ),
        (
            Expected("AST002", "/a/cloud/density", others=("/a/cloud/heat",)),
            [FILE_MISSING, FILE_MISSING._replace(prim="/a/cloud/fuel")],
            ["no AST002 at /a/cloud/heat", "error AST002 at /a/cloud/fuel: no file"],
        ),
        (Expected("VOL012", "/a/cloud/density", is_info=True), [UNUSED], []),
        (
            Expected("VOL013", "/a/cloud", is_info=True),
            [EXTENT],
            ["no VOL013 at /a/cloud", "error VOL013 at /a/cloud: reaches out"],
        ),
    ],
)
def test_what_is_missed_is_said(expected: Expected, found: list[Found], missed: list[str]) -> None:
    assert misses(expected, found) == missed
