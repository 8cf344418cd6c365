"""The first run of each kind of fault ends with a report or a clear error."""

from __future__ import annotations

import os
from pathlib import Path
from random import Random

import pytest

from faults.kinds import KINDS
from faults.outcome import ERROR, REPORT


@pytest.mark.skipif(os.name != "posix", reason="processes as POSIX has them")
@pytest.mark.parametrize("name", KINDS)
def test_a_run_with_a_fault(name: str, tmp_path: Path) -> None:
    found = next(KINDS[name](tmp_path, Random(1), 40), None)
    assert found is None or found.kind in (REPORT, ERROR), found
