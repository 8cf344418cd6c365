"""The folder that layers go by: the first of those that may say it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from usdvol_lint.model import UsageError
from usdvol_lint.paths import canonical
from usdvol_lint.run.roots import repository_of, root_of

NAMES = ("given", "of_baseline", "configured", "config_folder")


def folders(tmp_path: Path, *names: str) -> dict[str, str]:
    for name in names:
        (tmp_path / name).mkdir(parents=True, exist_ok=True)
    return {name: str(tmp_path / name) for name in names}


def test_roots_in_their_order(tmp_path: Path) -> None:
    (tmp_path / "repository" / ".git").mkdir(parents=True)
    stage = str(tmp_path / "repository" / "a.usda")
    said = folders(tmp_path, *NAMES)
    for name in ("given", "of_baseline", "configured", "repository", "config_folder"):
        assert root_of([stage], **said) == canonical(str(tmp_path / name))
        if name == "repository":
            (tmp_path / "repository" / ".git").rmdir()
        else:
            del said[name]
    assert root_of([stage]) is None


@pytest.mark.parametrize("name", ["given", "of_baseline", "configured"])
def test_a_root_that_is_no_folder(name: str, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    for wrong in ("gone", "file"):
        said = f"the root {str(tmp_path / wrong)!r} is no folder"
        with pytest.raises(UsageError, match=f"^{re.escape(said)}$"):
            root_of([], **{name: str(tmp_path / wrong)})


def test_a_root_is_named_as_layers_are(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to("real")
    expected = canonical(str(tmp_path / "real"))
    assert root_of([], "link") == root_of([], "real/.") == expected
    assert root_of([], config_folder="link") == expected


@pytest.mark.parametrize("marker", [".git", ".hg", ".svn", ".jj"])
@pytest.mark.parametrize(
    ("paths", "found"),
    [
        (["outer/inner/a.usda"], "outer/inner"),
        (["outer/inner"], "outer/inner"),
        (["outer/inner/a.usda", "outer/inner/deep/b.usda"], "outer/inner"),
        (["outer/inner/a.usda", "outer/b.usda"], "outer"),
        (["outer/inner/a.usda", "elsewhere.usda"], None),
        (["elsewhere.usda"], None),
        (["link/a.usda"], "outer/inner"),
        ([], None),
    ],
)
def test_the_innermost_repository_that_holds_all(
    paths: list[str], found: str | None, marker: str, tmp_path: Path
) -> None:
    folders(tmp_path, f"outer/{marker}", f"outer/inner/{marker}", "outer/inner/deep")
    (tmp_path / "link").symlink_to(tmp_path / "outer" / "inner" / "deep")
    repository = repository_of(str(tmp_path / path) for path in paths)
    # The temporary folder may lie in a repository itself.
    if found is None:
        assert repository is None or not Path(repository).is_relative_to(tmp_path.resolve())
    else:
        assert repository == str((tmp_path / found).resolve())


def test_a_worktree_of_git_is_a_repository(tmp_path: Path) -> None:
    """Its `.git` is a file."""
    (tmp_path / ".git").touch()
    assert repository_of([str(tmp_path / "a.usda")]) == str(tmp_path.resolve())
