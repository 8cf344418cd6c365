"""Describes rules for code scanning, from their pages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from usdvol_lint.model import Severity
from usdvol_lint.results import Cause, Report
from usdvol_lint.words import printable

if TYPE_CHECKING:
    from usdvol_lint.packs.page import Page

_LONGEST_DESCRIPTION = 1000
"""In characters; GitHub takes 1,024."""
_EXAMPLES = frozenset({"Wrong", "Right", "Examples"})

LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


def described(
    causes: Iterable[Cause], report: Report, page_of: Callable[[str], Page | None]
) -> Mapping[str, dict[str, object]]:
    """By code, in order, the rules that found these causes."""
    worst: dict[str, Cause] = {}
    for cause in causes:
        if cause.code not in worst or cause.severity > worst[cause.code].severity:
            worst[cause.code] = cause
    return {code: _rule(worst[code], report, page_of(code)) for code in sorted(worst)}


def _rule(worst: Cause, report: Report, page: Page | None) -> dict[str, object]:
    """A rule, with the worst of what it found."""
    summary, full, help_text = _texts(page) if page else (worst.name, worst.name, "")
    more = f"`usdvol-lint --explain {printable(worst.code)}` prints the page of this rule."
    help_text = f"{help_text}\n\n{more}" if help_text else more
    rule: dict[str, object] = {
        "id": printable(worst.code),
        "name": printable(worst.name),
        "shortDescription": {"text": printable(summary) or "no name"},
        "fullDescription": {"text": printable(full) or "no name"},
        "help": {"text": help_text, "markdown": help_text},
        "defaultConfiguration": {"level": _level(worst, report)},
    }
    if (worst.first.help or "").startswith("https://"):
        rule["helpUri"] = worst.first.help
    if page:
        rule["properties"] = {"tags": [page.path.parent.name]}
    return rule


def _level(worst: Cause, report: Report) -> str:
    """The level that the rule has in this run."""
    levels = report.settings.get("rules")
    label = levels.get(worst.code) if isinstance(levels, Mapping) else None
    found = next((severity for severity in LEVELS if severity.label == label), worst.severity)
    return LEVELS[found]


def _texts(page: Page) -> tuple[str, str, str]:
    """The sentence of a page, the same with why it matters, and the page without its examples."""
    sections = page.sections()
    why = next(iter(sections.values()), "").partition("\n\n")[0]
    full = " ".join(f"{page.summary} {why}".split())
    if len(full) > _LONGEST_DESCRIPTION:
        full = page.summary
    parts = [f"## {title}\n{text}" for title, text in sections.items() if title not in _EXAMPLES]
    return page.summary, full, "\n\n".join((page.summary, *parts))
