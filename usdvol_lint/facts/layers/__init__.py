"""The layers that a stage is composed of, and what USD could not compose."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.found import Wing

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.composition import Composition, CompositionError, MissingLayer
    from usdvol_lint.facts.layers.undefined import Undefined
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.clips import Clips


class Layers(Wing):
    """What USD could not compose, and the time range that the stage declares."""

    def __init__(
        self,
        tables: Tables,
        stage: Any,
        clips: Clips,
        undefined: Mapping[Any, Sequence[Any]],
    ) -> None:
        """`undefined`: by an `over`, the prims of our types that it takes off the stage."""
        super().__init__(tables)
        self._stage = stage
        self._clips = clips
        self._undefined = undefined

    @property
    def missing(self) -> tuple[MissingLayer, ...]:
        """The layers that an arc or a clip set names, and that USD can't open."""
        return self._composition.missing_layers

    @property
    def errors(self) -> tuple[CompositionError, ...]:
        """All other composition errors."""
        return self._composition.errors

    @property
    def unloaded(self) -> tuple[Any, ...]:
        """The prims with payloads that were not loaded."""
        return self._composition.unloaded

    @property
    def are_whole(self) -> bool:
        """Whether every layer that an arc names could be opened and was loaded."""
        return self._composition.is_whole

    def may_lack(self, prim: Any) -> bool:
        """Whether a layer that failed to open may have opinions on a prim or those below it."""
        return self._composition.may_lack(prim)

    def may_lack_values(self, prim: Any) -> bool:
        """As `may_lack`, and value clips count too, which supply only attribute values."""
        return self._composition.may_lack_values(prim)

    @property
    def undefined(self) -> Iterator[Undefined]:
        """The overs that take prims of ours off the stage, where that is probably a slip."""
        if not self._undefined:
            return iter(())
        from usdvol_lint.facts.layers.undefined import find_undefined

        return find_undefined(self._stage, self._undefined, self._drawn, self.may_lack)

    @property
    def undefined_prims(self) -> Iterator[Any]:
        """The prims of ours that an `over` takes off the stage, also of libraries."""
        return chain.from_iterable(self._undefined.values())

    def _drawn(self) -> Iterator[Any]:
        return chain.from_iterable(map(self.tables.prims, schema.OURS))

    @cached_property
    def time_range(self) -> tuple[float, float] | None:
        """startTimeCode and endTimeCode; None unless both are authored, in ascending order."""
        if not self._stage.HasAuthoredTimeCodeRange():
            return None
        start, end = self._stage.GetStartTimeCode(), self._stage.GetEndTimeCode()
        return (start, end) if start <= end else None

    @cached_property
    def _composition(self) -> Composition:
        from usdvol_lint.facts.layers.composition import read_composition

        clipped: list[Any] = []
        for prims, authored in self.tables.authored(*schema.OURS):
            if authored.is_clipped:
                clipped += prims
        clip_sets = chain.from_iterable(map(self._clips.reaching, clipped))
        return read_composition(self._stage, dict.fromkeys(clip_sets))
