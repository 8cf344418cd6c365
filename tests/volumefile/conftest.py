"""What tests of the readers share: a file of any bytes."""

from __future__ import annotations

from pathlib import Path

import pytest
from attempts import Reader

from usdvol_lint.volumefile import VolumeFile, read_volume_file


@pytest.fixture
def read(tmp_path: Path) -> Reader:
    """Reads a file of the given bytes, whose name says nothing."""
    path = tmp_path / "file"

    def read_bytes(content: bytes) -> VolumeFile:
        path.write_bytes(content)
        return read_volume_file(str(path))

    return read_bytes
