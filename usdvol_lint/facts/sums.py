"""What sums prims up for rules that are handed only some of them: see `usdvol_lint.rule.When`."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import TYPE_CHECKING

from usdvol_lint import schema

if TYPE_CHECKING:
    from usdvol_lint.facts import Facts
    from usdvol_lint.facts.prims.tables import Table


class Sums:
    """One method for each fact that rules go by: what it gives for each prim of a table."""

    def __init__(self, facts: Facts) -> None:
        self._facts = facts

    def authored(self, table: Table) -> Iterable[Hashable]:
        """What is authored, and what the schemas declare of it."""
        return [table.authored] * len(table.prims)

    def is_mistyped(self, table: Table) -> Iterable[bool]:
        """Whether some spec may have another type than the schema declares."""
        from usdvol_lint.facts.prims.attributes import may_be_mistyped

        return may_be_mistyped(table.usd, table.authored)

    def has_odd_tokens(self, table: Table) -> Iterable[bool]:
        """Whether some token may be one that the schema does not allow."""
        from usdvol_lint.facts.prims.attributes import may_have_unlisted

        return may_have_unlisted(table.usd, table.authored)

    def is_strange(self, table: Table) -> Iterable[bool]:
        """Whether a prim has properties that no schema declares, or is of no type of ours."""
        authored = table.authored
        is_foreign = schema.OURS.isdisjoint(authored.schemas)
        return [is_foreign or bool(authored.strange)] * len(table.prims)

    def file_path_marks(self, table: Table) -> Iterable[Hashable]:
        """The states of the values of `filePath`, and what is remarkable about them."""
        facts = self._facts
        return facts.path_marks.of(facts.each(table, "filePath"), table.authored)

    def claims(self, table: Table) -> Iterable[Hashable]:
        """What a field says of the content of its files."""
        return self._facts.each(table, ":claims")

    def content_kinds(self, table: Table) -> Iterable[Hashable]:
        """The kinds of what is inside the files that a field names."""
        contents = self._facts.each(table, ":contents")
        return [tuple([kind for kind, _ in held.kinds]) for held in contents]

    def binding_marks(self, table: Table) -> Iterable[Hashable]:
        """What is remarkable about what the `field:` namespace of a Volume binds."""
        return [bound.marks for bound in self._facts.each(table, ":bound")]

    def has_odd_extent(self, table: Table) -> Iterable[bool]:
        """Whether some authored `extent` is no box."""
        return [limits.are_odd for limits in self._facts.each(table, ":limits")]

    def is_nested(self, table: Table) -> Iterable[bool]:
        """Whether there is a Gprim above or below."""
        return self._facts.nesting.are_likely(table.usd)

    def overhang(self, table: Table) -> Iterable[float]:
        """How far grids may reach out of the extent, in relation to their largest coordinate."""
        return self._facts.overhangs(table)
