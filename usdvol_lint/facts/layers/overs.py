"""What the walk met below prims that nothing defines, and what of that is probably a slip."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any

from usdvol_lint.facts.usd.instances import in_prototype

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.composition import Composition
    from usdvol_lint.facts.layers.misnamed import Misnamed
    from usdvol_lint.facts.layers.undefined import Undefined
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.drawn import Drawn
    from usdvol_lint.facts.usd.kinds import PrimKinds


class Overs:
    """The overs of a stage that nothing defines."""

    def __init__(
        self,
        stage: Any,
        kinds: PrimKinds,
        tables: Tables,
        undefined: Mapping[Any, Sequence[Any]],
        overs: Sequence[Any],
        drawn: Drawn,
    ) -> None:
        """As the fields of `Walked` are."""
        self._stage = stage
        self._kinds = kinds
        self._tables = tables
        self._undefined = undefined
        self._overs = overs
        self._drawn = drawn
        self._misnamed: tuple[Misnamed, ...] | None = None

    @property
    def undrawn(self) -> Iterator[Any]:
        """The prims of ours that an `over` takes off the stage, also of libraries, and all that
        PointInstancers target in a `class`.
        """
        return chain(*self._undefined.values(), self._drawn.passed_over)

    def hiding(self, composition: Composition) -> Iterator[Undefined]:
        """The overs that take prims of ours off the stage, where that is probably a slip."""
        if not self._undefined:
            return iter(())
        from usdvol_lint.facts.layers.undefined import find_undefined

        may_lack = composition.may_lack
        return find_undefined(self._stage, self._undefined, self._tables.ours, may_lack)

    def misnamed(self, composition: Composition) -> tuple[Misnamed, ...]:
        """The overs whose opinions were probably meant for a sibling."""
        if not self._overs:
            return ()
        if self._misnamed is None:
            from usdvol_lint.facts.layers.misnamed import find_misnamed

            is_whole = composition.is_whole and not composition.errors
            told = self._undefined.keys() if self._tables.tells("STG005") else frozenset()
            found = find_misnamed(self._stage, self._kinds, self._drawn, self._overs, told)
            self._misnamed = tuple(found) if is_whole else ()
        return self._misnamed

    def are_meant_for(self, prim: Any, composition: Composition) -> bool:
        """Whether STG010 tells of an `over` that was probably meant for a prim."""
        if not self._overs or not self._tables.tells("STG010"):
            return False
        walked = in_prototype(prim)
        return any(walked in each.meant for each in self.misnamed(composition))
