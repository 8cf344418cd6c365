"""What changed since a revision, as git itself says."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path

import pytest
from process import run

from usdvol_lint.files.changes import changes_since
from usdvol_lint.model import UsageError

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="needs git")

STAGE = '#usda 1.0\n(\n    upAxis = "Y"\n    metersPerUnit = 1\n%s)\ndef Xform "x"\n{\n%s}\n'
FIELD = '    def OpenVDBAsset "d"\n    {\n        asset filePath = @./%s@\n    }\n'


def git(folder: Path, *arguments: str) -> str:
    who = {f"GIT_{who}_{what}": "a@b.c" for who in ("AUTHOR", "COMMITTER")
           for what in ("NAME", "EMAIL")}  # fmt: skip
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    environment = {**kept, **who, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
    command = ["git", "-C", str(folder), *arguments]
    done = subprocess.run(command, env=environment, capture_output=True, check=True)
    return done.stdout.decode().strip()


@pytest.fixture(autouse=True)
def _no_other_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever runs the tests may be a git hook."""
    for name in [name for name in os.environ if name.startswith("GIT_")]:
        monkeypatch.delenv(name)


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A stage for each way to use a file, on a branch `topic` beside `main`."""
    folder = tmp_path / "repository"
    folder.mkdir()
    texts = {
        "alone": STAGE % ("", ""),
        "sub": STAGE % ("", ""),
        "shot": STAGE % ("    subLayers = [@./sub.usda@]\n", ""),
        "fog": STAGE % ("", FIELD % "fog.1.vdb"),
    }
    for name, text in texts.items():
        (folder / f"{name}.usda").write_text(text, encoding="utf-8")
    (folder / "fog.1.vdb").write_text("fog")
    (folder / ".gitignore").write_text("ignored*\n")
    git(folder, "init", "--quiet", "--initial-branch", "main")
    git(folder, "add", "--all")
    git(folder, "commit", "--quiet", "--message", "one")
    git(folder, "checkout", "--quiet", "-b", "topic")
    return folder


def changed(folder: Path, revision: str = "main", settings: Iterable[str] = ()) -> set[str]:
    found = changes_since(revision, [str(folder)], settings)
    real = Path(os.path.realpath(folder)).as_posix()
    return {path.removeprefix(f"{real}/") for path in found.paths if path.startswith(real)}


def test_all_that_differs_from_the_merge_base(repository: Path) -> None:
    assert changed(repository) == set()
    (repository / "committed").touch()
    git(repository, "add", "--all")
    git(repository, "commit", "--quiet", "--message", "two")
    git(repository, "checkout", "--quiet", "main")
    (repository / "of main").touch()
    git(repository, "add", "--all")
    git(repository, "commit", "--quiet", "--message", "three")
    git(repository, "checkout", "--quiet", "topic")
    (repository / "staged").touch()
    git(repository, "add", "staged")
    (repository / "staged").unlink()
    (repository / "alone.usda").unlink()
    (repository / "sub.usda").write_text("changed")
    (repository / "a b\n\u00e9.usda").touch()
    (repository / "ignored.usda").touch()
    expected = {"committed", "staged", "alone.usda", "sub.usda", "a b\n\u00e9.usda"}
    assert changed(repository) == expected
    inside = repository / "inside"
    inside.mkdir()
    assert changes_since("main", [str(inside)], []) == changes_since("main", [str(repository)], [])


def test_all_that_differs_in_submodules(
    repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each file, in submodules of submodules too, whatever git is told to ignore there."""
    for name, inner in (("deep", ()), ("lib", ("deep",))):
        own = tmp_path / name
        own.mkdir()
        git(own, "init", "--quiet")
        for file in ("kept", "gone"):
            (own / file).write_text(name)
        _add_submodules(own, *inner)
    _add_submodules(repository, "lib")
    git(repository, "config", "diff.ignoreSubmodules", "all")
    assert changed(repository, "HEAD") == set()
    lib = repository / "lib"
    (lib / "deep" / "new").touch()
    assert changed(repository, "HEAD") == {"lib/deep/new"}
    (lib / "gone").unlink()
    git(lib, "commit", "--quiet", "--all", "--message", "two")
    git(repository, "add", "--force", "lib")
    git(repository, "-c", "diff.ignoreSubmodules=none", "commit", "--quiet", "--message", "bump")
    # As for a hook.
    monkeypatch.setenv("GIT_DIR", str(repository / ".git"))
    monkeypatch.setenv("GIT_INDEX_FILE", str(repository / ".git" / "index"))
    assert changed(repository, "HEAD~1") == {"lib/gone", "lib/deep/new"}
    monkeypatch.undo()
    git(repository, "checkout", "--quiet", "HEAD~1", "--", "lib")
    git(lib, "reset", "--quiet", "--hard", "HEAD~1")
    git(repository, "add", "--force", "lib")
    (lib / "deep" / "new").unlink()
    assert changed(repository, "HEAD~1") == set()
    shutil.rmtree(lib)
    assert changed(repository, "HEAD") == {"lib"}
    lib.mkdir()  # as in a clone without its submodules
    assert changed(repository, "HEAD~1") == set()
    git(repository, "reset", "--quiet", "--hard", "HEAD")
    assert changed(repository, "HEAD~1") == {"lib"}


