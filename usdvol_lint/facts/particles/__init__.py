"""Facts about particle fields: their APIs, arrays, extents and colour spaces."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.deferred import deferred
from usdvol_lint.facts.found import Wing, fact

with deferred(globals()):
    from usdvol_lint.facts.particles import (
        apis,
        coarseness,
        colour_spaces,
        copies,
        extent,
        hiding,
        misfits,
        numbers,
        raw,
        reach,
        reading,
        scales,
        statistics,
        unseen,
    )
    from usdvol_lint.facts.prims import retyped

if TYPE_CHECKING:
    from usdvol_lint.config import Depth
    from usdvol_lint.facts.particles.apis import Loss, ParticleApis
    from usdvol_lint.facts.particles.array import ParticleArray
    from usdvol_lint.facts.particles.arrays import ParticleArrays
    from usdvol_lint.facts.particles.chunks import Row
    from usdvol_lint.facts.particles.coarseness import CoarsePositions
    from usdvol_lint.facts.particles.colour_spaces import ColourSpace
    from usdvol_lint.facts.particles.copies import Copies
    from usdvol_lint.facts.particles.elements import Elements
    from usdvol_lint.facts.particles.extent import OutsideExtent
    from usdvol_lint.facts.particles.misfits import MisfitArrays
    from usdvol_lint.facts.particles.raw import RawNumbers
    from usdvol_lint.facts.particles.reach import KernelsOutside
    from usdvol_lint.facts.particles.scales import Scales
    from usdvol_lint.facts.particles.unseen import Unseen
    from usdvol_lint.facts.prims import Prims
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.kinds import PrimKinds
    from usdvol_lint.model import ParticleFieldStats


class Particles(Wing):
    """The facts about particle fields.

    `depth` says which time samples are read, and whether histograms are made of them;
    `advance` is called with the number of samples that were read.
    """

    def __init__(
        self,
        tables: Tables,
        kinds: PrimKinds,
        prims: Prims,
        depth: Depth,
        advance: Callable[[int], None],
    ) -> None:
        super().__init__(tables)
        self._kinds = kinds
        self._prims = prims
        self._depth = depth
        self._advance = advance

    @fact
    def apis(self, prim: Any) -> ParticleApis:
        """The applied APIs of a prim, those that are not registered too."""
        return apis.read_particle_apis(prim, self._kinds, self._prims, self.tables.tells)

    def loss(self, prim: Any, names: Iterable[str]) -> Loss:
        """What a prim lacks because APIs of these names are not applied."""
        return apis.loss(prim, self.apis(prim), names)

    def without_api(self, prim: Any) -> Iterator[tuple[str, list[Any]]]:
        """The APIs that are not applied though attributes of theirs are authored, with these."""
        if self._is_retyped(prim):
            return iter(())
        return apis.attributes_without_api(prim, self.apis(prim), self.tables.tells)

    def is_told_elsewhere(self, prim: Any, base: str) -> bool:
        """Whether PRT006, PRT009, PRT010 or SCH012 tells why a base API is missing."""
        is_lost = self.apis(prim).is_lost(base) and not self._prims.encoding(prim)
        return is_lost or self._is_retyped(prim)

    def _is_retyped(self, prim: Any) -> bool:
        authored = self._prims.authored(prim)
        if not authored.lacks_apis or not authored.is_layered or not self.tables.tells("SCH012"):
            return False
        return retyped.is_bared(prim, self._kinds)

    @fact
    def arrays(self, prim: Any) -> ParticleArrays:
        """The arrays of a particle field: none on a prim in an older encoding (SCH011)."""
        is_ours = not self._prims.encoding(prim)
        mistyped = self._prims.mistyped(prim)
        return reading.read_particle_arrays(
            prim,
            self._kinds.names(self._kinds.key(prim)) if is_ours else (),
            self._prims.authored(prim).declared if is_ours else (),
            {spec.attribute.GetName() for spec in mistyped if not spec.only_role},
            self._depth.times,
            self._depth.statistics,
            self._advance,
        )

    def misfitting_default(self, prim: Any, array: ParticleArray) -> str | None:
        """The default that hides what would fit, in words, where an array does not fit."""
        return hiding.misfitting_default(array, self.arrays(prim), self._prims.hidden_animation)

    def unseen(self, prim: Any) -> Unseen | None:
        """The particles that can't be seen at any time, if there are some."""
        arrays = self.arrays(prim)
        if not any(arrays.used("opacities", "scales")):
            return None  # and NumPy need not be imported
        return unseen.unseen_particles(arrays)

    def copies(self, prim: Any, unseen: Unseen | None) -> Copies | None:
        """The particles that equal the next one in every array at all times, but `unseen` ones."""
        arrays = self.arrays(prim)
        if not arrays.most_particles:
            return None  # and NumPy need not be imported
        return copies.copied_particles(prim, arrays, unseen.selected if unseen else None)

    def misfits(self, prim: Any, *, are_long: bool) -> tuple[MisfitArrays, ...]:
        """The arrays that hold the elements of more particles than there are, or of fewer."""
        return misfits.misfit_arrays(self.arrays(prim), are_long)

    def is_told_as_misspelt(self, prim: Any, name: str) -> bool:
        """Whether SCH004 tells what is probably the float or half array of this float name."""
        return self._prims.is_told_as_misspelt(prim, name, f"{name}h")

    def positions_outside_extent(
        self, prim: Any, slack: float, half_slack: float, clamp: float
    ) -> OutsideExtent | None:
        """The positions outside the authored extent, if any; `half_slack` is that of halfs."""
        authored = prim.GetAttribute("extent")
        positions = next(self.arrays(prim).used("positions"), None)
        if not positions or not authored.HasAuthoredValue():
            return None  # and NumPy need not be imported
        share = half_slack if positions.is_half else slack
        return extent.positions_outside_extent(self.arrays(prim), authored, share, clamp)

    def kernels_outside_extent(
        self, prim: Any, share: float, clamp: float
    ) -> KernelsOutside | None:
        """The kernels that reach out of the authored extent by a share of its longest side."""
        arrays, extent = self.arrays(prim), prim.GetAttribute("extent")
        names = self.apis(prim).providers(schema.KERNEL_BASE)
        if not arrays.most_particles or len(names) != 1 or not extent.HasAuthoredValue():
            return None
        kernel = reach.KERNELS.get(names[0])
        return reach.kernels_outside(arrays, extent, kernel, share, clamp) if kernel else None

    def coarse_positions(self, prim: Any, factor: float) -> CoarsePositions | None:
        """The positions whose numbers are coarser than particles; `factor` is in `Counts.far`."""
        arrays = self.arrays(prim)
        if not arrays.most_particles:
            return None  # and NumPy need not be imported
        return coarseness.coarse_positions(arrays, factor)

    @fact
    def scales(self, prim: Any) -> Scales | None:
        """The scales that count, beside the places of particles; None if not all are finite."""
        arrays = self.arrays(prim)
        array = arrays.finite("scales")
        span = array.span if array else None
        if not array or not span:
            return None
        return scales.Scales(array, *span, arrays)

    def range_within(self, array: ParticleArray, low: float, high: float) -> tuple[Row, Row] | None:
        """The least and greatest number in each column, if all lie within the limits."""
        return numbers.range_within(array, low, high)

    def are_whole(self, array: ParticleArray) -> bool:
        """Whether every number in an array is a whole one."""
        return numbers.are_whole(array)

    def are_raw(self, array: ParticleArray, outside: Elements | None) -> bool:
        """Whether opacities, some `outside` 0 to 1, look like logits; or scales like logarithms."""
        return raw.are_raw(array, outside)

    def raw_numbers(self, array: ParticleArray) -> RawNumbers | None:
        """The numbers beside infinity that look like logits in opacities, or logs in scales."""
        return raw.raw_numbers(array) if array.has_infinity else None

    def colour_space(self, prim: Any) -> ColourSpace | None:
        """The colour space of the coefficients: their own, or the nearest name above them."""
        used = self.arrays(prim).coefficients
        return colour_spaces.colour_space(
            prim, used.attribute if used else None, self.apis(prim).awaited
        )

    def material_is_bound(self, prim: Any) -> bool:
        """Whether a material is bound to the prim, which then replaces its own radiance."""
        return apis.material_is_bound(prim)

    def statistics(self) -> tuple[ParticleFieldStats, ...]:
        """The statistics of all particle fields, sorted by path."""
        fields = self._prims.of(schema.PARTICLE_FIELD)
        stats = (
            statistics.stats_of(self._prims.shown_path(prim), self.arrays(prim)) for prim in fields
        )
        return tuple(sorted(stats, key=lambda of_prim: of_prim.prim))
