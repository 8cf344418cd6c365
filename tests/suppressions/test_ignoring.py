"""What a dictionary `usdvolLint` says, and what is wrong with it."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pxr import Sdf, Vt

from usdvol_lint.engine.ignoring import Fault, Said, read
from usdvol_lint.packs.catalog import Catalog

_SHAPE = 'write dictionary usdvolLint = { dictionary ignore = { string CODE = "why" } }'


def said(catalog: Catalog, **ignored: Any) -> Said:
    return read({"ignore": ignored}, catalog.rules, "2026-06-01")


def test_reasons(catalog: Catalog) -> None:
    reasons = {
        "AST001": " why ",
        "AST002": "until 2026-06-01: why",
        "AST003": "Until 2026-06-01 why",
        "AST004": "until 3 artists are back",
        "AST005": "until the farm is back: JIRA-1",
        "AST006": "",
        "AST007": " ",
    }
    stripped = {code: reason.strip() for code, reason in reasons.items()}
    assert said(catalog, **reasons) == Said(stripped, ())
    assert read({}, catalog.rules, None) == Said({}, ())


@pytest.mark.parametrize(
    ("code", "value", "message", "suggestion"),
    [
        (
            "LNT001",
            "x",
            "LNT001 can't be ignored: it says that the job was not done",
            "take it out",
        ),
        (
            "file-missing",
            "x",
            "'file-missing' is not the code of a rule: it ignores nothing",
            "write 'AST002'",
        ),
        (
            "file_missing",
            "x",
            "'file_missing' is not the code of a rule: it ignores nothing",
            "write 'AST002'",
        ),
        ("ast002", "x", "'ast002' is not the code of a rule: it ignores nothing", "write 'AST002'"),
        (
            "AST",
            "x",
            "there is no rule 'AST' to ignore",
            "write a key for each code, such as AST002",
        ),
        (
            "all",
            "x",
            "there is no rule 'all' to ignore",
            "write a key for each code, such as AST002",
        ),
        ("VOL0013", "x", "there is no rule 'VOL0013' to ignore", "did you mean 'VOL013'?"),
        (
            "a\nb",
            "x",
            "there is no rule 'a\\x0ab' to ignore",
            "write a key for each code, such as AST002",
        ),
        (
            "AST002",
            True,
            "the reason why AST002 is ignored is a bool, not a text",
            "write it as a string",
        ),
        (
            "AST002",
            1.5,
            "the reason why AST002 is ignored is a number, not a text",
            "write it as a string",
        ),
        (
            "AST002",
            {},
            "the reason why AST002 is ignored is a dictionary, not a text",
            "write it as a string",
        ),
        (
            "AST002",
            Vt.StringArray(["x"]),
            "the reason why AST002 is ignored is a list, not a text",
            "write it as a string",
        ),
        (
            "AST002",
            Sdf.AssetPath("x"),
            "the reason why AST002 is ignored is of type AssetPath, not a text",
            "write it as a string",
        ),
        (
            "AST002",
            "until 2026-05-31: the farm",
            "AST002 was ignored until 2026-05-31, which is over: 'the farm'",
            "mend it, or take this out",
        ),
        (
            "AST002",
            "until 2026-02-30: x",
            "AST002 is ignored until '2026-02-30', which is no date: it ignores nothing",
            "write 'until YYYY-MM-DD: ' and the reason",
        ),
        (
            "AST002",
            "until 1/2/2026: x",
            "AST002 is ignored until '1/2/2026', which is no date: it ignores nothing",
            "write 'until YYYY-MM-DD: ' and the reason",
        ),
        (
            "AST002",
            "Until:",
            "AST002 is ignored until no day",
            "write 'until YYYY-MM-DD: ' and the reason",
        ),
        (
            "AST002",
            "until 2026-12-31: ",
            "AST002 is ignored until 2026-12-31 without a reason",
            "say why after the date",
        ),
    ],
)
def test_what_is_wrong(
    catalog: Catalog, code: str, value: Any, message: str, suggestion: str
) -> None:
    fault = Fault(("usdvolLint", "ignore", code), message, suggestion)
    assert said(catalog, **{code: value, "VOL001": "why"}) == Said({"VOL001": "why"}, (fault,))


def test_what_has_another_shape(catalog: Catalog) -> None:
    def faults(data: Any) -> list[tuple[tuple[str, ...], str, str | None]]:
        return [tuple(fault) for fault in read(data, catalog.rules, None).faults]

    assert faults("AST002") == [
        (("usdvolLint",), "'usdvolLint' is a text, not a dictionary: it ignores nothing", _SHAPE)
    ]
    assert faults({"ignore": 3}) == [
        (
            ("usdvolLint", "ignore"),
            "'ignore' in 'usdvolLint' is a number, not a dictionary: it ignores nothing",
            _SHAPE,
        )
    ]
    assert faults({"ignored": {"AST002": "x"}, "note": "x"}) == [
        (
            ("usdvolLint", "ignored"),
            "'usdvolLint' has a key 'ignored', which means nothing",
            "all it can have is 'ignore'",
        ),
        (
            ("usdvolLint", "note"),
            "'usdvolLint' has a key 'note', which means nothing",
            "all it can have is 'ignore'",
        ),
    ]


_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text() | st.just("ignore"), inner),
    max_leaves=8,
)


@given(data=_VALUES)
def test_nonsense_is_said_and_raises_nothing(catalog: Catalog, data: Any) -> None:
    found = read({"ignore": data}, catalog.rules, None)
    assert isinstance(found, Said)
    assert not found.reasons
    read(data, catalog.rules, None)
