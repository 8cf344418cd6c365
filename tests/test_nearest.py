"""Which names are one slip of the hand away from each other."""

from __future__ import annotations

import pytest

from usdvol_lint.nearest import is_one_slip_from


@pytest.mark.parametrize(
    ("word", "other", "wanted"),
    [
        ("fx", "FX", True),
        ("smoke", "smoke", False),
        ("smoke", "smke", True),
        ("smoke", "smokke", True),
        ("smoke", "smole", True),
        ("smoke", "smoek", True),
        ("smoke", "smokes", True),
        ("Worlds", "orlds", True),
        ("smoke", "smuek", False),
        ("smoke", "steam", False),
        ("fog", "fig", False),
        ("fog", "frog", False),
        ("smoke1", "smoke2", False),
        ("smoke", "smoke2", False),
        ("smo1ke", "smoke", False),
        ("arm_L", "arm_R", False),
        ("lArm", "rArm", False),
        ("smoke", "smokeB", False),
        ("smoke", "smoke_", False),
    ],
)
def test_one_slip(word: str, other: str, wanted: bool) -> None:
    assert is_one_slip_from(word, other) is wanted
    assert is_one_slip_from(other, word) is wanted
