"""The particles of particle fields: their APIs, their arrays, their colour spaces."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.found import Wing, fact

if TYPE_CHECKING:
    from usdvol_lint.config import Depth
    from usdvol_lint.facts.particles.apis import ParticleApis
    from usdvol_lint.facts.particles.arrays import ParticleArrays
    from usdvol_lint.facts.particles.colour_spaces import ColourSpace
    from usdvol_lint.facts.particles.extent import OutsideExtent
    from usdvol_lint.facts.prims import Prims
    from usdvol_lint.facts.prims.tables import Tables
    from usdvol_lint.facts.usd.kinds import Kinds
    from usdvol_lint.model import ParticleFieldStats


class Particles(Wing):
    """What particle fields apply and hold.

    `depth` says which time samples are looked at, and whether statistics are counted meanwhile;
    `advance` is told of progress in long sequences.
    """

    def __init__(
        self,
        tables: Tables,
        kinds: Kinds,
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
        """The applied APIs of a prim, those that nobody registers among them."""
        from usdvol_lint.facts.particles.apis import read_particle_apis

        return read_particle_apis(prim, self._kinds)

    @fact
    def arrays(self, prim: Any) -> ParticleArrays:
        """The arrays of a particle field: empty where SCH011 says that it is no UsdVol."""
        from usdvol_lint.facts.particles.reading import read_particle_arrays

        is_ours = not self._prims.encoding(prim)
        mistyped = self._prims.mistyped(prim)
        return read_particle_arrays(
            prim,
            self._kinds.names(self._kinds.key(prim)) if is_ours else (),
            self._prims.authored(prim).declared if is_ours else (),
            {each.attribute.GetName() for each in mistyped if not each.only_role},
            self._depth.times,
            self._depth.statistics,
            self._advance,
        )

    def positions_outside_extent(
        self, prim: Any, slack: float, clamp: float
    ) -> OutsideExtent | None:
        """The positions that lie outside the extent at the same time."""
        from usdvol_lint.facts.particles.extent import positions_outside_extent

        extent = prim.GetAttribute("extent")
        positions = next(self.arrays(prim).used("positions"), None)
        if not positions or not extent.HasAuthoredValue():
            return None
        return positions_outside_extent(positions, extent, slack, clamp)

    def colour_space(self, prim: Any) -> ColourSpace | None:
        """The colour space that a prim names, or the nearest prim above it that names one."""
        from usdvol_lint.facts.particles.colour_spaces import colour_space

        return colour_space(prim)

    def material_is_bound(self, prim: Any) -> bool:
        """Whether a material is bound to the prim, which replaces its own radiance."""
        from usdvol_lint.facts.particles.apis import material_is_bound

        return material_is_bound(prim)

    def statistics(self) -> tuple[ParticleFieldStats, ...]:
        """What each particle field holds, in the order of their paths."""
        from usdvol_lint.facts.particles.statistics import stats_of

        fields = self._prims.of(schema.PARTICLE_FIELD)
        stats = (stats_of(self._prims.shown_path(prim), self.arrays(prim)) for prim in fields)
        return tuple(sorted(stats, key=lambda each: each.prim))
