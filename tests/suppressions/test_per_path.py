"""The tables `[[per-path]]`: another severity, or none, for what some layers are to blame for."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from process import AS_JSON, STUDIO, run, settings, volume, write

from usdvol_lint.config import Config
from usdvol_lint.config.per_path import PerPath, read_per_path
from usdvol_lint.model import Severity, Source, UsageError
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.run.layer_levels import Verdict, verdicts

WHERE = "c.toml: per-path, table 1"


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ({"ignore": ["AST"]}, "'files' must say for which layers this is"),
        ({"files": "a"}, "say what is so there, with severity or ignore"),
        ({"files": "a", "severity": {}}, "say what is so there, with severity or ignore"),
        ({"files": "a", "rules": "AST"}, "unknown key 'rules'"),
        ({"file": "a"}, "unknown key 'file'; did you mean 'files'?"),
        ({"files": "!", "ignore": ["AST"]}, "files: '!' is no pattern as in a .gitignore"),
        ({"files": "a", "ignore": ["AST", ""]}, "ignore has an empty string, which names nothing"),
        (
            {"files": "a", "severity": {"AST": "ignore"}},
            "severity.AST must be one of error, warning, info, not 'ignore'; "
            "a rule that is to report nothing stands in `ignore`",
        ),
    ],
)
def test_what_is_wrong_is_named(said: dict[str, Any], message: str) -> None:
    with pytest.raises(UsageError) as raised:
        read_per_path("c.toml: per-path", [said])
    assert str(raised.value).startswith(WHERE)
    assert message in str(raised.value)


def test_they_are_tables() -> None:
    with pytest.raises(UsageError, match=r"^c: per-path must be tables, each below a line \[\[per"):
        read_per_path("c: per-path", {"files": "a"})


def table(**said: Any) -> PerPath:
    return read_per_path("c.toml: per-path", [said])[0]


@pytest.fixture
def on(catalog: Catalog) -> Callable[..., Verdict | None]:
    """What tables make of AST002 in lookdev/smoke.usda."""

    def call(
        *tables: PerPath, layer: str | None = "lookdev/smoke.usda", **config: Any
    ) -> Verdict | None:
        verdict_on = verdicts(Config(per_path=tables, **config), catalog)
        return verdict_on("AST002", Source(layer)) if verdict_on else None

    return call


@pytest.mark.parametrize(
    ("said", "verdict"),
    [
        ({"files": "lookdev/**", "severity": {"AST002": "info"}}, Severity.INFO),
        ({"files": "lookdev", "severity": {"asset": "info"}}, Severity.INFO),
        ({"files": ["x", "*.usda"], "severity": {"file-missing": "info"}}, Severity.INFO),
        ({"files": "shots/**", "severity": {"AST002": "info"}}, None),
        ({"files": "lookdev/**", "severity": {"VOL": "info"}}, None),
        ({"files": "lookdev/**", "severity": {"AST": "info", "AST002": "warning"}}, "WARNING"),
        ({"files": "lookdev/**", "severity": {"AST002": "warning", "AST": "info"}}, "WARNING"),
        ({"files": "lookdev/**", "ignore": ["AST"]}, "ignored by per-path for 'lookdev/**'"),
        (
            {"files": "lookdev/**", "ignore": ["AST"], "severity": {"AST002": "warning"}},
            Severity.WARNING,
        ),
        (
            {"files": "lookdev", "ignore": ["AST002"], "severity": {"AST": "warning"}},
            "ignored by per-path for 'lookdev'",
        ),
        (
            {"files": "lookdev", "ignore": ["AST002"], "severity": {"AST002": "warning"}},
            "ignored by per-path for 'lookdev'",
        ),
    ],
)
def test_what_a_table_says(
    on: Callable[..., Verdict | None], said: dict[str, Any], verdict: Verdict | None
) -> None:
    assert on(table(**said)) == (Severity.WARNING if verdict == "WARNING" else verdict)


def test_the_last_table_counts_that_names_the_rule(on: Callable[..., Verdict | None]) -> None:
    """However exact the others are."""
    exact = table(files="lookdev/smoke.usda", severity={"AST002": "info"})
    broad = table(files="**", severity={"ALL": "warning"})
    other = table(files="**", severity={"VOL": "error"})
    assert on(exact, broad, other) == Severity.WARNING
    assert on(broad, exact, other) == Severity.INFO
    assert on(table(files="**", ignore=["ALL"]), exact) == Severity.INFO


def test_what_has_no_layer_is_of_no_path(on: Callable[..., Verdict | None]) -> None:
    assert on(table(files="**", severity={"ALL": "info"}), layer=None) is None
    assert on(table(files="**", severity={"ALL": "info"}), layer="x.usdz[a.usda]") == Severity.INFO
    assert on() is None


def test_who_trusts_no_suppression_is_told(on: Callable[..., Verdict | None]) -> None:
    tables = table(files="**", severity={"AST": "info"}), table(files="**", ignore=["AST"])
    assert on(*tables, suppressions="none") == Severity.INFO
    assert on(*tables, suppressions="configuration") == "ignored by per-path for '**'"


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ({"ignore": ["AST02"]}, "ignore: 'AST02' is no rule, no family and no beginning of a code"),
        ({"ignore": ["LNT001"]}, "ignore: LNT001 can't be ignored: it says that the job was not"),
        ({"severity": {"AST02": "info"}}, "severity.AST02: 'AST02' is no rule"),
        ({"severity": {"rule-failed": "info"}}, "severity.rule-failed: rule-failed stays an error"),
    ],
)
def test_rules_have_to_be_there(
    on: Callable[..., Verdict | None], said: dict[str, Any], message: str
) -> None:
    with pytest.raises(UsageError) as raised:
        on(table(files="a", **said))
    assert str(raised.value).startswith(f"{WHERE}: {message}")


def test_what_says_that_the_job_was_not_done_stays(catalog: Catalog) -> None:
    for said in ({"ignore": ["ALL"]}, {"severity": {"LNT": "info"}}):
        verdict_on = verdicts(Config(per_path=(table(files="**", **said),)), catalog)
        assert verdict_on
        assert verdict_on("LNT001", Source("a")) is None
        assert verdict_on("LNT003", Source("a")) is not None


def test_a_run(tmp_path: Path) -> None:
    """Verdict and exit code take the severity of the path, the baseline that of the rule."""
    (tmp_path / ".git").mkdir()
    for name in ("lookdev", "old", "shots"):
        write(tmp_path / name, fog=volume("fog"))
    (tmp_path / "usdvol-lint.toml").write_text(
        "select = ['STU001']\n"
        "[[per-path]]\nfiles = 'lookdev/**'\nseverity = { volume-name = 'warning' }\n"
        "[[per-path]]\nfiles = 'old/**'\nignore = ['house']\n",
        encoding="utf-8",
    )
    report = run("--pack", STUDIO, "--output-format", "json", ".", cwd=tmp_path)
    assert report.code == 1
    assert [
        (cause["source"]["layer"], cause["severity"], cause["state"], cause["cover"]["level"])
        for cause in report.json["causes"]
    ] == [
        ("lookdev/fog.usda", "warning", "new", "error"),
        ("shots/fog.usda", "error", "new", "error"),
        ("old/fog.usda", "error", "suppressed", "error"),
    ]
    assert report.json["causes"][2]["reason"] == "ignored by per-path for 'old/**'"
    assert report.json["stages"][0]["levels"] == {"warning": 1}
    assert [each["files"] for each in report.json["settings"]["per_path"]] == [
        ["lookdev/**"],
        ["old/**"],
    ]
    assert run("--pack", STUDIO, "lookdev", "old", cwd=tmp_path).code == 0
    assert run("--pack", STUDIO, "--no-suppressions", "old", cwd=tmp_path).code == 1


def test_settings_say_it(tmp_path: Path) -> None:
    text = "[[per-path]]\nfiles = 'a'\nseverity = { AST = 'info' }\n"
    (tmp_path / "usdvol-lint.toml").write_text(text, encoding="utf-8")
    shown = settings(run(*AS_JSON, cwd=tmp_path))["per_path"]
    assert shown == [{"files": ["a"], "severity": {"AST": "info"}}]
