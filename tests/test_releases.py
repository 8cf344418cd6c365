"""Numbers of releases: which one is later, and what `required-version` may say."""

from __future__ import annotations

import pytest

from usdvol_lint.releases import is_later, is_wanted, numbers_of


@pytest.mark.parametrize(
    ("release", "other"),
    [("0.2", "0.1"), ("0.10", "0.9"), ("1.0", "0.9.9"), ("0.1.1", "0.1"), ("0.1.0.1", "0.1")],
)
def test_which_is_later(release: str, other: str) -> None:
    assert is_later(release, other)
    assert not is_later(other, release)


@pytest.mark.parametrize(
    ("release", "other"), [("0.1", "0.1"), ("0.1.0", "0.1"), ("0.1", "0.1.0"), ("0", "0.0.0")]
)
def test_zeros_at_the_end_say_nothing(release: str, other: str) -> None:
    assert not is_later(release, other)
    assert numbers_of(release) == numbers_of(other)


@pytest.mark.parametrize(
    ("wanted", "releases", "others"),
    [
        ("0.1", ["0.1", "0.1.0", "0.1.7"], ["0.2.0", "0.10.0", "0.0.9", "1.1"]),
        ("0.1.2", ["0.1.2"], ["0.1.1", "0.1.3", "0.1.20", "0.1"]),
        ("0.1.0", ["0.1", "0.1.0"], ["0.1.1"]),
        ("1", ["1", "1.0.0", "1.9"], ["0.1", "10.0"]),
        (">=0.1,<0.2", ["0.1.0", "0.1.9"], ["0.0.9", "0.2.0", "1.0"]),
        (" >= 0.1 , < 0.2 ", ["0.1.5"], ["0.2"]),
        (">0.1", ["0.1.1", "0.2"], ["0.1", "0.1.0"]),
        ("<=0.1", ["0.1.0", "0.0.9"], ["0.1.1"]),
        ("==0.1", ["0.1.0"], ["0.1.1"]),
        (">=0.1,!=0.1.3", ["0.1.2", "0.1.4"], ["0.1.3"]),
        (">=0.2", ["0.2.0rc1", "0.2.0.dev4+g1234567"], ["0.1.9.post1"]),
    ],
)
def test_which_are_wanted(wanted: str, releases: list[str], others: list[str]) -> None:
    assert [release for release in (*releases, *others) if is_wanted(release, wanted)] == releases


NO_NUMBERS = ["x", "", "0.1.", ".1", "v0.1", "0.1rc1", "-1", "²", "٣", "0..1", "1" * 5000]


@pytest.mark.parametrize("text", NO_NUMBERS, ids=range(len(NO_NUMBERS)))
def test_what_is_no_number(text: str) -> None:
    with pytest.raises(ValueError, match="is no number of a release"):
        numbers_of(text)
    for wanted in (text, f">={text}", f">=9,{text}"):
        with pytest.raises(ValueError, match="is no number of a release"):
            is_wanted("0.1.0", wanted)


@pytest.mark.parametrize("wanted", ["=0.1", "~=0.1", "=>0.1", "0.1.*", "0.1,", ">=0.1 <0.2"])
def test_what_wants_nothing(wanted: str) -> None:
    with pytest.raises(ValueError, match="is no number of a release"):
        is_wanted("0.1.0", wanted)
