"""What the tables `[[per-path]]` of a configuration make of findings, by the layer to blame."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import NamedTuple, TypeAlias

from usdvol_lint.config import Config
from usdvol_lint.config.per_path import PerPath
from usdvol_lint.model import Severity, Source
from usdvol_lint.packs.catalog import Catalog, Match
from usdvol_lint.packs.selection import by_code, check_unchecked, chosen, ignored_by
from usdvol_lint.run.suppressing import Matcher, of_layers
from usdvol_lint.words import quoted

_KEPT = 4096
"""How many answers are kept."""

Verdict: TypeAlias = Severity | str
"""The severity of a rule, or why its findings are ignored."""
VerdictOn: TypeAlias = Callable[[str, Source], Verdict | None]
"""What becomes of a finding of a code with that source; None where it stays as it is."""


class _Table(NamedTuple):
    matches: Matcher | None
    verdicts: Mapping[str, Verdict]


def verdicts(config: Config, catalog: Catalog) -> VerdictOn | None:
    """What becomes of findings by their layer; None where nothing is said of any.

    Of several tables that match, the last that names the rule counts.
    Raises UsageError where a table names rules that there are not, or that stay errors.
    """
    tables = [_table(each, catalog, config) for each in reversed(config.per_path)]
    if not tables:
        return None

    @lru_cache(_KEPT)
    def verdict_on(code: str, layer: str) -> Verdict | None:
        found = (table.verdicts[code] for table in tables if _holds(table, code, layer))
        return next(found, None)

    # No pattern matches the empty text, which stands for no layer.
    return lambda code, source: verdict_on(code, source.layer or "")


def _holds(table: _Table, code: str, layer: str) -> bool:
    return code in table.verdicts and (table.matches is None or table.matches(layer))


def _table(table: PerPath, catalog: Catalog, config: Config) -> _Table:
    """The table by code; where one is both ignored and has a severity, the more exact counts."""
    where = f"{table.where}: ignore"
    reason = f"ignored by per-path for {', '.join(map(quoted, table.files))}"
    ignored = [(_ignored(selector, catalog, where, config), reason) for selector in table.ignore]
    levels = chosen(table.severity, catalog, lambda name: f"{table.where}: severity.{name}")
    heeded = ignored if config.suppressions != "none" else []
    return _Table(of_layers(table.files), by_code([*levels, *heeded]))


def _ignored(selector: str, catalog: Catalog, where: str, config: Config) -> Match:
    """What a table takes out; nothing that says of something that it was not checked."""
    match = ignored_by(selector, catalog, where)
    return check_unchecked(match, selector, where) if config.fail_on_unchecked else match