def _add_submodules(folder: Path, *names: str) -> None:
    for name in names:
        url = str(folder.parent / name)
        local = ("-c", "protocol.file.allow=always")
        git(folder, *local, "submodule", "--quiet", "add", url, name)
        git(folder, *local, "submodule", "--quiet", "update", "--init", "--recursive")
        git(folder, "config", "--file", ".gitmodules", f"submodule.{name}.ignore", "all")
    git(folder, "add", "--all")
    git(folder, "commit", "--quiet", "--message", "submodules")


@pytest.mark.parametrize("revision", ["nope", "sub.usda", "main..topic", "HEAD~7"])
def test_a_revision_that_is_none(revision: str, repository: Path) -> None:
    (repository / "sub.usda").write_text("changed")
    with pytest.raises(UsageError, match=r"git finds no revision '.*'; .* 'fetch-depth: 0'"):
        changed(repository, revision)


@pytest.mark.parametrize("revision", ["", "-p", "--output=x", "main\nx"])
def test_what_could_be_an_option_is_none(revision: str, repository: Path) -> None:
    before = sorted(os.listdir(repository))
    with pytest.raises(UsageError, match="is no revision"):
        changed(repository, revision)
    assert sorted(os.listdir(repository)) == before


def test_a_revision_that_is_a_files_name_too(repository: Path) -> None:
    git(repository, "branch", "sub.usda")
    (repository / "sub.usda").write_text("changed")
    assert changed(repository, "sub.usda") == {"sub.usda"}


def test_a_clone_without_the_history(repository: Path, tmp_path: Path) -> None:
    """Neither a branch that was not fetched, nor one whose common commit is cut off."""
    git(repository, "commit", "--quiet", "--allow-empty", "--message", "two")
    git(repository, "checkout", "--quiet", "main")
    git(repository, "commit", "--quiet", "--allow-empty", "--message", "three")
    url = repository.as_uri()
    git(tmp_path, "clone", "--quiet", "--depth", "1", "--branch", "topic", url, "shallow")
    shallow = tmp_path / "shallow"
    with pytest.raises(UsageError, match=r"no revision 'origin/main'; .*'fetch-depth: 0'"):
        changed(shallow, "origin/main")
    git(shallow, "fetch", "--quiet", "--depth", "1", "origin", "main:other")
    with pytest.raises(UsageError, match=r"'other' and HEAD have in common; .*'fetch-depth: 0'"):
        changed(shallow, "other")


def test_no_repository(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"since: '.*' lies in no git repository"):
        changed(tmp_path)


