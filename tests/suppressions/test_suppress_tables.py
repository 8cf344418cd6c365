"""The tables `[[suppress]]` of a configuration: what is wrong with one, and what it takes out."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from usdvol_lint.config import Config
from usdvol_lint.config.files import read_config
from usdvol_lint.model import Cover, Finding, Severity, Site, Source, UsageError
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.run.suppressing import expired, in_stages, reasons
from usdvol_lint.suppressions import InStages, Suppression, is_date, is_over, read_tables


def table(**said: Any) -> Suppression:
    return read_tables("c.toml: suppress", [{"reason": "why", **said}])[0]


def test_a_table(tmp_path: Path) -> None:
    (tmp_path / "usdvol-lint.toml").write_text(
        """
suppressions = "configuration"

[[suppress]]
files = "assets/**"
stages = ["shots/**", "!shots/final/**"]
prims = "/World/FX/**"
rules = ["AST002", "VOL"]
reason = " the farm is late "
until = 2026-12-31

[[suppress]]
rules = "file-missing"
reason = "JIRA-1"
until = "2026-12-31"
""",
        encoding="utf-8",
    )
    file = tmp_path / "usdvol-lint.toml"
    config = read_config(file)
    assert config.suppressions == "configuration"
    assert config.suppress == (
        Suppression(
            f"{file}: suppress, table 1",
            "the farm is late",
            ("assets/**",),
            ("shots/**", "!shots/final/**"),
            ("/World/FX/**",),
            ("AST002", "VOL"),
            "2026-12-31",
        ),
        Suppression(
            f"{file}: suppress, table 2", "JIRA-1", rules=("file-missing",), until="2026-12-31"
        ),
    )
    assert [each.as_written() for each in config.suppress][1] == {
        "rules": ("file-missing",),
        "reason": "JIRA-1",
        "until": "2026-12-31",
    }


WHERE = "c.toml: suppress, table 2"


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ({"file": "a"}, f"{WHERE}: unknown key 'file'; did you mean 'files'?"),
        ({"files": "a", "reason": None}, f"{WHERE}: 'reason' must say why, not None"),
        ({"files": "a", "reason": " "}, f"{WHERE}: 'reason' must say why, not ' '"),
        (
            {},
            f"{WHERE}: name what is suppressed, with one of files, stages, prims, rules",
        ),
        ({"rules": []}, f"{WHERE}: rules must be a text or a list of texts, not []"),
        ({"rules": [1]}, f"{WHERE}: rules must be a text or a list of texts, not [1]"),
        ({"rules": 1}, f"{WHERE}: rules must be a text or a list of texts, not 1"),
        (
            {"prims": ["a", " "]},
            f"{WHERE}: prims must be a text or a list of texts, not ['a', ' ']",
        ),
        ({"prims": "!"}, f"{WHERE}: prims: '!' is no pattern as in a .gitignore"),
        (
            {"files": "a", "until": "2026-13-01"},
            f"{WHERE}: until must be a date such as 2026-12-31, not '2026-13-01'",
        ),
        (
            {"files": "a", "until": 20261231},
            f"{WHERE}: until must be a date such as 2026-12-31, not '20261231'",
        ),
    ],
)
def test_what_is_wrong_is_named(said: dict[str, Any], message: str) -> None:
    with pytest.raises(UsageError) as raised:
        read_tables("c.toml: suppress", [{"reason": "x", "rules": "ALL"}, {"reason": "x", **said}])
    assert str(raised.value) == message


def test_a_reason_has_to_be_there() -> None:
    with pytest.raises(UsageError) as raised:
        read_tables("c.toml: suppress", [{"rules": "ALL"}])
    assert str(raised.value) == "c.toml: suppress, table 1: 'reason' must say why"


@pytest.mark.parametrize("value", [3, {"reason": "x"}, ["x"]])
def test_they_are_tables(value: Any) -> None:
    with pytest.raises(UsageError, match=r"^c: suppress must be tables, each below a line \[\["):
        read_tables("c: suppress", value)


def test_dates() -> None:
    assert [is_date(text) for text in ("2026-12-31", "2026-13-01", "20261231", "2026-W01-1")] == [
        *(True, False, False, False)
    ]
    assert [is_over("2026-12-31", day) for day in ("2026-12-31", "2027-01-01")] == [False, True]
    assert [is_over(day) for day in ("2000-01-01", "9999-01-01")] == [True, False]


# --- what they take out ---------------------------------------------------------------------------

Reason = Callable[..., str | None]


@pytest.fixture
def reason(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Reason:
    """Why a finding of AST002 at /World/FX/smoke is suppressed by tables."""
    monkeypatch.chdir(tmp_path)

    def call(
        *tables: Suppression,
        code: str = "AST002",
        stage: str = "shots/s1.usda",
        layer: str | None = "assets/smoke.usda",
        prim: str | None = "/World/FX/smoke",
        **config: Any,
    ) -> str | None:
        given = Config(suppress=tables, **config)
        reason_for = reasons(given, catalog, tmp_path.resolve().as_posix())
        level = Severity.ERROR
        source = Source(layer)
        finding = Finding(code, "x", level, "", Site("x", prim), source, Cover(level))
        return reason_for(stage, finding, source) if reason_for else None

    return call


ALL = {"rules": "ALL"}


@pytest.mark.parametrize(
    ("said", "is_taken"),
    [
        ({"files": "assets/**"}, True),
        ({"files": "assets"}, True),
        ({"files": "smoke.usda"}, True),
        ({"files": "/smoke.usda"}, False),
        ({"files": ["other/**", "assets/*.usda"]}, True),
        ({"files": ["assets/**", "!assets/smoke.usda"]}, False),
        ({"stages": "shots/**"}, True),
        ({"stages": "assets/**"}, False),
        ({"prims": "/World/FX/**"}, True),
        ({"prims": "/World/FX"}, True),
        ({"prims": "/World/FX/smoke/**"}, False),
        ({"prims": "/FX/**"}, False),
        ({"prims": "**/FX/**"}, True),
        ({"prims": "/World/*/smoke"}, True),
        ({"rules": "AST002"}, True),
        ({"rules": "file-missing"}, True),
        ({"rules": ["VOL", "ast"]}, True),
        ({"rules": ["VOL", "AST001"]}, False),
        ({"files": "assets/**", "rules": "VOL"}, False),
        ({"files": "x/**", "rules": "AST"}, False),
        ({"files": "assets/**", "stages": "x/**"}, False),
        ({"files": "assets/**", "prims": "/x"}, False),
    ],
)
def test_what_a_table_takes_out(reason: Reason, said: dict[str, Any], is_taken: bool) -> None:
    assert reason(table(**said)) == ("why" if is_taken else None)


def test_what_has_no_layer_or_prim_is_none_of_theirs(reason: Reason) -> None:
    assert reason(table(files="**"), layer=None) is None
    assert reason(table(rules="ALL"), layer=None) == "why"
    assert reason(table(prims="**"), prim=None) is None
    assert reason(table(rules="ALL"), prim=None) == "why"


def test_a_package_matches_and_so_do_its_layers(reason: Reason) -> None:
    for pattern in ("assets/x.usdz", "*.usdz", "assets/**", "assets/x.usdz?in.usda?"):
        assert reason(table(files=pattern), layer="assets/x.usdz[in.usda]") == "why"


def test_stages_go_by_the_root_and_not_by_the_folder_one_works_in(
    reason: Reason, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shots = table(stages="/shots/**")
    (tmp_path / "shots").mkdir()
    monkeypatch.chdir(tmp_path / "shots")
    assert reason(shots, stage="s1.usda") == "why"
    assert reason(shots, stage="../shots/s1.usda") == "why"
    assert reason(shots, stage="../s1.usda") is None


def test_the_first_table_counts(reason: Reason) -> None:
    tables = [table(rules=code, reason=code) for code in ("VOL", "AST", "ALL")]
    assert reason(*tables) == "AST"
    assert reason(*tables, code="FLD001") == "ALL"


def test_a_table_holds_to_the_end_of_its_day(reason: Reason) -> None:
    dated = table(rules="ALL", until="2026-12-31")
    assert reason(dated, today="2026-12-31") == "why"
    assert reason(dated, today="2027-01-01") is None
    assert reason(dated, table(rules="ALL", reason="other"), today="2027-01-01") == "other"
    told = "c.toml: suppress, table 1: was until 2026-12-31, which is over: 'why'"
    config = Config(suppress=(dated,), today="2027-01-01")
    assert list(expired(config)) == [told]
    assert list(expired(config._replace(today="2026-12-31"))) == []
    assert list(expired(config._replace(suppressions="none"))) == []


def test_what_says_that_the_job_was_not_done_is_never_suppressed(reason: Reason) -> None:
    for rules in ("ALL", "LNT"):
        assert reason(table(rules=rules), code="LNT001") is None
        assert reason(table(rules=rules), code="LNT003") == "why"
    assert reason(table(files="**"), code="LNT002") is None
    for rules in ("LNT001", "rule-failed"):
        with pytest.raises(UsageError) as raised:
            reason(table(rules=["AST", rules]))
        said = f"{rules} can't be ignored: it says that the job was not done"
        assert str(raised.value) == f"c.toml: suppress, table 1: rules: {said}"


def test_rules_have_to_be_there(reason: Reason) -> None:
    for old in ({}, {"until": "2000-01-01"}):
        with pytest.raises(UsageError) as raised:
            reason(table(rules=["AST02"], **old))
        said = "c.toml: suppress, table 1: rules: 'AST02' is no rule, no family"
        assert str(raised.value).startswith(said)


def test_which_suppressions_are_heeded(reason: Reason) -> None:
    every = table(prims="/World/**")
    assert reason(every, suppressions="configuration") == "why"
    assert reason(every, suppressions="none") is None
    config = Config(suppress=(every, table(prims="/World/**", rules="AST"), table(rules="VOL")))
    assert in_stages(config) == InStages(prims=(("/World/**",),))
    assert in_stages(config._replace(suppressions="none")) == InStages(heeded=False)
    asked = Config(suppressions="configuration", show=("unused",), today="2026-12-31")
    assert in_stages(asked) == InStages(heeded=False, unused=True, today="2026-12-31")
    over = config._replace(suppress=(every._replace(until="2000-01-01"),))
    assert in_stages(over) == InStages()
