"""In a stranger's checkout nothing of theirs is run, whoever calls us there."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from process import ROOT, environment, write

MODULES = ("click", "numpy", "rich", "pathspec", "gc", "sitecustomize", "usercustomize", "mypack")
MARK = "import os\nos.write(2, b'{name} ran\\n')\n"
BROKEN = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./gone.vdb@\n}\n'
ONLY = ("--quiet", "--select", "AST002", "--output-format", "concise", ".")
FOUND = "a.usda:4:22: AST002 error </a.filePath> no file at './gone.vdb'\n"
COMMAND = "import sys\nfrom usdvol_lint.__main__ import main\nsys.exit(main())\n"
"""What an installer writes as `usdvol-lint`, and a hook of pre-commit calls."""
EXPORTER = """\
import usdvol_lint
try:
    usdvol_lint.assert_clean("a.usda", select="AST002")
except AssertionError as error:
    print(str(error).splitlines()[0])
"""


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A stage among all that Python, USD and git might take for theirs."""
    folder = write(tmp_path / "checkout", a=BROKEN)
    for name in MODULES:
        (folder / f"{name}.py").write_text(MARK.format(name=name), encoding="utf-8")
    for name in ("pxr", "usdvol_lint", "usdvol_lint.packs", "rules"):
        write(folder / name)
        (folder / name / "__init__.py").write_text(MARK.format(name=name), encoding="utf-8")
    info = write(folder / "mypack-1.0.dist-info")
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: mypack\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[usdvol_lint.packs]\nmypack = rules\n")
    (folder / "plugInfo.json").write_text('{"Plugins": [{"Type": "python", "Name": "mypack"}]}')
    (folder / "usdvol-lint.toml").write_text("show = ['info']\n", encoding="utf-8")
    return folder


def call(arguments: Sequence[str | Path], folder: Path) -> tuple[int, str, str]:
    done = subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=folder,
        env=environment(PYTHONPATH=str(ROOT)),
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


def test_the_command_runs_nothing_of_theirs(checkout: Path, tmp_path: Path) -> None:
    program = tmp_path / "usdvol-lint"
    program.write_text(COMMAND, encoding="utf-8")
    assert call([program, *ONLY], checkout) == (1, FOUND, "")
    assert call(["-P", "-m", "usdvol_lint", *ONLY], checkout) == (1, FOUND, "")


def test_the_module_runs_nothing_of_theirs_but_what_python_itself_does(checkout: Path) -> None:
    """Python looks for `usdvol_lint` and its own modules there before any line of ours is run."""
    (checkout / "usdvol_lint").rename(checkout / "other")
    assert call(["-m", "usdvol_lint", *ONLY], checkout) == (1, FOUND, "")


def test_a_test_of_an_exporter_runs_nothing_of_theirs(checkout: Path, tmp_path: Path) -> None:
    program = tmp_path / "exporter.py"
    program.write_text(EXPORTER, encoding="utf-8")
    code, out, err = call([program], checkout)
    assert (code, out.partition(";")[0], err) == (0, "1 error in 1 stage", "")


def test_a_pack_of_theirs_is_not_installed(checkout: Path, tmp_path: Path) -> None:
    """Though the folder looks like a place where packages are."""
    (checkout / "usdvol-lint.toml").write_text("packs = ['mypack']\n", encoding="utf-8")
    code, out, err = call(["-P", "-m", "usdvol_lint", *ONLY], checkout)
    assert (code, out) == (2, "")
    assert "packs: 'mypack' is no installed pack" in err


@pytest.mark.skipif(os.name != "posix", reason="needs programs with #!")
def test_git_is_that_of_the_path(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not one that lies in the working directory, nor one that the repository has run."""
    from usdvol_lint.files.changes import changes_since
    from usdvol_lint.model import UsageError

    for name in ("git", "monitor"):
        (checkout / name).write_text("#!/bin/sh\ntouch ran\n", encoding="utf-8")
        (checkout / name).chmod(0o755)
    monkeypatch.chdir(checkout)
    for name in [name for name in os.environ if name.startswith("GIT_")]:
        monkeypatch.delenv(name)
    path = os.environ["PATH"]
    monkeypatch.setenv("PATH", os.pathsep.join((".", "", path)))
    who = ("-c", "user.name=a", "-c", "user.email=b")
    for arguments in (("init", "-q"), ("commit", "-q", "--allow-empty", "-m", "x")):
        subprocess.run(["git", *who, *arguments], env={**os.environ, "PATH": path}, check=True)
    monitor = ("config", "core.fsmonitor", str(checkout / "monitor"))
    subprocess.run(["git", *monitor], env={**os.environ, "PATH": path}, check=True)
    assert changes_since("HEAD", ["a.usda"], ()).paths
    monkeypatch.setenv("PATH", ".")
    with pytest.raises(UsageError, match="git, which is not installed"):
        changes_since("HEAD", ["a.usda"], ())
    assert not (checkout / "ran").exists()
