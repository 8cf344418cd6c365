"""What tests of the command share: the command in this process, and a folder with two stages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from process import Ran, volume, write

from usdvol_lint.command import cli


@pytest.fixture
def tool(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Callable[..., Ran]:
    """The command in this process, in a temporary folder: for all that starts no other process."""
    monkeypatch.chdir(tmp_path)
    for name in ("NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)

    def call(*arguments: str | Path) -> Ran:
        code = cli.main([str(argument) for argument in arguments])
        ran = Ran(code, *capfd.readouterr())
        assert "Traceback" not in ran.err
        return ran

    return call


@pytest.fixture
def two(tmp_path: Path) -> Path:
    return write(tmp_path, fog=volume("fog"), smoke=volume("smoke"))
