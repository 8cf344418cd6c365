"""What the JSON report leaves out, and what it never holds."""

from __future__ import annotations

import json
from typing import Any

import jsonschema  # type: ignore[import-untyped]
import pytest
from reports import report
from reportschema import STRICT
from sharedcauses import BY_CAUSE, TANK, USED, shown_on

from usdvol_lint.report import Options, render
from usdvol_lint.results import BaselineUse, Report


def written(subject: Report) -> Any:
    parsed = json.loads(render(subject, "json", Options()), parse_constant=pytest.fail)
    jsonschema.validate(parsed, STRICT)
    return parsed


def test_a_place_has_words_only_where_they_are_its_own() -> None:
    first = TANK._replace(suggestion="copy it")
    others = (
        shown_on("b", first, "/B"),
        shown_on("c", first._replace(message="no file there"), "/C"),
        shown_on("d", first._replace(suggestion=None), "/D"),
    )
    (cause,) = written(report(shown_on("a", first, "/A"), *others))["causes"]
    said = [(place.get("message", ""), place.get("suggestion", "")) for place in cause["places"]]
    assert said == [("", ""), ("", ""), ("no file there", ""), ("", None)]


def test_times_are_numbers_of_json() -> None:
    """What is not finite is none, and the ranges say it all the same."""
    times = (float("-inf"), -0.5, 3.0, 2.0**60, float("inf"))
    site = TANK.site._replace(times=times)
    (cause,) = written(report(shown_on("a", TANK._replace(site=site), "/A")))["causes"]
    (place,) = cause["places"]
    assert [repr(time) for time in place["times"]] == ["-0.5", "3", repr(2.0**60)]
    assert place["frames"].endswith(", inf")


@pytest.mark.parametrize(
    "text",
    ["\x7f", "a\x7fé", "\x9b31m", "\u202e", "\u2028", "\udcff", "\u200b", "\ufeff", "\xad"],
    ids=ascii,
)
def test_what_a_terminal_would_obey_is_escaped(text: str) -> None:
    subject = report(shown_on("a", TANK._replace(message=text), "/A"))
    raw = render(subject, "json", Options())
    assert f"\\u{ord(text.strip('aé31m')):04x}" in raw
    assert raw.replace("\n", "").isprintable()
    assert written(subject)["causes"][0]["message"] == text


def test_invisible_characters_beyond_16_bits_are_escaped_as_pairs() -> None:
    subject = report(shown_on("a", TANK._replace(message="a\U000e0041é"), "/A"))
    assert r"a\udb40\udc41é" in render(subject, "json", Options())
    assert written(subject)["causes"][0]["message"] == "a\U000e0041é"


@pytest.mark.parametrize(
    ("use", "gone", "partial"),
    [
        (USED._replace(gone=None, partial="it lacks a.usda"), None, "it lacks a.usda"),
        (USED._replace(gone=()), [], None),
        (USED, ["AST002 assets/old/tank.usda </Tank/fire>"], None),
    ],
    ids=["not-known", "none", "one"],
)
def test_what_is_gone_is_not_what_nobody_knows(
    use: BaselineUse, gone: list[str] | None, partial: str | None
) -> None:
    said = written(BY_CAUSE._replace(baseline=use))["baseline"]
    assert (said["gone"], said["partial"]) == (gone, partial)
