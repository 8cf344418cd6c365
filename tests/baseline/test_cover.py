"""How much of a cause is covered: as text and back, joined, and what is beyond it."""

from __future__ import annotations

from itertools import accumulate

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from usdvol_lint.baseline.cover import cover_as_json, cover_from_json, exceeds, join
from usdvol_lint.baseline.frames import TOLERANCE, frames_as_text, frames_from_text
from usdvol_lint.model import Cover, Severity
from usdvol_lint.words import frame_ranges

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO

TIMES = st.one_of(
    st.integers(-2000, 2000).map(float),
    st.floats(-1e4, 1e4).map(lambda time: round(time, 3)),
    st.floats(allow_nan=False),
)
RUNS = st.builds(
    lambda start, steps: tuple(accumulate(steps, initial=start)),
    st.floats(-1e4, 1e4),
    st.lists(st.sampled_from([1.0, 2.0, 1 / 24, 1 / 3000, 1 + 0.9e-6]), max_size=40),
)
FRAMES = st.one_of(st.lists(TIMES, max_size=20).map(lambda times: tuple(sorted(set(times)))), RUNS)
COVERS = st.builds(
    Cover,
    level=st.sampled_from(Severity),
    frames=st.none() | FRAMES,
    at_default=st.booleans(),
    share=st.none() | st.floats(0, 1),
    elements=st.none() | st.integers(1, 10**7),
)


@pytest.mark.parametrize(
    ("text", "frames"),
    [
        ("", ()),
        ("3, 7-9", (3, 7, 8, 9)),
        ("0-10x2", (0, 2, 4, 6, 8, 10)),
        ("-2-1", (-2, -1, 0, 1)),
        ("-2 to 1", (-2, -1, 0, 1)),
        ("-4 to 0x2, 1e+30", (-4, -2, 0, 1e30)),
        ("-5--3", (-5, -4, -3)),
        ("0.5-2.5x0.5", (0.5, 1, 1.5, 2, 2.5)),
        ("1e-05, 1e+30", (1e-05, 1e30)),
        ("9,3", (3, 9)),
    ],
)
def test_frames_from_text(text: str, frames: tuple[float, ...]) -> None:
    assert frames_from_text(text) == frames


@pytest.mark.parametrize(
    "text",
    [
        "x",
        "3-",
        "3-1",
        "3 7",
        "1-9x0",
        "1-9x-1",
        "0-1e300",
        "0-9999999x0.001",
        "1,,2",
        "all",
        "inf-inf",
    ],
)
def test_text_that_is_no_frames(text: str) -> None:
    with pytest.raises(ValueError, match="no frames"):
        frames_from_text(text)


@given(FRAMES)
@example(tuple(1001 + i / 24 for i in range(5000)))
@example((0.0, 1.0, *(2 + i * (1 + 0.9e-6) for i in range(1000))))
@example((float("-inf"), 0.0, float("inf")))
def test_frames_are_read_as_they_were_written(frames: tuple[float, ...]) -> None:
    read = frames_from_text(frames_as_text(frames))
    assert len(read) == len(frames)
    assert all(
        one == other or abs(one - other) < TOLERANCE
        for one, other in zip(read, frames, strict=True)
    )


def test_usual_frames_are_the_ranges_of_messages() -> None:
    for frames in ((3.0, 7.0, 8.0, 9.0), tuple(map(float, range(-9, 99, 3))), (1.5,)):
        assert frames_as_text(frames) == frame_ranges(frames)


def test_a_time_that_is_no_number_is_left_out() -> None:
    nan = float("nan")
    assert frames_as_text((nan, 3.0)) == "3"
    assert exceeds(Cover(ERROR, (3.0,)), Cover(ERROR, (nan, 3.0))) is None


@pytest.mark.parametrize(
    ("cover", "expected"),
    [
        (Cover(ERROR), {"frames": "all", "default": False, "share": None, "level": "error"}),
        (
            Cover(WARNING, (3.0, 7.0, 8.0), True, 0.004, 1000),
            {"frames": "3, 7-8", "default": True, "share": "1 %", "level": "warning"},
        ),
        (Cover(INFO, ()), {"frames": "", "default": False, "share": None, "level": "info"}),
    ],
)
def test_a_cover_as_json(cover: Cover, expected: dict[str, object]) -> None:
    assert cover_as_json(cover) == expected


@pytest.mark.parametrize(
    ("bad", "elements", "step"),
    [
        (1, 10**6, "1 particle"),
        (1, 1, "1 particle"),
        (2, 10**6, "0.1 %"),
        (1000, 10**6, "0.1 %"),
        (1001, 10**6, "1 %"),
        (2, 200, "1 %"),
        (2, 20, "10 %"),
        (2, 4, "half"),
        (3, 4, "all"),
        (4, 4, "all"),
    ],
)
def test_steps_of_a_share(bad: int, elements: int, step: str) -> None:
    cover = Cover(ERROR, share=bad / elements, elements=elements)
    assert cover_as_json(cover)["share"] == step


