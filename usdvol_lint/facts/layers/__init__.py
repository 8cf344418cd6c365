"""The layers that a stage is composed of, and what could not be composed."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.found import Wing

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.composition import Composition, CompositionError, MissingLayer
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.clips import Clips


class Layers(Wing):
    """What USD could not compose of the stage, and what the root layer says of its time."""

    def __init__(self, tables: Tables, stage: Any, clips: Clips) -> None:
        super().__init__(tables)
        self._stage = stage
        self._clips = clips

    @property
    def missing(self) -> tuple[MissingLayer, ...]:
        """The layers that an arc or a clip set names and USD can't open."""
        return self._composition.missing_layers

    @property
    def errors(self) -> tuple[CompositionError, ...]:
        """Every other composition error."""
        return self._composition.errors

    @property
    def unloaded(self) -> tuple[Any, ...]:
        """The prims with payloads that were not loaded."""
        return self._composition.unloaded

    @property
    def are_whole(self) -> bool:
        """Whether every layer that an arc names was there and loaded."""
        return self._composition.is_whole

    def may_lack(self, prim: Any) -> bool:
        """Whether a layer that does not open may say something about a prim and what is below."""
        return self._composition.may_lack(prim)

    def may_lack_values(self, prim: Any) -> bool:
        """The same, counting value clips too, which supply only values of attributes."""
        return self._composition.may_lack_values(prim)

    @cached_property
    def time_range(self) -> tuple[float, float] | None:
        """The stage's startTimeCode and endTimeCode, where both are authored and in this order."""
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
        clip_sets = dict.fromkeys(found for prim in clipped for found in self._clips.reaching(prim))
        return read_composition(self._stage, clip_sets)
