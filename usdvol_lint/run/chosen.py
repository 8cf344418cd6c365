"""The stages of a run, and what its report says of those that it leaves out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from usdvol_lint.config import Config
from usdvol_lint.files import Changes, Listing
from usdvol_lint.files.listing import list_stages
from usdvol_lint.paths import below, canonical
from usdvol_lint.results import StageResult
from usdvol_lint.words import quoted


class Chosen(NamedTuple):
    """What a run was asked to check, the stages that this is, and what changed of all files.

    Where `changed` is None, nobody asked for what changed.
    """

    arguments: tuple[str, ...]
    listing: Listing
    changed: Changes | None

    @property
    def changed_files(self) -> frozenset[str] | None:
        """The files of which a stage has to use one; None where all stages are checked."""
        return self.changed.paths if self.changed and not self.changed.everything else None

    def looked_at(self, stages: Sequence[StageResult], root: str | None) -> tuple[str, ...]:
        """The arguments, named as layers are and sorted; of a run over what changed, the stages.

        Whoever compares runs must not take the other ones for checked.
        """
        is_part = self.changed_files is not None
        named = [stage.path for stage in stages] if is_part else self.arguments
        return tuple(sorted(below(canonical(path), root) for path in named))

    def left_out(self, stages: Sequence[StageResult]) -> tuple[str, str]:
        """In words which stages use nothing that changed, or why there is none to check at all."""
        every = len(self.listing.stages)
        unchanged = every - len(stages)
        if self.changed is None or not unchanged:
            return "", self.listing.nothing
        since = f"changed since {quoted(self.changed.since)}"
        if not stages:
            none = "the stage uses no" if every == 1 else f"none of {every:,} stages uses a"
            return "", f"{none} file that {since}"
        return f"{unchanged:,} of {every:,} stages left out, which use no file that {since}", ""


def choose(arguments: tuple[str, ...], config: Config, changed: Changes | None) -> Chosen:
    """The stages that arguments lead to; none where nothing changed, so that none is opened."""
    listing = list_stages(arguments, config.exclude, config.stages)
    is_unchanged = changed is not None and not changed.everything and not changed.paths
    if changed and is_unchanged and listing.stages:
        listing = Listing((), f"nothing changed since {quoted(changed.since)}")
    return Chosen(arguments, listing, changed)
