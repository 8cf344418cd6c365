"""Stages in folders, many at a time, each with what is expected of it."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from .files import SHARED
from .generating import generate
from .model import Expected
from .text import volume
from .writing import ROOT, write_scene, write_shared

_BLOCK = re.compile(r"^```usda(?: (?P<name>\S+))?\n(?P<text>.*?)^```$", re.DOTALL | re.MULTILINE)
_SUFFIXES = {".f3d": "Field3DAsset", ".vdb": "OpenVDBAsset", ".nvdb": "OpenVDBAsset"}


class Case(NamedTuple):
    """A stage by its path in the folder of the batch; `expected` is None where nobody knows."""

    path: str
    story: str
    expected: Expected | None = None


def random_cases(folder: Path, seed: int, numbers: range) -> list[Case]:
    """Writes those with these numbers."""
    write_shared(folder)
    cases = []
    for number in numbers:
        made = generate(seed, number)
        path = write_scene(made.scene, folder / f"s{number:06}")
        story = f"seed {seed}, number {number}: {made.story}"
        cases.append(Case(_inside(folder, path), story, made.expected))
    return cases


def written_cases(folder: Path, most: int) -> Iterator[list[Case]]:
    """Writes what the project itself has: examples of pages, docs/examples, sample files."""
    write_shared(folder)
    yield [*_documented(folder), *_sampled(folder)]
    examples = _examples(folder)
    while batch := list(islice(examples, most)):
        yield batch


def _documented(folder: Path) -> Iterator[Case]:
    shutil.copytree(ROOT / "docs" / "examples", folder / "documented")
    for path in sorted((folder / "documented").rglob("*.usd*")):
        yield Case(_inside(folder, path), f"docs/examples: {path.name}")


def _sampled(folder: Path) -> Iterator[Case]:
    """A stage for each volume file there is, found or broken."""
    (folder / "sampled").mkdir()
    for path in sorted((folder / SHARED).rglob("*")):
        if path.suffix in _SUFFIXES and path.is_file():
            name = _inside(folder / SHARED, path)
            text = volume(f"asset filePath = @../{SHARED}/{name}@")
            stage = folder / "sampled" / f"{name.replace('/', '_')}.usda"
            typed = text.replace("OpenVDBAsset", _SUFFIXES[path.suffix])
            stage.write_text(typed, encoding="utf-8")
            yield Case(_inside(folder, stage), f"the file {name}")


def _examples(folder: Path) -> Iterator[Case]:
    """Those of the rule pages, each with the files in rules/assets beside it."""
    for page in sorted((ROOT / "rules").glob("*/*.md")):
        named: dict[str, str] = {}
        for block in _BLOCK.finditer(page.read_text(encoding="utf-8")):
            if block["name"]:
                named[block["name"]] = block["text"]
                continue
            place = folder / f"{page.stem}_{block.start()}"
            _write_example(place, {**named, "example.usda": block["text"]})
            named = {}
            yield Case(_inside(folder, place / "example.usda"), f"{page.name}, {block.start()}")


def _write_example(place: Path, texts: dict[str, str]) -> None:
    from zipfile import ZipFile

    # The files are the same in all examples, so links will do where there are any.
    assets = place.parent / SHARED
    samples = shutil.ignore_patterns("samples")
    shutil.copytree(assets, place, copy_function=_link, ignore=samples)
    for name, text in texts.items():
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        if name.endswith(".usdz"):
            with ZipFile(place / name, "w") as package:
                package.writestr("root.usda", text)
                package.write(assets / "cloud.vdb", "cloud.vdb")
        else:
            (place / name).unlink(missing_ok=True)
            (place / name).write_text(text, encoding="utf-8")


def _link(source: str, target: str) -> None:
    try:
        os.link(source, target)
    except OSError:
        shutil.copy(source, target)


def _inside(folder: Path, path: Path) -> str:
    return path.relative_to(folder).as_posix()
