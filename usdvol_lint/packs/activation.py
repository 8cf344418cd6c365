"""Selects the active rules of a catalog, as a configuration says."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from usdvol_lint.config import Config
from usdvol_lint.config.values import strings
from usdvol_lint.model import Severity, UsageError
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.packs.catalog import NOT_IGNORABLE, Catalog
from usdvol_lint.packs.selection import check_unchecked, levels, options_rule, selected
from usdvol_lint.releases import is_later
from usdvol_lint.rule import NotChecked, Rule

_KINDS = {bool: "true or false", int: "a whole number", float: "a number", str: "a string"}


class ActiveRules(NamedTuple):
    """The severities of the active rules, and the options that were given, by code.

    `chosen` are the codes whose severity is not the rule's own but the user's, also for the milder
    cases that a rule tells apart.
    `softened` are the codes that the user made milder than they are on their own.
    `dated` are those of which what came after the release `as_of` is an info: built-in rules whose
    severity the user did not choose.
    `watching` are rules that are not in force and run all the same, so that it is said what they
    can't check; what they find is not.
    """

    severities: Mapping[str, Severity]
    options: Mapping[str, Mapping[str, Any]]
    chosen: frozenset[str] = frozenset()
    softened: frozenset[str] = frozenset()
    as_of: str | None = None
    dated: frozenset[str] = frozenset()
    watching: frozenset[str] = frozenset()

    @property
    def telling(self) -> frozenset[str]:
        """The codes in whose favour other rules are silent: those in force, unsoftened."""
        return frozenset(self.severities) - self.softened

    def is_younger(self, code: str, since: str | None) -> bool:
        """Whether what a rule sees since a release came too late to be more than an info."""
        if self.as_of is None or since is None or code not in self.dated:
            return False
        return is_later(since, self.as_of)


def activate(config: Config, catalog: Catalog) -> ActiveRules:
    """Resolves selection, severities and options against the catalog.

    Raises UsageError for unknown codes, names and options, and says where they stand.
    """
    codes = selected(config, catalog)
    watching: frozenset[str] = frozenset()
    if config.fail_on_unchecked:
        codes |= _of_unchecked(config, catalog)
        watching = _leaving_unchecked(catalog) - codes
    given = levels(config, catalog)
    severities = {code: given.get(code, catalog.rules[code].severity) for code in sorted(codes)}
    chosen = frozenset(given.keys() & codes)
    active = ActiveRules(severities, _options(config, catalog), chosen, watching=watching)
    return _dated(active, config.rules_as_of, catalog)


def _of_unchecked(config: Config, catalog: Catalog) -> frozenset[str]:
    """The codes that a run needs which fails for what was not checked."""
    for selector in config.ignore:
        check_unchecked(catalog.match(selector), selector, config.origins.words("ignore", selector))
    from usdvol_lint.results import UNCHECKED  # of no use to worker processes

    return UNCHECKED


def _leaving_unchecked(catalog: Catalog) -> frozenset[str]:
    """The rules of a run without any selection that may say that they could not check something."""
    rules = (rule for rule in catalog.rules.values() if rule.default)
    return frozenset(rule.code for rule in rules if _names_not_checked(rule))


def _names_not_checked(rule: Rule) -> bool:
    """Whether the module of a rule names `NotChecked`, without which no rule yields one."""
    return any(value is NotChecked for value in getattr(rule.check, "__globals__", {}).values())


def _dated(active: ActiveRules, as_of: str | None, catalog: Catalog) -> ActiveRules:
    """The same with infos of rules that are younger than `as_of`, and with what that softens."""
    # Whether the job was done is told whatever the version.
    dated = catalog.built_in - active.chosen - NOT_IGNORABLE if as_of else frozenset()
    active = active._replace(as_of=as_of, dated=dated)
    rules = catalog.rules
    severities = {
        code: Severity.INFO if active.is_younger(code, rules[code].since) else severity
        for code, severity in active.severities.items()
    }
    softened = {code for code in severities if severities[code] < rules[code].severity}
    return active._replace(severities=severities, softened=frozenset(softened))


def _options(config: Config, catalog: Catalog) -> dict[str, dict[str, Any]]:
    """The options that were given, by code; raises UsageError for those that no rule has."""
    options: dict[str, dict[str, Any]] = {}
    for name, given in config.options.items():
        rule = options_rule(config, catalog, name)
        for option, value in given.items():
            where = config.origins.words("options", f"{name}.{option}")
            checked = _checked_option(where, rule, option, value)
            options.setdefault(rule.code, {})[option] = checked
    return options


def _checked_option(where: str, rule: Rule, option: str, value: Any) -> Any:
    if option not in rule.options:
        hint = did_you_mean(option, rule.options)
        raise UsageError(f"{where}: {rule.name} has no option {option!r}{hint}")
    default = rule.options[option]
    if isinstance(default, tuple):
        return tuple(strings(where, value))
    kind = (int, float) if isinstance(default, float) else type(default)
    if not isinstance(value, kind) or isinstance(value, bool) != isinstance(default, bool):
        wanted = _KINDS.get(type(default), type(default).__name__)
        raise UsageError(f"{where} must be {wanted}, not {value!r}")
    return value
