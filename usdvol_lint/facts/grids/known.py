"""What is known of the contents of volume files, and of what fields claim, over all stages."""

from __future__ import annotations

from collections.abc import Hashable
from typing import TypeAlias

from usdvol_lint.facts.grids.claims import ClaimReader
from usdvol_lint.facts.grids.contents import ContentClass
from usdvol_lint.volumefile import Bounds, Grid, Matrix
from usdvol_lint.volumefile.cache import VolumeFiles

KnownBoxes: TypeAlias = dict[tuple[int, Matrix | None], tuple[Grid, Bounds | None]]
"""The boxes around grids, by the id of a grid and its placement, each with the grid."""

_MOST = 10_000
"""Claims, classes and boxes that are kept from one stage to the next."""
_MOST_BYTES = 64 << 20
"""Of readings that are kept: those of some 60,000 files of one grid."""


class KnownContents:
    """The files that were read, the claims about them, the classes of what they hold, the boxes."""

    def __init__(self) -> None:
        self.files = VolumeFiles()
        self.claims = ClaimReader()
        self.classes: dict[Hashable, ContentClass] = {}
        self.boxes: KnownBoxes = {}

    def begin(self) -> None:
        """Forgets what is too much, but within no stage: equal claims are one object there."""
        is_full = self.files.size > _MOST_BYTES
        if is_full:
            self.files.forget()
        if is_full or len(self.classes) + len(self.claims) + len(self.boxes) > _MOST:
            self.classes.clear()  # they hold readings, and go by the numbers of layouts
            self.claims.forget()
            self.boxes.clear()
