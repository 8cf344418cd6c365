"""The catalog of all rules, in which they are found and selected by codes and names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from usdvol_lint.model import PackError, Severity, UsageError
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.packs.folders import find_packs, import_rules
from usdvol_lint.rule import Problems, Rule

if TYPE_CHECKING:
    from usdvol_lint.packs.page import Page


def _never_run(prim: object, facts: object) -> Problems:
    yield from ()


def _engine_rule(code: str, name: str, severity: Severity) -> Rule:
    return Rule(code, name, (), severity, "0.1", _never_run, {})


STAGE_UNREADABLE = _engine_rule("LNT001", "stage-unreadable", Severity.ERROR)
RULE_FAILED = _engine_rule("LNT002", "rule-failed", Severity.ERROR)
UNUSED_SUPPRESSION = _engine_rule("LNT003", "unused-suppression", Severity.WARNING)
USD_TOO_OLD = _engine_rule("LNT004", "usd-too-old", Severity.WARNING)
NOT_CHECKED = _engine_rule("LNT005", "not-checked", Severity.INFO)
ENGINE_RULES = (STAGE_UNREADABLE, RULE_FAILED, UNUSED_SUPPRESSION, USD_TOO_OLD, NOT_CHECKED)
"""The codes that the engine itself reports; `rules/lint/` holds only their pages."""
NOT_IGNORABLE = frozenset({STAGE_UNREADABLE.code, RULE_FAILED.code})
"""They say that the job was not done, so nobody can switch them off."""
OF_UNCHECKED = frozenset({USD_TOO_OLD.code, NOT_CHECKED.code})
"""What the engine itself did not check: in force where such a thing fails a run."""


def help_for(rule: Rule) -> str:
    """The command that prints a rule's page: it works wherever the tool does."""
    return f"usdvol-lint --explain {rule.code}"


class Catalog(NamedTuple):
    """All rules by code, in order, with the folders their pages lie in.

    `built_in` are the codes of those that come with the tool.
    """

    rules: Mapping[str, Rule]
    folders: tuple[str, ...] = ()
    built_in: frozenset[str] = frozenset()

    def page(self, code: str) -> Page | None:
        """The page of a rule, or None if its pack has none."""
        from pathlib import Path  # this and the next cost start-up time, and few runs show a page

        from usdvol_lint.packs.page import read_page

        stem = self.rules[code].name.replace("-", "_")
        for folder in self.folders:
            for path in Path(folder).glob(f"**/{stem}.md"):
                page = read_page(path)
                if page.code == code:
                    return page
        return None

    def find(self, code_or_name: str) -> Rule:
        """The rule of that code or name; raises UsageError if there is none."""
        wanted = code_or_name.strip()
        by_name = {rule.name: rule for rule in self.rules.values()}
        rule = self.rules.get(wanted.upper()) or by_name.get(wanted.lower())
        if rule is None:
            raise UsageError(f"no rule {wanted!r}{did_you_mean(wanted, [*self.rules, *by_name])}")
        return rule

    def expand(self, selector: str) -> frozenset[str]:
        """The codes that a selector matches: a code, a prefix of codes, or ALL.

        Raises UsageError if it matches none.
        """
        wanted = selector.strip().upper()
        codes = self.rules if wanted == "ALL" else [c for c in self.rules if c.startswith(wanted)]
        if not codes or not wanted:
            raise UsageError(f"no rule code starts with {selector.strip()!r}{self._hint(wanted)}")
        return frozenset(codes)

    def select(self, select: Sequence[str], ignore: Sequence[str]) -> frozenset[str]:
        """The codes of active rules; where `select` and `ignore` both match, the longer wins."""
        chosen = self._lengths(select)
        dropped = self._lengths(ignore)
        for code in NOT_IGNORABLE & dropped.keys():
            if code in (selector.strip().upper() for selector in ignore):
                raise UsageError(f"{code} can't be ignored: it says that the job was not done")
        if not select:
            chosen = {code: 0 for code, rule in self.rules.items() if rule.default}
        on = {code for code, length in chosen.items() if length > dropped.get(code, -1)}
        return frozenset(on) | NOT_IGNORABLE

    def _hint(self, wanted: str) -> str:
        by_name = {rule.name.upper(): code for code, rule in self.rules.items()}
        families = sorted({code[:3] for code in self.rules})
        hint = did_you_mean(wanted, [*self.rules, *families, "ALL"])
        return hint or did_you_mean(by_name.get(wanted, ""), self.rules)

    def _lengths(self, selectors: Sequence[str]) -> dict[str, int]:
        lengths: dict[str, int] = {}
        for selector in selectors:
            for code in self.expand(selector):
                lengths[code] = max(length(selector), lengths.get(code, 0))
        return lengths


def length(selector: str) -> int:
    """How specific a selector is: the longer of two that match a code wins; ALL counts as 0."""
    stripped = selector.strip()
    return 0 if stripped.upper() == "ALL" else len(stripped)


def load(packs: Sequence[str] = ()) -> Catalog:
    """The built-in rules, those of installed packs, and those of the folders `packs`.

    Raises PackError for a pack that can't be loaded, or two rules of the same code or name.
    """
    found = find_packs(packs)
    built_in: frozenset[str] = frozenset()
    rules = {rule.code: rule for rule in ENGINE_RULES}
    names = {rule.name: rule for rule in ENGINE_RULES}
    for package, folder in found:
        for rule in import_rules(package, folder):
            same_code = rules.setdefault(rule.code, rule)
            same_name = names.setdefault(rule.name, rule)
            for other in (same_code, same_name):
                if other is not rule:
                    raise PackError(
                        f"rule pack {folder!r}: {rule.code} ({rule.name}) takes the code or "
                        f"name of another rule, {other.code} ({other.name})"
                    )
        built_in = built_in or frozenset(rules)  # the first pack is
    return Catalog(dict(sorted(rules.items())), tuple(folder for _, folder in found), built_in)
