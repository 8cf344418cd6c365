"""What came after the release that `rules-as-of` names is an info, and nothing else changes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from process import STUDIO, run, volume, write

from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Severity
from usdvol_lint.packs.activation import ActiveRules, activate
from usdvol_lint.packs.catalog import NOT_IGNORABLE, Catalog, load
from usdvol_lint.rule import NotChecked, Problem

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO
CODE = "AST002"


def with_rule(catalog: Catalog, code: str = CODE, **changes: Any) -> Catalog:
    """The catalog with one of its rules changed."""
    return catalog._replace(rules={**catalog.rules, code: catalog.rules[code]._replace(**changes)})


def active(catalog: Catalog, since: str, **config: Any) -> ActiveRules:
    return activate(Config(**config), with_rule(catalog, since=since))


@pytest.mark.parametrize(
    ("since", "as_of", "level"),
    [
        ("0.2", "0.1", INFO),
        ("0.2", "0.1.7", INFO),
        ("0.10", "0.9", INFO),
        ("0.2", "0.2", ERROR),
        ("0.2", "0.2.1", ERROR),
        ("0.2", "1.0", ERROR),
        ("0.2", None, ERROR),
    ],
)
def test_a_younger_rule_reports_infos(
    since: str, as_of: str | None, level: Severity, catalog: Catalog
) -> None:
    plain = activate(Config(), catalog)
    dated = active(catalog, since, rules_as_of=as_of)
    assert dated.severities == {**plain.severities, CODE: level}
    assert plain.telling - dated.telling == ({CODE} if level is INFO else set()), (
        "other rules are silent for it, and would be missed"
    )
    assert dated.chosen == frozenset()


@pytest.mark.parametrize("selector", [CODE, "AST", "ALL"])
@pytest.mark.parametrize("level", ["error", "warning"])
def test_a_level_that_the_user_chose_stays(selector: str, level: str, catalog: Catalog) -> None:
    dated = active(catalog, "0.2", rules_as_of="0.1", severity={selector: level})
    assert dated.severities[CODE].label == level
    assert not dated.is_younger(CODE, "0.2")


def test_whether_the_job_was_done_is_told_whatever_the_version(catalog: Catalog) -> None:
    dated = activate(Config(rules_as_of="0.0"), catalog)
    errors = {code for code, severity in dated.severities.items() if severity is ERROR}
    assert errors == NOT_IGNORABLE
    assert {dated.severities[code] for code in dated.severities.keys() - errors} == {INFO}


def test_packs_have_versions_of_their_own() -> None:
    catalog = load([str(STUDIO)])
    assert {code for code in catalog.rules if code not in catalog.built_in} == {"STU001", "STU002"}
    plain = activate(Config(), catalog)
    dated = activate(Config(rules_as_of="0.0"), catalog)
    assert dated.severities["STU001"] is plain.severities["STU001"] is ERROR
    assert not dated.is_younger("STU001", "999")


def finding_of(catalog: Catalog, folder: Path, problem: Callable[..., Any], **config: Any) -> Any:
    """The finding that the rule makes of its only problem."""

    def check(prim: Any, facts: Any) -> Any:
        yield problem("seen", at=prim)

    rules = with_rule(catalog, on=("Volume",), when=None, check=check, options={})
    found = Engine(rules.rules, activate(Config(select=(CODE,), **config), rules))
    write(folder, fog=volume("fog"))
    (finding,) = found.lint(str(folder / "fog.usda")).findings
    return finding


@pytest.mark.parametrize(
    ("problem", "config", "level", "own"),
    [
        ({}, {}, ERROR, ERROR),
        ({"since": "0.2"}, {}, INFO, ERROR),
        ({"since": "0.2", "severity": WARNING}, {}, INFO, WARNING),
        ({"since": "0.1"}, {}, ERROR, ERROR),
        ({"since": "0.1", "severity": WARNING}, {}, WARNING, WARNING),
        ({"since": "0.2"}, {"rules_as_of": None}, ERROR, ERROR),
        ({"since": "0.2"}, {"severity": {CODE: "warning"}}, WARNING, ERROR),
    ],
)
def test_a_rule_that_came_to_see_more(
    problem: dict[str, Any],
    config: dict[str, Any],
    level: Severity,
    own: Severity,
    catalog: Catalog,
    tmp_path: Path,
) -> None:
    """How far a cause goes does not depend on it, so a baseline neither gains nor loses."""
    config = {"rules_as_of": "0.1", **config}
    found = finding_of(catalog, tmp_path, lambda *at, **of: Problem(*at, **of, **problem), **config)
    assert (found.severity, found.cover.level, found.since) == (level, own, problem.get("since"))


def test_how_far_a_younger_rule_goes_is_the_same(catalog: Catalog, tmp_path: Path) -> None:
    found = finding_of(catalog, tmp_path, Problem, rules_as_of="0.0")
    assert (found.severity, found.cover.level) == (INFO, ERROR)


def test_what_was_not_checked_is_no_younger(catalog: Catalog, tmp_path: Path) -> None:
    config = {"rules_as_of": "0.1", "select": (CODE, "LNT005"), "severity": {"LNT005": "error"}}

    def check(prim: Any, facts: Any) -> Any:
        yield NotChecked("not seen", at=prim)

    rules = with_rule(catalog, on=("Volume",), when=None, check=check, options={}, since="0.2")
    write(tmp_path, fog=volume("fog"))
    engine = Engine(rules.rules, activate(Config(**config), rules))
    (finding,) = engine.lint(str(tmp_path / "fog.usda")).findings
    assert (finding.code, finding.severity, finding.cover.level) == ("LNT005", ERROR, INFO)


def test_rules_of_a_release_that_a_configuration_names(tmp_path: Path) -> None:
    """Every built-in rule is younger than 0.0, so only the studio's own turns the run red."""
    write(tmp_path, fog=volume("fog"))
    found = {}
    for as_of in ("0.0", "0.1"):
        (tmp_path / "usdvol-lint.toml").write_text(
            f"rules-as-of = '{as_of}'\nselect = ['SCH007', 'STU001']\n",
            encoding="utf-8",
        )
        ran = run(".", "--pack", STUDIO, "--output-format", "json", cwd=tmp_path)
        assert ran.json["settings"]["rules_as_of"] == as_of
        causes = ran.json["causes"]
        found[as_of] = {
            each["code"]: (each["severity"], each["cover"]["level"], each["fingerprint"])
            for each in causes
        }
    old, new = found.values()
    assert old["STU001"] == new["STU001"]
    assert (old["SCH007"][0], *old["SCH007"][1:]) == ("info", *new["SCH007"][1:])
    assert new["SCH007"][:2] == ("warning", "warning")
