"""The hooks do their work in a real repository, through a real pre-commit."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from process import ROOT
from pxr import Sdf

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="needs git")

STAGE = """\
#usda 1.0
def Volume "smoke"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </smoke/density>
    def OpenVDBAsset "density"
    {
        token fieldClass = "fogVolume"
        token fieldDataType = "float"
        token fieldName = "density"
        asset filePath = @./FILE.vdb@
    }
}
"""
HOOKS = """\
repos:
  - repo: {repository}
    rev: {revision}
    hooks:
      - id: usdvol-lint
      - id: usdvol-lint-all
        stages: [manual]
      - id: usdvol-lint
        alias: telling
        entry: usdvol-lint
        stages: [manual]
"""
LONG = () if os.name == "nt" else ("long" * 50,) * 3
"""Folders by which a few files make a command as long as a system or pre-commit takes."""
MANY = 240
LEFT_OUT = {".git", ".venv", "__pycache__", ".hypothesis", "dist"}


class Repository:
    """A git repository with a pre-commit that keeps its environments to itself."""

    def __init__(self, folder: Path, home: Path) -> None:
        self.folder = folder
        folder.mkdir(exist_ok=True)
        # Whoever runs the tests may be a git hook, or have git set up in some way.
        foreign = ("GIT_", "PYTHON", "PRE_COMMIT", "VIRTUAL_ENV")
        self._env = {k: v for k, v in os.environ.items() if not k.startswith(foreign)}
        self._env |= {
            "GIT_CONFIG_GLOBAL": os.devnull,
            "GIT_CONFIG_NOSYSTEM": "1",
            "PRE_COMMIT_HOME": str(home),
            "PRE_COMMIT_COLOR": "never",
            **{f"GIT_{who}_{what}": "a@b.c" for who in ("AUTHOR", "COMMITTER")
               for what in ("NAME", "EMAIL")},
        }  # fmt: skip
        self.git("init", "--quiet")

    def git(self, *arguments: str) -> str:
        done = self._run(["git", *arguments])
        assert done.returncode == 0, done.stdout
        return done.stdout.strip()

    def pre_commit(self, *arguments: str) -> tuple[int, str]:
        self.git("add", "--all")
        done = self._run([sys.executable, "-m", "pre_commit", "run", *arguments])
        return done.returncode, done.stdout

    def _run(self, command: list[str]) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            command,
            cwd=self.folder,
            env=self._env,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=600,
            check=False,
        )


@pytest.fixture
def shots(tmp_path: Path) -> Repository:
    """A repository of stages that uses the hooks of this checkout, committed or not."""
    home = tmp_path / "home"
    ignored = shutil.ignore_patterns(*LEFT_OUT, ".*_cache")
    shutil.copytree(ROOT, tmp_path / "tool", ignore=ignored)
    tool = Repository(tmp_path / "tool", home)
    tool.git("add", "--all")
    tool.git("commit", "--quiet", "--message", "the tool")
    shots = Repository(tmp_path / "shots", home)
    hooks = HOOKS.format(repository=tool.folder.as_posix(), revision=tool.git("rev-parse", "HEAD"))
    (shots.folder / ".pre-commit-config.yaml").write_text(hooks, encoding="utf-8")
    return shots


def write_stage(repository: Repository, name: str, file: str) -> None:
    """A stage with a volume of that file: text, a crate or a package, as the name says."""
    path = repository.folder / name
    text = path if path.suffix == ".usda" else repository.folder / "source.usda"
    text.write_text(STAGE.replace("FILE", file), encoding="utf-8", newline="\n")
    if path.suffix == ".usdc":
        assert Sdf.Layer.FindOrOpen(str(text)).Export(str(path))
    elif path.suffix == ".usdz":
        with Sdf.ZipFileWriter.CreateNew(str(path)) as package:
            package.AddFile(str(text), "smoke.usda")
            if file == "cloud":
                package.AddFile(str(repository.folder / "cloud.vdb"), "cloud.vdb")
    if text != path:
        text.unlink()


def test_hooks(shots: Repository) -> None:
    """One story, because an environment is costly to set up."""
    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", shots.folder)
    for suffix in (".usda", ".usdc", ".usdz"):
        write_stage(shots, f"clean{suffix}", "cloud")
        write_stage(shots, f"broken_{suffix[1:]}{suffix}", "gone")
    (shots.folder / "notes.txt").write_text("no stage\n")

    code, said = shots.pre_commit()
    assert code == 1, said
    assert "- exit code: 1" in said
    for name in ("broken_usda.usda", "broken_usdc.usdc", "broken_usdz.usdz"):
        assert f"{name}\n  /smoke/density\n    AST002 error: no file at './gone.vdb'" in said
    assert "clean." not in said

    for suffix in (".usda", ".usdc", ".usdz"):
        write_stage(shots, f"broken_{suffix[1:]}{suffix}", "cloud")
    code, said = shots.pre_commit()
    assert code == 0, said
    assert said.splitlines()[-1].endswith("Passed")
    assert len(said.splitlines()) == 1
    shots.git("commit", "--quiet", "--message", "stages")

    (shots.folder / "notes.txt").write_text("still no stage\n")
    code, said = shots.pre_commit()
    assert code == 0
    assert said.rstrip().endswith("(no files to check)Skipped")

    # No stage is in this commit, and all but the packages are broken by it.
    (shots.folder / "cloud.vdb").unlink()
    code, said = shots.pre_commit()
    assert code == 0
    code, said = shots.pre_commit("--hook-stage", "manual", "usdvol-lint-all")
    assert code == 1, said
    assert said.count("AST002 error: no file at './cloud.vdb'") == 4
    shots.git("checkout", "HEAD", "--", "cloud.vdb")
    code, said = shots.pre_commit("--hook-stage", "manual", "usdvol-lint-all")
    assert (code, len(said.splitlines())) == (0, 1), said

    commands_that_are_split(shots)


def commands_that_are_split(shots: Repository) -> None:
    """A command with so many files is several: all are checked, and the worst exit code counts."""
    folder = shots.folder.joinpath(*LONG)
    folder.mkdir(parents=True, exist_ok=True)
    tail = "x" * 100
    for number in range(MANY):
        (folder / f"{number:03}{tail}.usda").write_text('#usda 1.0\ndef Xform "x"\n{\n}\n')
    write_stage(shots, (folder / f"000{tail}.usda").relative_to(shots.folder).as_posix(), "gone")
    code, said = shots.pre_commit("--hook-stage", "manual", "telling")
    verdicts = re.findall(r" in (?:\d+ of )?(\d+) stages; ", said)
    assert len(verdicts) > 1
    assert sum(map(int, verdicts)) == MANY
    assert "- exit code: 1" in said
    assert said.count("AST002 error: no file at './gone.vdb'") == 1

    (folder / f"{MANY - 1:03}{tail}.usda").write_text("#usda 1.0\ndef")
    code, said = shots.pre_commit()
    assert code == 1
    assert "- exit code: 2" in said
    assert said.count(" AST002 error: ") == said.count(" LNT001 error: ") == 1
