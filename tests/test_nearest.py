"""Which names are one slip of the hand away from each other, and which of many is closest."""

from __future__ import annotations

from difflib import get_close_matches
from random import Random

import pytest

from usdvol_lint.nearest import are_swapped, closest_match, is_one_slip_from


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


@pytest.mark.parametrize("cutoff", [0.6, 0.84])
def test_the_closest_is_that_of_difflib(cutoff: float) -> None:
    random = Random(3)
    for _ in range(300):
        word, *known = ("".join(random.choices("abc1", k=random.randint(0, 8))) for _ in range(12))
        closest = get_close_matches(word, dict.fromkeys(known), n=1, cutoff=cutoff)
        assert closest_match(word, known, cutoff) == (closest[0] if closest else None)


def test_of_very_many_names_the_close_ones_are_compared() -> None:
    """Those that begin or end alike; and no name is so long that to compare it never ends."""
    stem = "explosion_density_smoke_" * 5
    many = [f"{stem}{number:06d}" for number in range(20_000)]
    others = [f"{number}_{stem}"[::-1] for number in range(20_000)]
    assert closest_match(f"{stem}O12345", [*others, *many]) in many
    assert closest_match(f"{stem}", others) is None
    assert closest_match("n" * 100_000, ["n" * 100_001]) is None


@pytest.mark.parametrize(
    ("word", "other", "wanted"),
    [
        ("smoke", "smoek", True),
        ("smoke", "msoke", True),
        ("smoke", "smoke", False),
        ("smoke", "smeko", False),
        ("smoke", "smokes", False),
        ("smoke", "smoka", False),
    ],
)
def test_swapped_letters(word: str, other: str, wanted: bool) -> None:
    assert are_swapped(word, other) is wanted
    assert are_swapped(other, word) is wanted
