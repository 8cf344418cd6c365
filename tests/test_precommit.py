"""The hooks do their work in a real repository, through a real pre-commit."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from process import ROOT

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
"""
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
    text = STAGE.replace("FILE", file)
    (repository.folder / name).write_text(text, encoding="utf-8", newline="\n")


def test_hooks(shots: Repository) -> None:
    """One story, because an environment is costly to set up."""
    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", shots.folder)
    write_stage(shots, "clean.usda", "cloud")
    write_stage(shots, "broken.usda", "gone")
    (shots.folder / "notes.txt").write_text("no stage\n")

    code, said = shots.pre_commit()
    assert code == 1, said
    assert "- exit code: 1" in said
    assert "broken.usda\n  /smoke/density\n    AST002 error: no file at './gone.vdb'\n" in said
    assert "clean.usda" not in said

    write_stage(shots, "broken.usda", "cloud")
    code, said = shots.pre_commit()
    assert code == 0, said
    assert said.splitlines()[-1].endswith("Passed")
    assert len(said.splitlines()) == 1
    shots.git("commit", "--quiet", "--message", "stages")

    (shots.folder / "notes.txt").write_text("still no stage\n")
    code, said = shots.pre_commit()
    assert code == 0
    assert said.rstrip().endswith("(no files to check)Skipped")

    # No stage is in this commit, and both are broken by it.
    (shots.folder / "cloud.vdb").unlink()
    code, said = shots.pre_commit()
    assert code == 0
    code, said = shots.pre_commit("--hook-stage", "manual", "usdvol-lint-all")
    assert code == 1, said
    assert said.count("AST002 error: no file at './cloud.vdb'") == 2
