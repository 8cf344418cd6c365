"""The catalog of all rules, in which they are found and selected by codes and names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from os.path import isdir, realpath
from typing import TYPE_CHECKING, NamedTuple

from usdvol_lint.config import Config
from usdvol_lint.model import PackError, Severity, UsageError
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.packs.folders import find_packs, import_rules
from usdvol_lint.rule import Problems, Rule
from usdvol_lint.words import quoted

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


_LETTERS, _WHOLE_CODE = 3, 6
"""How many letters a code begins with, and how long it is."""


def help_for(rule: Rule) -> str:
    """The command that prints a rule's page: it works wherever the tool does."""
    return f"usdvol-lint --explain {rule.code}"


class Match(NamedTuple):
    """The codes that a selector stands for, and how exact it is: 0 for ALL, 6 for one rule.

    Of two selectors that match a code the more exact one wins.
    """

    codes: frozenset[str]
    rank: int

    @property
    def not_ignorable(self) -> bool:
        """Whether it names a rule that nobody can switch off."""
        return self.rank == _WHOLE_CODE and self.codes <= NOT_IGNORABLE


class Catalog(NamedTuple):
    """All rules by code, in order, with the folders their pages lie in.

    `built_in` are the codes of those that come with the tool; `families` are the codes of those
    that lie in one folder, by its name.
    """

    rules: Mapping[str, Rule]
    folders: tuple[str, ...] = ()
    built_in: frozenset[str] = frozenset()
    families: Mapping[str, frozenset[str]] = {}

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

    def match(self, selector: str) -> Match:
        """What a selector stands for: a code, a prefix of codes, a rule or family by name, or ALL.

        Raises UsageError if that is nothing.
        """
        wanted = selector.strip()
        prefix, name = wanted.upper(), wanted.lower()
        if prefix == "ALL":
            return Match(frozenset(self.rules), 0)
        codes = [code for code in self.rules if code.startswith(prefix)] if prefix else []
        if codes:
            return Match(frozenset(codes), len(prefix))
        by_name = {rule.name: code for code, rule in self.rules.items()}
        if name in by_name:
            return Match(frozenset({by_name[name]}), _WHOLE_CODE)
        if name in self.families:
            return Match(self.families[name], _LETTERS)
        prefixes = sorted({code[:_LETTERS] for code in self.rules})
        hint = did_you_mean(wanted, [*self.rules, *prefixes, "ALL", *by_name, *self.families])
        raise UsageError(f"{wanted!r} is no rule, no family and no beginning of a code{hint}")

    def expand(self, selector: str) -> frozenset[str]:
        """The codes that a selector stands for; raises UsageError if there are none."""
        return self.match(selector).codes


def load(packs: Sequence[str] = (), where: Mapping[str, str] = {}) -> Catalog:
    """The built-in rules, those of installed packs, and those of the folders `packs`.

    `where` has, by the real path of a folder, how messages name where it is said.
    Raises PackError for a pack that can't be loaded, or two rules of the same code or name.
    """
    found = find_packs(packs)
    built_in: frozenset[str] = frozenset()
    rules = {rule.code: rule for rule in ENGINE_RULES}
    names = {rule.name: rule for rule in ENGINE_RULES}
    families = {"lint": set(rules)}
    for package, folder in found:
        with _telling(where.get(folder)):
            for rule in import_rules(package, folder):
                _check_taken(folder, rule, rules.setdefault(rule.code, rule))
                _check_taken(folder, rule, names.setdefault(rule.name, rule))
                if family := _family(rule, package):
                    families.setdefault(family, set()).add(rule.code)
        built_in = built_in or frozenset(rules)  # the first pack is
    return Catalog(
        dict(sorted(rules.items())),
        tuple(folder for _, folder in found),
        built_in,
        {family: frozenset(codes) for family, codes in families.items()},
    )


@contextmanager
def _telling(where: str | None) -> Iterator[None]:
    """Says in a PackError where the pack is named."""
    try:
        yield
    except PackError as error:
        raise PackError(f"{where}: {error}") if where else error from error.__cause__


def _check_taken(folder: str, rule: Rule, other: Rule) -> None:
    """Raises PackError where another rule has the code or name of a rule."""
    if other is not rule:
        raise PackError(
            f"rule pack {folder!r}: {rule.code} ({rule.name}) takes the code or name of another "
            f"rule, {other.code} ({other.name})"
        )


def load_for(config: Config) -> Catalog:
    """The rules with the packs of a configuration; raises UsageError that says who names one."""
    for pack in config.packs:
        if not isdir(pack):
            where = config.origins.words("packs", pack)
            raise UsageError(
                f"{where}: there is no folder {quoted(pack)}, which is to be a rule pack"
            )
    words = config.origins.words
    return load(config.packs, {realpath(pack): words("packs", pack) for pack in config.packs})


def _family(rule: Rule, package: str) -> str:
    """The name of the folder of a pack that a rule lies in; "" if it lies in none."""
    folders = rule.check.__module__.removeprefix(f"{package}.").split(".")[:-1]
    return folders[-1].replace("_", "-").lower() if folders else ""
