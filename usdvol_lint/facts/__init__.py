"""Facts about a stage: computed when a rule first asks for them, and cached."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from usdvol_lint.config import Depth
from usdvol_lint.deferred import deferred
from usdvol_lint.facts.files import Files
from usdvol_lint.facts.found import Wing
from usdvol_lint.facts.grids import Grids
from usdvol_lint.facts.layers import Layers
from usdvol_lint.facts.particles import Particles
from usdvol_lint.facts.prims import Prims
from usdvol_lint.facts.volumes import Volumes

with deferred(globals()):
    from usdvol_lint.facts import needing_usd as made_of

if TYPE_CHECKING:
    from usdvol_lint.facts.files.disk import Disk
    from usdvol_lint.facts.files.folders import Folders
    from usdvol_lint.facts.grids.known import KnownContents
    from usdvol_lint.facts.usd.drawn import Drawn
    from usdvol_lint.facts.usd.kinds import KindKey, PrimKinds
    from usdvol_lint.facts.volumes.usage import UsedFields

_W = TypeVar("_W", bound=Wing)


class Context(NamedTuple):
    """What the facts of a stage share under all variant selections.

    `disk`: caches the state of files; `known`: what volume files hold, across stages too.
    `used`: collects the fields that are used under any selection.
    `advance`: called with how many samples of a long sequence were processed.
    `telling`: the codes of the rules in whose favour others are silent; None if all are.
    """

    stage: Any
    kinds: PrimKinds
    depth: Depth
    disk: Disk
    known: KnownContents
    used: UsedFields
    advance: Callable[[int], None]
    telling: frozenset[str] | None

    @classmethod
    def of(
        cls,
        stage: Any,
        depth: Depth = Depth(),  # noqa: B008  (it can't change)
        known: KnownContents | None = None,
        folders: Folders | None = None,
        advance: Callable[[int], None] = lambda samples: None,
        telling: frozenset[str] | None = None,
    ) -> Context:
        """The context of a stage with empty caches, but for `known` and `folders`."""
        kinds = made_of.kinds_on(stage)
        known = known or made_of.KnownContents()
        disk = made_of.Disk(folders, made_of.Whereabouts(depth.storage))
        return cls(stage, kinds, depth, disk, known, made_of.UsedFields(), advance, telling)


class Walked(NamedTuple):
    """What one walk over the stage met, under one variant selection.

    `prims` counts what is composed; `kept` are the prims that are drawn and that some rule asks
    for, by kind.
    `clipped` are the prims on which value clips are authored, among the kept ones and those above.
    `untyped` are drawn prims without a type, Xforms and Scopes that have properties which only
    Volumes and splats need: those among the first 20,000 of such types.
    `undefined` are prims of our types with a `def` that are not drawn, by the `over` that nothing
    defines above them.
    `overs` are prims without a `def` that have properties of ours: the first 20,000, or some more.
    """

    prims: int
    kept: Mapping[KindKey, Sequence[Any]]
    clipped: Sequence[Any]
    untyped: Sequence[Any]
    undefined: Mapping[Any, Sequence[Any]]
    overs: Sequence[Any]
    drawn: Drawn


class Facts:
    """The facts of one stage under one variant selection: read-only for rules.

    `stage` is the `Usd.Stage`; each wing has the facts about one subject.
    Modules that need pxr are imported once they are needed, so that rules can be loaded without.
    """

    def __init__(self, context: Context, walked: Walked) -> None:
        stage, kinds, depth, disk, known, used, advance, telling = context
        clips = made_of.Clips(walked.clipped)
        authored = made_of.AuthoredReader(kinds, clips)
        tables = made_of.Tables(walked.kept, kinds, authored, telling)
        self.stage = stage
        self.kinds = kinds
        self.tables = tables
        self.prims = Prims(tables, kinds, clips, walked.drawn)
        self.files = Files(tables, stage, clips, disk, advance, bool(depth.frames))
        overs = made_of.Overs(stage, kinds, tables, walked.undefined, walked.overs, walked.drawn)
        self.layers = Layers(tables, stage, clips, kinds, overs, walked.drawn, depth.frames)
        self.grids = Grids(tables, self.files, depth.content, known, advance)
        self.volumes = Volumes(
            tables,
            stage,
            kinds,
            walked.untyped,
            self.prims,
            self.files,
            self.layers,
            self.grids,
            used,
            known.boxes,
        )
        self.particles = Particles(tables, kinds, self.prims, depth, advance)

    def tells(self, *codes: str) -> bool:
        """Whether one of these rules is in force, and no milder than it is on its own.

        What it tells need not be told by another.
        """
        return self.tables.tells(*codes)

    def wing(self, wing: type[_W]) -> _W:
        """The wing of that class: `Files` is `files`."""
        own: _W = getattr(self, wing.__name__.lower())
        return own
