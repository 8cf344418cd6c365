"""What is known of the contents of volume files, and of what fields claim, over all stages."""

from __future__ import annotations

from collections.abc import Hashable

from usdvol_lint.facts.grids.claims import ClaimReader
from usdvol_lint.facts.grids.contents import ContentClass
from usdvol_lint.volumefile.cache import VolumeFiles

_MOST = 10_000
"""Claims and classes that are kept from one stage to the next."""
_MOST_BYTES = 64 << 20
"""Of readings that are kept: those of some 60,000 files of one grid."""


class KnownContents:
    """The files that were read, the claims about them, and the classes of what they hold."""

    def __init__(self) -> None:
        self.files = VolumeFiles()
        self.claims = ClaimReader()
        self.classes: dict[Hashable, ContentClass] = {}

    def begin_stage(self) -> None:
        """Forgets what has become too much; within a stage, equal claims stay the same object."""
        is_full = self.files.size > _MOST_BYTES
        if is_full:
            self.files.forget()
        if is_full or len(self.classes) + len(self.claims) > _MOST:
            self.classes.clear()  # they hold readings, and go by the numbers of layouts
            self.claims.forget()
