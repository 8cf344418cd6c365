"""A file is replaced as a whole or not at all, and what lies beside it leads nowhere."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from usdvol_lint.replacing import replacing


def put(file: Path, text: str) -> None:
    with replacing(file) as stream:
        stream.write(text.encode("utf-8"))


def interrupted(file: Path) -> None:
    with replacing(file) as stream:
        stream.write(b"two")
        raise KeyboardInterrupt


def test_what_was_planted_is_not_written_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Links, also to what is not there, and a file, where the temporary one is to be."""
    monkeypatch.setattr(os, "urandom", lambda number: bytes(number))
    target, secret = tmp_path / "report.json", tmp_path / "secret"
    secret.write_text("secret", encoding="utf-8")
    put(target, "one")
    assert sorted(tmp_path.iterdir()) == [target, secret]
    planted = tmp_path / f".usdvol-lint-{'0' * 16}.tmp"
    plantings = [lambda: planted.write_text("planted", encoding="utf-8")]
    if os.name == "posix":  # elsewhere a link needs a privilege
        plantings += [lambda: planted.symlink_to(secret), lambda: planted.symlink_to("new")]
    for plant in plantings:
        plant()
        with pytest.raises(FileExistsError):
            put(target, "two")
        assert (target.read_text("utf-8"), secret.read_text("utf-8")) == ("one", "secret")
        assert not (tmp_path / "new").exists()
        planted.unlink()


def test_nobody_can_foresee_the_name(tmp_path: Path) -> None:
    names = set()
    for _ in range(2):
        with replacing(tmp_path / "report.json"):
            names |= {path.name for path in tmp_path.iterdir()} - {"report.json"}
    assert len(names) == 2


def test_a_failure_leaves_what_was_there(tmp_path: Path) -> None:
    put(tmp_path / "a", "one")
    with pytest.raises(KeyboardInterrupt):
        interrupted(tmp_path / "a")
    assert [path.read_text("utf-8") for path in tmp_path.iterdir()] == ["one"]


@pytest.mark.skipif(os.name != "posix", reason="needs the modes of POSIX")
def test_who_may_read_it_stays_as_it_was(tmp_path: Path) -> None:
    put(tmp_path / "a", "one")
    (tmp_path / "a").chmod(0o600)
    put(tmp_path / "a", "two")
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o600