def test_arguments_that_no_repository_holds(repository: Path, tmp_path: Path) -> None:
    """The one that is outside is named, or two that are apart."""

    def said(*names: str) -> str:
        with pytest.raises(UsageError) as caught:
            changes_since("main", [str(tmp_path / name) for name in names], [])
        return str(caught.value).replace(f"{tmp_path}{os.sep}", "")

    outside = "--changed-since: 'out' lies in no git repository"
    assert said("repository", "repository/sub.usda", "out") == outside
    other = tmp_path / "other"
    other.mkdir()
    git(other, "init", "--quiet")
    apart = "'repository' and 'other' lie in two git repositories: check each in a run of its own"
    assert said("repository", "other", "out") == f"--changed-since: {apart}"


def test_settings_concern_every_stage(repository: Path) -> None:
    def concerns(*paths: str) -> bool:
        named = [str(repository / path) for path in paths]
        return changes_since("main", [str(repository)], named).everything

    (repository / "pack").mkdir()
    (repository / "pack" / "rule.py").touch()
    assert not concerns("sub.usda", "usdvol-lint.toml")
    assert concerns("pack")
    assert concerns("pack/rule.py")


def test_stages_that_use_what_changed(repository: Path) -> None:
    chosen = ("--isolated", "--select", "STG003", "--changed-since", "main")

    def checked() -> set[str]:
        ran = run(*chosen, "--output-format", "json", ".", cwd=repository)
        assert (ran.code, ran.err) == (0, "")
        return {stage["path"] for stage in ran.json["stages"]}

    ran = run(*chosen, ".", cwd=repository)
    assert (ran.code, ran.out, ran.err) == (
        0,
        "nothing to check: nothing changed since 'main'\n",
        "",
    )
    (repository / "notes.txt").touch()
    ran = run(*chosen, ".", cwd=repository)
    said = "nothing to check: none of 4 stages uses a file that changed since 'main'\n"
    assert (ran.code, ran.out, ran.err) == (0, said, "")
    ran = run(*chosen, "sub.usda", cwd=repository)
    said = "nothing to check: the stage uses no file that changed since 'main'\n"
    assert (ran.code, ran.out, ran.err) == (0, said, "")
    (repository / "sub.usda").write_text(STAGE % ("", "    # more\n"), encoding="utf-8")
    assert checked() == {"shot.usda", "sub.usda"}
    git(repository, "checkout", "--quiet", "sub.usda")
    (repository / "fog.1.vdb").unlink()
    assert checked() == {"fog.usda"}
    (repository / "usdvol-lint.toml").touch()
    ran = run("--select", "STG003", "--changed-since", "main", ".", cwd=repository)
    assert "no findings in 4 stages; " in ran.out


def test_every_file_that_settings_come_from(repository: Path) -> None:
    """What is extended, what is no longer there, and what has no table any more."""
    (repository / "studio").mkdir()
    (repository / "inside").mkdir()
    texts = {
        "usdvol-lint.toml": "extend = 'studio/base.toml'\n",
        "studio/base.toml": "extend = 'more.toml'\n",
        "studio/more.toml": "",
        "inside/usdvol-lint.toml": "",
        "pyproject.toml": "",
    }
    for name, text in texts.items():
        (repository / name).write_text(text, encoding="utf-8")
    git(repository, "add", "--all")
    git(repository, "commit", "--quiet", "--message", "two")

    def is_every_stage(*options: str, folder: str = ".") -> bool:
        options = ("--changed-since", "HEAD", "--show-files", *options)
        ran = run(*options, str(repository), cwd=repository / folder)
        assert ran.code == 0
        assert bool(ran.out) != ("nothing changed" in ran.err)
        return not ran.err

    assert not is_every_stage()
    (repository / "pyproject.toml").write_text("# more\n", encoding="utf-8")
    (repository / "notes.txt").touch()
    assert not is_every_stage()
    (repository / "usdvol-lint.toml").unlink()
    assert is_every_stage()
    assert not is_every_stage(folder="inside")
    assert not is_every_stage("--isolated")
    git(repository, "checkout", "--quiet", "usdvol-lint.toml")
    (repository / "studio" / "more.toml").write_text("jobs = 1\n", encoding="utf-8")
    assert is_every_stage()
    git(repository, "checkout", "--quiet", ".")
    (repository / "inside" / "usdvol-lint.toml").unlink()
    assert is_every_stage(folder="inside")
    assert not is_every_stage()
