"""A run writes what it was asked to write, and nothing else anywhere."""

from __future__ import annotations

import hashlib
import os
import shutil
from pathlib import Path
from typing import Any

import pytest
from process import ASSETS, ROOT, STUDIO, environment, run, write

from usdvol_lint.report import FORMATS

LAYER = (
    '#usda 1.0\ndef Volume "v"\n{{\n    rel field:density = </v/density>\n'
    '    def OpenVDBAsset "density"\n    {{\n        asset filePath = @{file}@\n    }}\n}}\n'
)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Inputs of every kind: stages, volume files, a configuration with a pack, a closed folder."""
    from pxr import Sdf, UsdUtils

    folder = write(tmp_path / "project", text=LAYER.format(file="assets/cloud.vdb"))
    shutil.copytree(ASSETS, folder / "assets")
    shutil.copytree(ROOT / "docs" / "examples", folder / "examples")
    for path in folder.rglob("*.usda"):
        path.chmod(0o644)
    layer = Sdf.Layer.OpenAsAnonymous(str(folder / "text.usda"))
    layer.Export(str(folder / "crate.usdc"))
    assert UsdUtils.CreateNewUsdzPackage(str(folder / "text.usda"), str(folder / "package.usdz"))
    write(folder / "closed", text=LAYER.format(file="gone.vdb")).chmod(0o555)
    shutil.copytree(STUDIO, folder / "pack", ignore=shutil.ignore_patterns("__pycache__"))
    text = "packs = ['pack']\nselect = ['ALL']\n"
    (folder / "studio.toml").write_text(text, encoding="utf-8")
    return folder


def everything(folder: Path) -> dict[str, Any]:
    """What a folder holds, with content, time of change and mode."""
    found = {}
    for path in (folder, *folder.rglob("*")):
        state = path.stat()
        content = hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
        found[str(path)] = (content, state.st_mtime_ns, state.st_mode, state.st_size)
    return found


def test_nothing_is_written_but_what_is_asked_for(project: Path, tmp_path: Path) -> None:
    out, home, temporary = (write(tmp_path / name) for name in ("out", "home", "temporary"))
    env = environment(
        GITHUB_ACTIONS="true",
        GITHUB_STEP_SUMMARY=str(out / "summary.md"),
        **dict.fromkeys(("HOME", "USERPROFILE", "XDG_CACHE_HOME"), str(home)),
        **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(temporary)),
    )
    named = ("--config", "studio.toml")
    reports = [
        word
        for name in sorted(FORMATS)
        for word in ("--output-format", name, "--output", str(out / name))
    ]
    baseline = str(out / "known.jsonl")
    before = everything(project)
    for arguments in (
        (*named, *reports, "."),
        (*named, "--variants", "all", "--statistics", "--jobs", "2", "."),
        (*named, "--write-baseline", baseline, "--root", ".", "text.usda"),
        (*named, "--baseline", baseline, "--prune-baseline", "--root", ".", "text.usda"),
        (*named, "--show-settings"),
        (*named, "--show-files", "."),
        ("--isolated", "--pack", "pack", "--explain", "STU001"),
        ("--test", "pack"),
        ("--output-format", "json", "--output", "closed/text.usda", "."),
    ):
        run(*arguments, cwd=project, env=env)
        assert everything(project) == before, arguments
    assert {each.name for each in out.iterdir()} == {*FORMATS, "known.jsonl", "summary.md"}
    assert [*home.iterdir(), *temporary.iterdir()] == []
    if os.name == "posix":  # so that the folder can be taken away
        (project / "closed").chmod(0o755)
