"""The types that rules ask for, held against the schemas that are installed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from pxr import Tf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.kinds import is_registered
from usdvol_lint.model import PackError
from usdvol_lint.nearest import did_you_mean, is_one_slip_from
from usdvol_lint.rule import NotChecked, Rule

_OURS = frozenset({*schema.TYPE_BASES, *schema.API_INCLUDES})
_NO_SCHEMAS = frozenset({schema.STAGE, schema.UNKNOWN_TYPE, schema.ABSTRACT_TYPE})


def check_types(rules: Iterable[Rule]) -> None:
    """Raises PackError for a rule that asks for a type by a misspelt name, or by that of a class.

    Other names that nobody knows may be those of a plugin, which is not installed everywhere.
    """
    for rule in rules:
        for name in filter(_is_unknown, rule.on):
            meant = _schema_of_class(name) or _misspelt(name)
            if meant:
                raise PackError(
                    f"rule {rule.code} ({rule.name}) is on {name!r}, which no schema is called; "
                    f"did you mean {meant!r}?"
                )


class IdleRule(NamedTuple):
    """A rule some of whose types, the `unknown` ones, no schema that is installed here has."""

    rule: Rule
    unknown: tuple[str, ...]

    def told_at(self, root: Any) -> NotChecked:
        """What to say of it on a stage with that root."""
        rule, unknown = self
        types = " or ".join(map(repr, unknown))
        looked = "nothing" if len(unknown) == len(rule.on) else "less than it asks for"
        return NotChecked(
            f"rule {rule.code} ({rule.name}) looked at {looked}: no schema that is "
            f"installed here is called {types}",
            at=root,
            machine=rule.code,
            suggestion="install the plugin that has it, or correct the rule"
            + did_you_mean(unknown[0], _names()),
        )


def idle_rules(rules: Iterable[Rule]) -> Iterator[IdleRule]:
    """The rules some of whose types are unknown here, which is so for all stages."""
    for rule in rules:
        if unknown := tuple(filter(_is_unknown, rule.on)):
            yield IdleRule(rule, unknown)


def _is_unknown(name: str) -> bool:
    return name not in _OURS and name not in _NO_SCHEMAS and not is_registered(name)


def _schema_of_class(name: str) -> str:
    """The name that a schema has in layers, if this is the name of its class: `UsdVolVolume`."""
    found = Tf.Type.FindByName(name)
    return "" if found.isUnknown else str(Usd.SchemaRegistry.GetSchemaTypeName(found))


def _misspelt(name: str) -> str | None:
    return next((other for other in _names() if is_one_slip_from(name, other)), None)


def _names() -> list[str]:
    """The names of all schemas that are installed, and of ours."""
    types = Tf.Type.FindByName("UsdSchemaBase").GetAllDerivedTypes()
    return sorted(_OURS.union(map(Usd.SchemaRegistry.GetSchemaTypeName, types)) - {""})
