"""Laws of blame over random stages, right ones and those with a defect."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from stages.blaming import broken_laws
from stages.generating import generate
from stages.writing import write_scene, write_shared
from usdvol_lint.engine.engine import Engine

SEED = 27
COUNT = 120
PARTS = 4


@pytest.fixture(scope="module")
def batch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("blame")
    write_shared(folder)
    return folder


def broken(engine: Engine, batch: Path, number: int) -> Iterator[str]:
    """What one stage shows to be broken."""
    made = generate(SEED, number)
    folder = batch / f"s{number:06}"
    path = write_scene(made.scene, folder)
    for each in broken_laws(engine, path, number):
        yield f"number {number}: {each} ({made.story})"
    shutil.rmtree(folder)


@pytest.mark.parametrize("part", range(PARTS))
def test_blame_is_just(part: int, engine: Engine, batch: Path) -> None:
    numbers = range(part, COUNT, PARTS)
    found = [each for number in numbers for each in broken(engine, batch, number)]
    assert not found, "\n".join(["", *found])
