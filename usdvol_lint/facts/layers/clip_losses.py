"""Value clips that hold what prims of ours lack, and that do not arrive there, for any reason."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeVar

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.layers.composition import Composition
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.arcs import Arcs
from usdvol_lint.facts.usd.clips import Clips
from usdvol_lint.facts.usd.instances import in_prototype

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.clip_bearers import ClippedPlace
    from usdvol_lint.facts.layers.left_behind import LeftBehind
    from usdvol_lint.facts.layers.lost_clips import LostClips
    from usdvol_lint.facts.layers.stopped_clips import StoppedClips
    from usdvol_lint.facts.layers.unlisted_clips import UnlistedClips

_Loss = TypeVar("_Loss", "LostClips", "LeftBehind", "StoppedClips", "UnlistedClips")


class ClipLosses:
    """The losses of a stage, without those that a layer which failed to open may set right."""

    def __init__(
        self, stage: Any, tables: Tables, clips: Clips, arcs: Arcs, composition: Composition
    ) -> None:
        self._stage = stage
        self._tables = tables
        self._clips = clips
        self._arcs = arcs
        self._composition = composition

    @cached_property
    def lost(self) -> tuple[LostClips, ...]:
        """The clips that USD does not use, though they hold values for prims of ours."""
        if not self._bearers:
            return ()
        from usdvol_lint.facts.layers.lost_clips import find_lost_clips

        return self._certain(find_lost_clips(self._tables, self._clips, self._bearers))

    @cached_property
    def left_behind(self) -> tuple[LeftBehind, ...]:
        """The clips of other layers that an arc leaves behind."""
        if not self._arcs.prims:
            return ()
        from usdvol_lint.facts.layers.left_behind import find_left_behind

        return self._certain(find_left_behind(self._stage, self._tables, self._clips))

    @cached_property
    def stopped(self) -> tuple[StoppedClips, ...]:
        """The clips on instances and above them, which do not reach into them."""
        if not self._places:
            return ()
        from usdvol_lint.facts.layers.stopped_clips import find_stopped

        return self._certain(find_stopped(self._stage, self._tables, self._places))

    @cached_property
    def unlisted(self) -> tuple[UnlistedClips, ...]:
        """The clips that hold what their manifest does not declare."""
        if not self._bearers:
            return ()
        from usdvol_lint.facts.layers.unlisted_clips import find_unlisted

        return self._certain(find_unlisted(self._tables, self._clips, self._bearers))

    @cached_property
    def _bearers(self) -> list[tuple[Any, list[Any]]]:
        """The prims with clip sets, each with those of ours that these are for."""
        if not self._clips.are_authored and not self._places:
            return []
        from usdvol_lint.facts.layers.clip_bearers import bearers_above, decided_bearers

        instanced = bearers_above(self._stage, self._places)
        return list(decided_bearers(self._tables, self._clips, instanced))

    @cached_property
    def _places(self) -> tuple[ClippedPlace, ...]:
        """Where clips stop at instances."""
        if not self._stage.GetPrototypes():
            return ()
        from usdvol_lint.facts.layers.clip_bearers import clipped_places

        return clipped_places(self._tables)

    def are_told(self, prim: Any, name: str) -> bool:
        """Whether AST016 tells of clips that the prim lacks, or AST014 of this attribute of it.

        `name` is that of the float array where there is one of halves too.
        """
        tells = self._tables.tells
        if tells("AST016") and prim in self._prims:
            return True
        return (prim, name) in self._unlisted_names and tells("AST014")

    @cached_property
    def _unlisted_names(self) -> frozenset[tuple[Any, str]]:
        attributes = chain.from_iterable(each.attributes for each in self.unlisted)
        return frozenset(
            (in_prototype(each.GetPrim()), name)
            for each in attributes
            for name in (each.GetName(), each.GetName().removesuffix("h"))
        )

    @cached_property
    def _prims(self) -> frozenset[Any]:
        """The prims that lack what the clips hold."""
        losses: tuple[Any, ...] = (*self.lost, *self.left_behind, *self.stopped)
        attributes = chain.from_iterable(each.attributes for each in losses)
        return frozenset(in_prototype(each.GetPrim()) for each in attributes)

    def _certain(self, losses: Iterable[_Loss]) -> tuple[_Loss, ...]:
        return tuple(each for each in losses if not self._composition.may_lack_values(each.prim))
