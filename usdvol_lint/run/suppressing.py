"""What the tables `[[suppress]]` of a configuration take out of a run, and why."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from typing import NamedTuple, TypeAlias

from usdvol_lint.config import Config
from usdvol_lint.model import Finding, Source, UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE, Catalog
from usdvol_lint.paths import below, canonical
from usdvol_lint.suppressions import InStages, Suppression, matching
from usdvol_lint.words import quoted

ReasonFor: TypeAlias = Callable[[str, Finding, Source], str | None]
"""Why a finding on a stage, at this path, is suppressed; the source is that of its cause."""

_KEPT = 4096
"""How many answers of a pattern are kept: neighbours ask for the same layer, stage and prim."""

_Matcher: TypeAlias = Callable[[str], bool]


class _Table(NamedTuple):
    """A table that is in force; None stands for all codes, layers, stages and prims."""

    reason: str
    codes: frozenset[str] | None
    layer: _Matcher | None
    stage: _Matcher | None
    prim: _Matcher | None

    def takes(self, stage: str, finding: Finding, source: Source) -> bool:
        """Whether a finding on a stage, named as layers are, is meant."""
        # No pattern matches the empty text, which stands for no layer and no prim.
        return (
            (self.codes is None or finding.code in self.codes)
            and (self.layer is None or self.layer(source.layer or ""))
            and (self.stage is None or self.stage(stage))
            and (self.prim is None or self.prim(finding.site.prim or ""))
        )


def reasons(config: Config, catalog: Catalog, root: str | None) -> ReasonFor | None:
    """Why findings are suppressed, the first table counts; None where nothing is.

    Raises UsageError where a table names rules that there are not, or that can't be ignored.
    """
    codes = {each: _codes(each, catalog) for each in config.suppress}
    tables = [_table(each, codes[each]) for each in _in_force(config)]
    if not tables:
        return None

    @lru_cache(_KEPT)
    def name_of(stage: str) -> str:
        return below(canonical(stage), root)

    def reason_for(path: str, finding: Finding, source: Source) -> str | None:
        if finding.code in NOT_IGNORABLE:
            return None
        stage = name_of(path)
        return next((each.reason for each in tables if each.takes(stage, finding, source)), None)

    return reason_for


def in_stages(config: Config) -> InStages:
    """How worker processes take the suppressions in stages."""
    return InStages(
        heeded=config.suppressions == "all",
        unused="unused" in config.show,
        today=config.today,
        prims=tuple(dict.fromkeys(each.prims for each in _in_force(config) if each.prims)),
    )


def expired(config: Config) -> Iterator[str]:
    """A line for each table that does not hold any more."""
    for table in config.suppress:
        if config.suppressions != "none" and table.is_over(config.today):
            yield f"{table.where}: was until {table.until}, which is over: {quoted(table.reason)}"


def _in_force(config: Config) -> list[Suppression]:
    if config.suppressions == "none":
        return []
    return [each for each in config.suppress if not each.is_over(config.today)]


def _table(table: Suppression, codes: frozenset[str] | None) -> _Table:
    return _Table(
        table.reason,
        codes,
        _of_layers(table.files),
        _matcher(table.stages),
        _matcher(table.prims),
    )


def _codes(table: Suppression, catalog: Catalog) -> frozenset[str] | None:
    if not table.rules:
        return None
    return frozenset().union(*(_expanded(table.where, name, catalog) for name in table.rules))


def _expanded(where: str, selector: str, catalog: Catalog) -> Iterable[str]:
    """The codes that a code, a prefix of codes, ALL, or the name of a rule stands for."""
    by_name = {rule.name: code for code, rule in catalog.rules.items()}
    named = by_name.get(selector.strip().lower(), selector)
    if named.strip().upper() in NOT_IGNORABLE:
        raise UsageError(f"{where}: {selector} can't be ignored: it says that the job was not done")
    try:
        return catalog.expand(named) - NOT_IGNORABLE
    except UsageError as error:
        raise UsageError(f"{where}: rules: {error}") from error


def _matcher(patterns: tuple[str, ...]) -> _Matcher | None:
    return lru_cache(_KEPT)(matching(patterns)) if patterns else None


def _of_layers(patterns: tuple[str, ...]) -> _Matcher | None:
    """A layer in a package matches where it does, or its package."""
    matches = _matcher(patterns)
    if matches is None:
        return None
    return lambda layer: matches(layer) or matches(layer.partition("[")[0])
