"""The layers that a stage is composed of, and what USD could not compose."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.found import Wing

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.composition import Composition, CompositionError, MissingLayer
    from usdvol_lint.facts.layers.instancing import LostOverrides
    from usdvol_lint.facts.layers.retyping import Retyped
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.arcs import Layered
    from usdvol_lint.facts.usd.clips import Clips
    from usdvol_lint.facts.usd.kinds import PrimKinds


class Layers(Wing):
    """What USD could not compose, and the time range that the stage declares."""

    def __init__(self, tables: Tables, stage: Any, clips: Clips, kinds: PrimKinds) -> None:
        super().__init__(tables)
        self._stage = stage
        self._clips = clips
        self._kinds = kinds

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
    def retyped(self) -> tuple[Retyped, ...]:
        """The prims of which a stronger type hides that they are Volumes or fields, by path."""
        return tuple(self._retyped.values())

    def hides_ours(self, prim: Any) -> bool:
        """Whether the type of a prim hides that it is a Volume, field or particle field."""
        from usdvol_lint.facts.usd.instances import in_prototype

        return in_prototype(prim).GetPath() in self._retyped

    @property
    def lost_overrides(self) -> Iterator[LostOverrides]:
        """The overrides below instances that USD passes over, by the paths of the instances."""
        if self._stage.GetPrototypes():
            from usdvol_lint.facts.layers.instancing import lost_overrides

            ours = chain.from_iterable(map(self.tables.prims, sorted(schema.OURS)))
            yield from lost_overrides(self._stage, self._layered, self._kinds, ours)

    @cached_property
    def _layered(self) -> tuple[Layered, ...]:
        from usdvol_lint.facts.usd.arcs import layered_prims

        return tuple(layered_prims(self._stage))

    @cached_property
    def _retyped(self) -> dict[Any, Retyped]:
        from usdvol_lint.facts.layers.retyping import retyped_prims

        return retyped_prims(self._layered, self._kinds)

    @cached_property
    def time_range(self) -> tuple[float, float] | None:
        """startTimeCode and endTimeCode; None unless both are authored, in ascending order."""
        authored = self.authored_time_range
        return authored if authored and authored[0] <= authored[1] else None

    @cached_property
    def authored_time_range(self) -> tuple[float, float] | None:
        """startTimeCode and endTimeCode, in whatever order; None unless both are authored."""
        if not self._stage.HasAuthoredTimeCodeRange():
            return None
        return self._stage.GetStartTimeCode(), self._stage.GetEndTimeCode()

    @cached_property
    def _composition(self) -> Composition:
        from usdvol_lint.facts.layers.composition import read_composition

        clipped: list[Any] = []
        for prims, authored in self.tables.authored(*schema.OURS):
            if authored.is_clipped:
                clipped += prims
        clip_sets = chain.from_iterable(map(self._clips.reaching, clipped))
        return read_composition(self._stage, dict.fromkeys(clip_sets))
