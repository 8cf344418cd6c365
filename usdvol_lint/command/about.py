"""Output about the tool itself: a rule's page, the list of rules, the settings in force."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from usdvol_lint.config import Config
from usdvol_lint.model import UsageError
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.packs.page import Page
from usdvol_lint.report.style import paint
from usdvol_lint.words import printable


def explain(catalog: Catalog, code_or_name: str) -> Page:
    """The page of a rule; raises UsageError where there is no such rule or it has no page."""
    rule = catalog.find(code_or_name)
    page = catalog.page(rule.code)
    if page is None:
        raise UsageError(f"{rule.code} ({rule.name}) has no page in its pack")
    return page


def render_page(page: Page, color: bool, width: int) -> str:
    """The page as Markdown, or with `color` laid out for a terminal `width` cells wide."""
    if not color:
        return page.text
    from io import StringIO

    from rich.console import Console
    from rich.markdown import Markdown

    console = Console(file=StringIO(), force_terminal=True, width=min(width, 100))
    with console.capture() as capture:
        console.print(Markdown(page.text))
    return capture.get()


def list_rules(catalog: Catalog, color: bool) -> str:
    """One line for each rule: code, severity, name, summary."""
    lines = []
    for rule in catalog.rules.values():
        page = catalog.page(rule.code)
        level = rule.severity.label if rule.default else f"{rule.severity.label}, off"
        code = paint(rule.code, "bold", color)
        lines.append(f"{code}  {level:<12} {rule.name:<28} {page.summary if page else ''}".rstrip())
    return "\n".join(lines) + "\n"


def list_rules_as_json(catalog: Catalog) -> str:
    """The list of rules for programs, as a JSON array."""
    rules = []
    for rule in catalog.rules.values():
        page = catalog.page(rule.code)
        rules.append(
            {
                "code": rule.code,
                "name": rule.name,
                "severity": rule.severity.label,
                "default": rule.default,
                "since": rule.since,
                "summary": page.summary if page else None,
                "options": rule.options,
            }
        )
    return _as_json(rules)


def show_settings(config: Config, catalog: Catalog, settings: Mapping[str, Any]) -> str:
    """The settings in force as a configuration file, with the rules in force as comments.

    `settings` are those that a report has.
    """
    from usdvol_lint.config.writing import as_toml

    files = ", which extends ".join(config.origins.files) or "none"
    lines = [f"# configuration file: {printable(files)}", "", *as_toml(config)]
    lines += ["", "# in force with that:"]
    for code, level in settings["rules"].items():
        lines.append(f"# {code}  {level:<7}  {catalog.rules[code].name}")
    return "\n".join(lines) + "\n"


def show_settings_as_json(config: Config, settings: Mapping[str, Any]) -> str:
    """The settings in force for programs, as a JSON object."""
    file, *extended = config.origins.files or (None,)
    others = config._asdict()
    del others["origins"]
    said = {"config_file": file, "config_extends": extended, **others, **settings}
    return _as_json(said)


def _as_json(value: object) -> str:
    from usdvol_lint.words import escaped

    return escaped(json.dumps(value, indent=2, ensure_ascii=False)) + "\n"
