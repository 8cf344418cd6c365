"""Links, pipes, permissions and odd names: what leads to no stage is told in a line."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import pytest
from badinput import GOOD, POSIX, STUDIO_ONLY, statuses, troubles
from process import run, volume, write

from usdvol_lint.engine.engine import Engine
from usdvol_lint.files.listing import list_stages
from usdvol_lint.paths import display


@pytest.mark.skipif(not POSIX, reason="needs symbolic links")
def test_links(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"))
    (tmp_path / "broken.usda").symlink_to("gone.usda")
    (tmp_path / "loop.usda").symlink_to("loop.usda")
    (tmp_path / "round").mkdir()
    (tmp_path / "round" / "trip").symlink_to(tmp_path, target_is_directory=True)
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    said = troubles(ran)
    assert said.pop("loop.usda")[0].startswith("can't be read: ")
    assert said == {
        "fog.usda": (GOOD, 2, 1, None),
        "broken.usda": (
            "a symbolic link to 'gone.usda', which does not exist",
            None,
            None,
            "restore that file, or remove the link",
        ),
    }


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_pipes(tmp_path: Path) -> None:
    """USD waits for a writer for ever."""
    write(
        tmp_path,
        fog=volume("fog"),
        hangs="#usda 1.0\n(\n    subLayers = [@./pipe.usda@]\n)\n",
        zzz=volume("fog"),
    )
    os.mkfifo(tmp_path / "pipe.usda")
    ran = run(*STUDIO_ONLY, "--timeout", "1.5", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert statuses(ran) == {
        "fog.usda": "checked",
        "hangs.usda": "timed_out",
        "pipe.usda": "unreadable",
        "zzz.usda": "checked",
    }
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "hangs.usda": (
            "stopped after 1.5 s, the limit for one stage",
            None,
            None,
            "a large stage or a slow disk needs more: raise --timeout, or look at less with "
            "--content first --times ends; a pipe or a corrupt layer never ends",
        ),
        "pipe.usda": ("not a regular file (a pipe, socket or device)", None, None, "name a file"),
        "zzz.usda": (GOOD, 2, 1, None),
    }


def test_no_permission(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"), secret=volume("fog"))
    write(tmp_path / "closed", fog=volume("fog"))
    (tmp_path / "secret.usda").chmod(0)
    (tmp_path / "closed").chmod(0)
    if os.access(tmp_path / "secret.usda", os.R_OK):
        pytest.skip("nothing is forbidden here")
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    (tmp_path / "closed").chmod(0o700)
    denied = ("can't be read: Permission denied", None, None, None)
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "secret.usda": denied,
        "closed": denied,
    }


def test_a_folder_that_can_not_be_listed_is_not_passed_over(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, engine: Engine
) -> None:
    """The same for everybody, root too."""
    write(tmp_path / "closed")
    write(tmp_path / "open", fog=volume("fog"))
    monkeypatch.chdir(tmp_path)

    def deny(true: Any) -> Any:
        def call(folder: Any) -> Any:
            if str(folder).endswith("closed"):
                raise PermissionError(13, "Permission denied", folder)
            return true(folder)

        return call

    monkeypatch.setattr(os, "scandir", deny(os.scandir))
    monkeypatch.setattr(os, "listdir", deny(os.listdir))
    found = [stage.path for stage in list_stages(["."]).stages]
    assert [display(path) for path in found] == ["closed", "open/fog.usda"]
    (finding,) = engine.lint(found[0]).findings
    assert (finding.code, finding.message) == ("LNT001", "can't be read: Permission denied")


def test_names_with_brackets(tmp_path: Path) -> None:
    """They are how USD names layers inside packages, and legal in file names all the same."""
    write(tmp_path / "[1]", **{"[2]": volume("fog"), "a[3]b": volume("fog")})
    ran = run(*STUDIO_ONLY, "--root", tmp_path, tmp_path, cwd=tmp_path)
    assert set(troubles(ran)) == {f"{tmp_path}/[1]/[2].usda", f"{tmp_path}/[1]/a[3]b.usda"}
    layers = [cause["source"]["layer"] for cause in ran.json["causes"]]
    assert layers == ["[1]/[2].usda", "[1]/a[3]b.usda"]


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere file names are Unicode")
def test_names_that_are_no_text(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"))
    (tmp_path / os.fsdecode(b"\xff.usda")).write_text(volume("fog"))
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    said = "USD opens no file whose path is not UTF-8"
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "\udcff.usda": (said, None, None, "rename the file or folder"),
    }
