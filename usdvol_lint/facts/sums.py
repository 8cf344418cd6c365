"""What sums prims up for rules that are handed only some of them: see `usdvol_lint.rule.When`."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema

if TYPE_CHECKING:
    from usdvol_lint.facts import Facts


class Sums:
    """One method for each fact that rules go by: what it gives for each of many prims, in order.

    Prims of one kind are taken many at once, since USD answers one question about many prims in
    half the time of many questions about each.
    """

    def __init__(self, facts: Facts) -> None:
        self._facts = facts

    def authored(self, prims: Sequence[Any]) -> Iterable[Hashable]:
        """What is authored, and what the schemas declare of it."""
        return self._facts.each(prims, ":authored")

    def is_mistyped(self, prims: Sequence[Any]) -> Iterable[bool]:
        """Whether some spec may have another type than the schema declares."""
        from usdvol_lint.facts.attributes import may_be_mistyped

        return may_be_mistyped(prims, self._facts.each(prims, ":authored"))

    def has_odd_tokens(self, prims: Sequence[Any]) -> Iterable[bool]:
        """Whether some token may be one that the schema does not allow."""
        from usdvol_lint.facts.attributes import may_have_unlisted

        return may_have_unlisted(prims, self._facts.each(prims, ":authored"))

    def is_strange(self, prims: Sequence[Any]) -> Iterable[bool]:
        """Whether a prim has properties that no schema declares, or is of no type of ours."""
        kinds = self._facts.kinds
        if schema.OURS.isdisjoint(kinds.names(kinds.key(prims[0]))):
            return [True] * len(prims)
        return [bool(authored.strange) for authored in self._facts.each(prims, ":authored")]

    def file_path_marks(self, fields: Sequence[Any]) -> Iterable[Hashable]:
        """The states of the values of `filePath`, and what is remarkable about them."""
        facts = self._facts
        return facts.path_marks.of(facts.each(fields, "filePath"), facts.each(fields, ":authored"))

    def claims(self, fields: Sequence[Any]) -> Iterable[Hashable]:
        """What a field says of the content of its files."""
        return self._facts.each(fields, ":claims")

    def content_kinds(self, fields: Sequence[Any]) -> Iterable[Hashable]:
        """The kinds of what is inside the files that a field names."""
        contents = self._facts.each(fields, ":contents")
        return [tuple(kind for kind, _ in held.kinds) for held in contents]

    def binding_marks(self, volumes: Sequence[Any]) -> Iterable[Hashable]:
        """What is remarkable about what the `field:` namespace of a Volume binds."""
        bindings = self._facts.each(volumes, ":fields")
        return [each.marks(volume) for each, volume in zip(bindings, volumes, strict=True)]

    def has_odd_extent(self, prims: Sequence[Any]) -> Iterable[bool]:
        """Whether some authored `extent` is no box."""
        return [limits.are_odd for limits in self._facts.each(prims, ":limits")]

    def is_nested(self, prims: Sequence[Any]) -> Iterable[bool]:
        """Whether there is a Gprim above or below."""
        nesting = self._facts.nesting
        return [nesting.is_likely(prim) for prim in prims]

    def overhang(self, volumes: Sequence[Any]) -> Iterable[float]:
        """How far grids may reach out of the extent, in relation to their largest coordinate."""
        facts = self._facts
        facts.each(volumes, ":fields")  # in one go, before each Volume is asked for its own
        enclosure = facts.enclosure
        return [
            enclosure.overhang(facts.standing(volume)) if limits.are_authored else 0.0
            for volume, limits in zip(volumes, facts.each(volumes, ":limits"), strict=True)
        ]
