"""What a configuration takes out of a run by its tables, and why."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import NamedTuple, TypeAlias

from usdvol_lint.config import Config
from usdvol_lint.model import Finding, Source
from usdvol_lint.packs.catalog import NOT_IGNORABLE, Catalog
from usdvol_lint.packs.selection import ignored_by
from usdvol_lint.paths import below, canonical
from usdvol_lint.suppressions import InStages, Suppression, matching
from usdvol_lint.words import quoted

ReasonFor: TypeAlias = Callable[[str, Finding, Source], str | None]
"""Why a finding on a stage, at this path, is suppressed; the source is that of its cause."""

_KEPT = 4096
"""How many answers of a pattern are kept: neighbours ask for the same layer, stage and prim."""

Matcher: TypeAlias = Callable[[str], bool]


class _Table(NamedTuple):
    """A table that is in force; None stands for all codes, layers, stages and prims."""

    reason: str
    codes: frozenset[str] | None
    layer: Matcher | None
    stage: Matcher | None
    prim: Matcher | None

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
        of_layers(table.files),
        _matcher(table.stages),
        _matcher(table.prims),
    )


def _codes(table: Suppression, catalog: Catalog) -> frozenset[str] | None:
    if not table.rules:
        return None
    where = f"{table.where}: rules"
    return frozenset().union(*(ignored_by(name, catalog, where).codes for name in table.rules))


def _matcher(patterns: tuple[str, ...]) -> Matcher | None:
    return lru_cache(_KEPT)(matching(patterns)) if patterns else None


def of_layers(patterns: tuple[str, ...]) -> Matcher | None:
    """Whether a layer, named in relation to the root, is meant; None if all are.

    A layer in a package matches where it does, or its package.
    """
    matches = _matcher(patterns)
    if matches is None:
        return None
    return lambda layer: matches(layer) or matches(layer.partition("[")[0])
