"""The layers that a stage is composed of, and what USD could not compose."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.deferred import deferred
from usdvol_lint.facts.found import Wing

with deferred(globals()):
    from usdvol_lint.facts.layers import (
        clip_losses,
        composition,
        errors,
        instancing,
        prototypes,
        ranges,
        rates,
        retyping,
        selections,
        units,
        words,
    )
    from usdvol_lint.facts.usd import arcs, instances

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.clip_losses import ClipLosses
    from usdvol_lint.facts.layers.composition import Composition, CompositionError, MissingLayer
    from usdvol_lint.facts.layers.instancing import LostOverrides
    from usdvol_lint.facts.layers.misnamed import Misnamed
    from usdvol_lint.facts.layers.overs import Overs
    from usdvol_lint.facts.layers.prototypes import LostPrototype
    from usdvol_lint.facts.layers.ranges import TimeRange
    from usdvol_lint.facts.layers.rates import UnsaidRate
    from usdvol_lint.facts.layers.selections import WrongSelection
    from usdvol_lint.facts.layers.undefined import Undefined
    from usdvol_lint.facts.layers.units import UnlikeStage
    from usdvol_lint.facts.layers.unresolved import EmptyArc
    from usdvol_lint.facts.prims.retyped import Retyped
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.arcs import Arcs, Layered
    from usdvol_lint.facts.usd.clips import Clips
    from usdvol_lint.facts.usd.drawn import Drawn
    from usdvol_lint.facts.usd.kinds import PrimKinds


class Layers(Wing):
    """What USD could not compose, and what layers say of time, up axis and units."""

    def __init__(
        self,
        tables: Tables,
        stage: Any,
        clips: Clips,
        kinds: PrimKinds,
        overs: Overs,
        drawn: Drawn,
        frames: tuple[float, float] | None,
    ) -> None:
        super().__init__(tables)
        self._stage = stage
        self._clips = clips
        self._kinds = kinds
        self.overs = overs
        self._drawn = drawn
        self._frames = frames

    @property
    def missing(self) -> tuple[MissingLayer, ...]:
        """The layers that an arc or a clip set names, and that USD can't open."""
        return self.composition.missing_layers

    @property
    def empty_arcs(self) -> tuple[EmptyArc, ...]:
        """The references and payloads to prims that are not there."""
        return self.composition.empty_arcs

    def may_bring_ours(self, *names: str) -> bool:
        """Whether Volumes, fields or particle fields are on the stage, or names speak of them."""
        return self._has_ours or words.speak_of_ours(names)

    @cached_property
    def _has_ours(self) -> bool:
        return any(self.tables.prims(name) for name in schema.OURS)

    @property
    def errors(self) -> tuple[CompositionError, ...]:
        """All other composition errors."""
        return self.composition.errors

    @property
    def are_whole(self) -> bool:
        """Whether every arc could be followed and every payload was loaded."""
        return self.composition.is_whole

    def may_lack(self, prim: Any) -> bool:
        """Whether an arc that brings nothing may have opinions on a prim or those below it."""
        return self.composition.may_lack(prim)

    def may_lack_values(self, prim: Any, name: str = "") -> bool:
        """As `may_lack`, and value clips count too, which supply only values, such as of `name`."""
        may_be_lost = self._clips.are_authored or self._arcs.prims
        is_lost = may_be_lost and self.clip_losses.are_told(prim, name)
        is_lost = is_lost or self.overs.are_meant_for(prim, self.composition)
        return bool(is_lost or self.composition.may_lack_values(prim))

    @cached_property
    def clip_losses(self) -> ClipLosses:
        """The value clips that do not arrive at prims of ours."""
        return clip_losses.ClipLosses(
            self._stage, self.tables, self._clips, self._arcs, self.composition
        )

    @property
    def are_several(self) -> bool:
        """Whether anything but the root layer says something, value clips included."""
        return self._clips.are_authored or not self._arcs.is_one_layer

    @property
    def clips(self) -> Clips:
        """The value clips above prims of ours or on them."""
        return self._clips

    @property
    def layered(self) -> tuple[Layered, ...]:
        """The drawn prims that several specs make up."""
        return self._arcs.layered

    @property
    def retyped(self) -> tuple[Retyped, ...]:
        """The prims of which a stronger type hides that they are Volumes or fields, by path."""
        return tuple(self._retyped.values())

    def hides_ours(self, prim: Any) -> bool:
        """Whether SCH012 tells that a prim's type hides a Volume, field or particle field."""
        return (
            self.tables.tells("SCH012") and instances.in_prototype(prim).GetPath() in self._retyped
        )

    @property
    def lost_overrides(self) -> Iterator[LostOverrides]:
        """The overrides below instances that USD passes over, by the paths of the instances."""
        if self._stage.GetPrototypes():
            layered = self._arcs.layered
            yield from instancing.lost_overrides(
                self._stage, layered, self._kinds, self.tables.ours()
            )

    @cached_property
    def _retyped(self) -> dict[Any, Retyped]:
        if not self._arcs.layered:
            return {}
        return retyping.retyped_prims(self._arcs.layered, self._kinds)

    @property
    def undefined(self) -> Iterator[Undefined]:
        """The overs that take prims of ours off the stage, where that is probably a slip."""
        return self.overs.hiding(self.composition)

    @property
    def misnamed(self) -> tuple[Misnamed, ...]:
        """The overs whose opinions were probably meant for a sibling."""
        return self.overs.misnamed(self.composition)

    @property
    def wrong_selections(self) -> Iterator[WrongSelection]:
        """The selections of variants that are not there, in sets that have to do with us."""
        if self._arcs.prims:
            yield from selections.wrong_selections(
                self._arcs.prims, self._drawn, self._kinds, self.may_lack
            )

    @property
    def lost_prototypes(self) -> Iterator[LostPrototype]:
        """The targets of PointInstancers that are not there, where they concern us."""
        if self._drawn.live_instancers:
            yield from prototypes.lost_prototypes(
                self._stage, self._drawn, self._kinds, self.may_lack
            )

    @property
    def out_of_reach(self) -> Iterator[Any]:
        """The prims that PointInstancers target and no traversal reaches, and those below them."""
        return self._drawn.out_of_reach

    @cached_property
    def time_range(self) -> TimeRange | None:
        """The production's range, else startTimeCode to endTimeCode; None if these are not said."""
        return ranges.time_range(self.authored_time_range, self._frames)

    @cached_property
    def authored_time_range(self) -> tuple[float, float] | None:
        """startTimeCode and endTimeCode, in whatever order; None unless both are authored."""
        is_said, stage = self._stage.HasAuthoredTimeCodeRange(), self._stage
        return (stage.GetStartTimeCode(), stage.GetEndTimeCode()) if is_said else None

    @cached_property
    def unsaid_rates(self) -> tuple[UnsaidRate, ...]:
        """The layers that say no rate and whose samples the stage therefore has at other times."""
        if self._arcs.is_one_layer:
            return ()
        return rates.unsaid_rates(self._stage, self.tables, self._clips, self.time_range)

    def rate_is_unsaid(self, attribute: Any) -> bool:
        """Whether the samples of an attribute are at other times because no rate is said."""
        return any(unsaid.displaces(attribute) for unsaid in self.unsaid_rates)

    @cached_property
    def unlike_stage(self) -> tuple[UnlikeStage, ...]:
        """The layers that say another up axis or other units, and bring what nothing corrects."""
        if self._arcs.is_one_layer:
            return ()
        return units.layers_unlike_stage(self._stage, self.tables)

    @cached_property
    def _arcs(self) -> Arcs:
        return arcs.Arcs(self._stage, self._drawn)

    @cached_property
    def composition(self) -> Composition:
        """What USD could not compose, of which the properties here are part."""
        clipped: list[Any] = []
        for prims, authored in self.tables.authored(*schema.OURS):
            if authored.is_clipped:
                clipped += prims
        clip_sets = dict.fromkeys(chain.from_iterable(map(self._clips.reaching, clipped)))
        raised = self._stage.GetCompositionErrors()
        if not raised and not clip_sets:
            return composition.Composition((), (), (), composition.unloaded_prims(self._stage))
        return errors.read_composition(self._stage, raised, clip_sets)
