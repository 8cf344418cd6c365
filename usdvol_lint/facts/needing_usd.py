"""What facts are made of on every stage, imported together once pxr may be imported."""

from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.storage import Whereabouts
from usdvol_lint.facts.grids.known import KnownContents
from usdvol_lint.facts.layers.overs import Overs
from usdvol_lint.facts.prims.attributes import AuthoredReader
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.clips import Clips
from usdvol_lint.facts.usd.kinds import kinds_on
from usdvol_lint.facts.volumes.usage import UsedFields

__all__ = [
    "AuthoredReader",
    "Clips",
    "Disk",
    "KnownContents",
    "Overs",
    "Tables",
    "UsedFields",
    "Whereabouts",
    "kinds_on",
]