@given(COVERS)
def test_a_cover_is_read_as_it_was_written(cover: Cover) -> None:
    read = cover_from_json(cover_as_json(cover))
    assert cover_as_json(read) | {"frames": ""} == cover_as_json(cover) | {"frames": ""}
    assert exceeds(read, cover) is None
    assert exceeds(cover, read) is None


@given(COVERS, COVERS)
def test_what_covers_both_is_exceeded_by_none(one: Cover, other: Cover) -> None:
    joined = join(one, other)
    assert exceeds(joined, one) is None
    assert exceeds(joined, other) is None
    assert cover_as_json(joined) == cover_as_json(join(other, one))
    assert join(one, one) == one._replace(frames=join(one, one).frames)


@pytest.mark.parametrize(
    ("was", "now", "said"),
    [
        (Cover(ERROR, (3.0,)), Cover(ERROR, (3.0, 7.0, 8.0, 9.0)), "was frame 3, is frames 3, 7-9"),
        (Cover(ERROR, (3.0,)), Cover(ERROR, (7.0,)), "was frame 3, is frame 7"),
        (Cover(ERROR, (3.0, 7.0)), Cover(ERROR, (3.0,)), None),
        (Cover(ERROR, (3.0,)), Cover(ERROR, (3.0 + 9e-7,)), None),
        (Cover(ERROR, (3.0,)), Cover(ERROR, (3.0 + 3e-6,)), "was frame 3, is frame 3.000003"),
        (Cover(ERROR, (3.0,)), Cover(ERROR), "was frame 3, is all frames"),
        (Cover(ERROR), Cover(ERROR, (3.0,)), None),
        (Cover(ERROR, ()), Cover(ERROR, (3.0,)), "was no frame, is frame 3"),
        (
            Cover(ERROR, (), True),
            Cover(ERROR, (3.0,), True),
            "was the default, is the default and frame 3",
        ),
        (
            Cover(ERROR, (3.0,)),
            Cover(ERROR, (3.0,), True),
            "was frame 3, is the default and frame 3",
        ),
        (
            Cover(ERROR, share=0.01, elements=1000),
            Cover(ERROR, share=0.1, elements=1000),
            "was 1 %, is 10 % of the elements",
        ),
        (
            Cover(ERROR, share=0.001, elements=1000),
            Cover(ERROR, share=0.9, elements=1000),
            "was 1 particle, is all of the elements",
        ),
        (Cover(ERROR, share=0.002, elements=1000), Cover(ERROR, share=0.01, elements=1000), None),
        (Cover(ERROR), Cover(ERROR, share=1.0, elements=10), None),
        (Cover(WARNING), Cover(ERROR), "was a warning, is an error"),
        (Cover(INFO), Cover(WARNING), "was an info, is a warning"),
        (Cover(ERROR), Cover(WARNING), None),
        (
            Cover(WARNING, (3.0,)),
            Cover(ERROR, (4.0,)),
            "was frame 3, is frame 4; was a warning, is an error",
        ),
        (
            Cover(ERROR, (0.0,)),
            Cover(ERROR, tuple(float(i * i) for i in range(20))),
            "was frame 0, is frames 0-1, 4, 9, 16, 25, 36, 49, 64, … (20 in all)",
        ),
    ],
)
def test_what_is_worse(was: Cover, now: Cover, said: str | None) -> None:
    assert exceeds(was, now) == said


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (3, "must be an object"),
        ({}, "'level' must be one of info, warning, error, not None"),
        ({"level": 3}, "'level' must be one of info, warning, error, not 3"),
        ({"level": "error"}, "'frames' must be ranges such as '3, 7-9', or 'all', not None"),
        (
            {"level": "error", "frames": "3-"},
            "'frames' must be ranges such as '3, 7-9', or 'all', not '3-'",
        ),
        (
            {"level": "error", "frames": [3]},
            "'frames' must be ranges such as '3, 7-9', or 'all', not [3]",
        ),
        (
            {"level": "error", "frames": "all", "default": 1},
            "'default' must be true or false, not 1",
        ),
        (
            {"level": "error", "frames": "all", "share": "2 %"},
            "'share' must be one of '1 particle', '0.1 %', '1 %', '10 %', 'half', 'all', not '2 %'",
        ),
    ],
)
def test_a_cover_that_is_none(value: object, said: str) -> None:
    with pytest.raises(ValueError, match="must be") as caught:
        cover_from_json(value)
    assert str(caught.value) == said
