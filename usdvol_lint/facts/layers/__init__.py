"""The layers that a stage is composed of, and what USD could not compose."""

from __future__ import annotations

from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.found import Wing

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.composition import Composition, CompositionError, MissingLayer
    from usdvol_lint.facts.layers.left_behind import LeftBehind
    from usdvol_lint.facts.layers.lost_clips import LostClips
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.clips import Clips


class Layers(Wing):
    """What USD could not compose, and the time range that the stage declares."""

    def __init__(self, tables: Tables, stage: Any, clips: Clips) -> None:
        super().__init__(tables)
        self._stage = stage
        self._clips = clips

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
        return self._composition.may_lack_values(prim) or prim in self._losing

    @cached_property
    def lost_clips(self) -> tuple[LostClips, ...]:
        """The value clips that USD does not use, though they hold values for prims of ours.

        Those are left out that a layer which failed to open may set right.
        """
        from usdvol_lint.facts.layers.lost_clips import find_lost_clips

        lost = find_lost_clips(self.tables, self._clips)
        return tuple(each for each in lost if not self._composition.may_lack_values(each.prim))

    @cached_property
    def clips_left_behind(self) -> tuple[LeftBehind, ...]:
        """The value clips of other layers that an arc leaves behind."""
        from usdvol_lint.facts.layers.left_behind import find_left_behind

        left = find_left_behind(self._stage, self.tables, self._clips)
        return tuple(each for each in left if not self._composition.may_lack_values(each.prim))

    @cached_property
    def _losing(self) -> frozenset[Any]:
        lost = [attribute for each in self.lost_clips for attribute in each.attributes]
        left = [attribute for each in self.clips_left_behind for attribute in each.attributes]
        return frozenset(attribute.GetPrim() for attribute in (*lost, *left))

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
