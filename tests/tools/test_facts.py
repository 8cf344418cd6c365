"""`python -m tools.facts` prints what every wing knows of a prim."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
from process import ROOT

EFFECTS = "docs/examples/broken/effects.usda"
WINGS = {
    "/World/Steam": {"prims", "layers", "volumes"},
    "/World/Steam/temperature": {"prims", "files", "layers", "grids"},
    "/World": {"prims", "layers"},
    "/": {"prims", "layers", "volumes"},
}


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "tools.facts", *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("prim", WINGS)
def test_the_wings_that_know_something_of_a_prim(prim: str) -> None:
    done = run(EFFECTS, prim)
    assert (done.returncode, done.stderr) == (0, "")
    headings = [line for line in done.stdout.splitlines() if line.startswith("# ")]
    assert {line[2:].partition(":")[0] for line in headings} == WINGS[prim]
    assert not re.search(r"(Error|Exception):", done.stdout)  # no question raised


def test_facts_of_a_field() -> None:
    lines = run(EFFECTS, "/World/Steam/temperature").stdout.splitlines()
    assert "shown_path: '/World/Steam/temperature'" in lines
    assert "gprim_above: Usd.Prim(</World/Steam>)" in lines
    assert [line for line in lines if line.startswith("path_marks: ")]


def test_facts_of_a_stage() -> None:
    lines = run(EFFECTS, "/").stdout.splitlines()
    assert "are_whole: True" in lines
    assert "shown_path: '/'" not in lines


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "usage: python -m tools.facts STAGE PRIM"),
        ((EFFECTS, "/nope"), f"{EFFECTS} has no prim </nope>"),
        (("nope.usda", "/nope"), "nope.usda: no such file or folder"),
    ],
)
def test_mistakes_are_one_line(arguments: tuple[str, ...], said: str) -> None:
    done = run(*arguments)
    assert (done.returncode, done.stderr) == (2, f"{said}\n")
