"""Which rules of a catalog are in force, and at which severity, as a configuration says."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import TypeVar

from usdvol_lint.config import Config
from usdvol_lint.model import Severity, UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE, Catalog, Match
from usdvol_lint.rule import Rule

T = TypeVar("T")


def selected(config: Config, catalog: Catalog) -> frozenset[str]:
    """The codes of active rules; where `select` and `ignore` both match, the more exact wins.

    Raises UsageError for what is no selector, and for an `ignore` of what can't be ignored.
    """
    dropped = _ranks(_ignored(config, catalog, still_ignored(config, catalog)))
    if config.select is None:
        wanted = {code: 0 for code, rule in catalog.rules.items() if rule.default}
    else:
        wanted = _ranks(_matches(config, catalog, "select", config.select).values())
    on = {code for code, rank in wanted.items() if rank > dropped.get(code, -1)}
    return frozenset(on) | NOT_IGNORABLE


def still_ignored(config: Config, catalog: Catalog) -> tuple[str, ...]:
    """What is ignored, without what is selected by just that on top of it."""
    if not config.select or not config.ignore:
        return config.ignore
    depth = config.origins.depth
    matches = _matches(config, catalog, "select", config.select)
    above = {match.codes: depth("select", selector) for selector, match in matches.items()}
    ignored = _matches(config, catalog, "ignore", config.ignore)

    def is_taken_back(selector: str) -> bool:
        own = depth("ignore", selector)
        return above.get(ignored[selector].codes, own) < own

    return tuple(selector for selector in config.ignore if not is_taken_back(selector))


def levels(config: Config, catalog: Catalog) -> dict[str, Severity]:
    """The severities that a configuration chooses, by code; the more exact selector wins.

    Raises UsageError for what is no selector, and for what stays an error.
    """
    return by_code(chosen(config.severity, catalog, partial(config.origins.words, "severity")))


def chosen(
    table: Mapping[str, str], catalog: Catalog, where: Callable[[str], str]
) -> Iterator[tuple[Match, Severity]]:
    """What each selector of a table of severities chooses for what.

    `where` says how messages name where a selector stands.
    """
    for selector, level in table.items():
        match = named(catalog.match, selector, where(selector))
        if match.not_ignorable:
            said = f"{selector} stays an error: it says that the job was not done"
            raise UsageError(f"{where(selector)}: {said}")
        yield match._replace(codes=match.codes - NOT_IGNORABLE), Severity[level.upper()]


def by_code(choices: Iterable[tuple[Match, T]]) -> dict[str, T]:
    """What is chosen for each code: by the most exact selector, and of such the last one."""
    found: dict[str, T] = {}
    for match, choice in sorted(choices, key=lambda pair: pair[0].rank):
        found.update(dict.fromkeys(match.codes, choice))
    return found


def ignored_by(selector: str, catalog: Catalog, where: str) -> Match:
    """What a selector takes out; raises UsageError, which `where` begins, if it can't do that."""
    match = named(catalog.match, selector, where)
    if match.not_ignorable:
        raise UsageError(f"{where}: {selector} can't be ignored: it says that the job was not done")
    return match._replace(codes=match.codes - NOT_IGNORABLE)


def check_unchecked(match: Match, selector: str, where: str) -> Match:
    """The same without the codes that say that something was not checked.

    Raises UsageError, which `where` begins, for a selector that means nothing else.
    """
    from usdvol_lint.results import UNCHECKED  # few runs fail for what was not checked

    if match.codes <= UNCHECKED:
        said = f"{selector} can't be ignored with --fail-on-unchecked: leave one out"
        raise UsageError(f"{where}: {said}")
    return match._replace(codes=match.codes - UNCHECKED)


def options_rule(config: Config, catalog: Catalog, name: str) -> Rule:
    """The rule whose options stand below a name; raises UsageError if there is none."""
    return named(catalog.find, name, config.origins.words("options", name))


def named(find: Callable[[str], T], name: str, where: str) -> T:
    """What a catalog finds by a name; a UsageError says where that stands."""
    try:
        return find(name)
    except UsageError as error:
        raise UsageError(f"{where}: {error}") from None


def _matches(
    config: Config, catalog: Catalog, key: str, selectors: Iterable[str]
) -> dict[str, Match]:
    words = config.origins.words
    return {name: named(catalog.match, name, words(key, name)) for name in selectors}


def _ignored(config: Config, catalog: Catalog, selectors: Iterable[str]) -> list[Match]:
    words = config.origins.words
    return [ignored_by(name, catalog, words("ignore", name)) for name in selectors]


def _ranks(matches: Iterable[Match]) -> dict[str, int]:
    """How exactly each code is meant at most."""
    ranks: dict[str, int] = {}
    for match in matches:
        for code in match.codes:
            ranks[code] = max(match.rank, ranks.get(code, 0))
    return ranks
