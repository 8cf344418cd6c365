"""The settings of a run, and the values that they may have."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint.config.origins import Origins
from usdvol_lint.model import Severity

if TYPE_CHECKING:
    from usdvol_lint.config.per_path import PerPath
    from usdvol_lint.suppressions import Suppression

FAIL_ON = ("error", "warning", "info", "never")
OUTPUT_FORMATS = (
    *("auto", "full", "concise", "json", "jsonl"),
    *("sarif", "github", "gitlab", "junit", "markdown"),
)
SUMMARIES = ("rule", "cause", "stage", "asset")
SHOWABLE = ("info", "known", "suppressed", "unused")
SUPPRESSIONS = ("all", "configuration", "none")
LOADS = ("all", "none")
CONTENTS = ("all", "first", "off")
VARIANTS = ("selected", "all")
TIMES = ("all", "first", "ends")
LEVELS = tuple(severity.label for severity in reversed(Severity))


class Glob(NamedTuple):
    """A pattern as in a .gitignore, and the folder that it is relative to."""

    folder: str
    pattern: str


class Storage(NamedTuple):
    """Where the files of stages are on this machine.

    `search_path` are folders for USD's own resolver.
    `assume_present` are patterns of absolute paths that are neither looked for nor opened;
    `path_map` says by the beginnings of paths where volume files really are.
    """

    search_path: tuple[str, ...] = ()
    assume_present: tuple[str, ...] = ()
    path_map: Mapping[str, str] = {}


class Config(NamedTuple):
    """The settings of a run.

    `select` is None for the rules that are on by default; without any selector it is none at all.
    `jobs` is the number of worker processes, 0 for one for each processor; `timeout` is in seconds
    for each stage; `packs` are folders, besides what is installed; `options` are those of rules, by
    code or name of the rule.
    `fail_on_unchecked` says that what was not checked fails a run at any level.
    `show` is what reports for people have besides errors and warnings.
    `max_places` is how many places of a cause a report has in full; `root` is the folder that
    layers go by in fingerprints, `version_pattern` what stands for any version in their paths.
    `baseline` is the file that has what is known.
    `required_version` says which versions of the tool the rest is written for; built-in rules that
    came after the release `rules_as_of` report infos.
    `suppressions` are those that are heeded: those in stages are not the `configuration`'s own,
    `suppress`; `today` is a date in place of the real one, for those that expire.
    `per_path` has other severities for some layers.
    `exclude` takes stages off the list; where `stages` says which are wholes, all others are parts.
    `origins` is where all of this is said.
    See `Storage` for `search_path`, `assume_present` and `path_map`, and `Depth` for `frames`,
    `load`, `content`, `times` and `statistics`.
    """

    select: tuple[str, ...] | None = None
    ignore: tuple[str, ...] = ()
    # One empty dictionary for all: a Mapping is not written to, and a MappingProxyType can't be
    # pickled or copied.
    severity: Mapping[str, str] = {}
    options: Mapping[str, Mapping[str, Any]] = {}
    packs: tuple[str, ...] = ()
    fail_on: str = "error"
    fail_on_unchecked: bool = False
    output_format: str = "auto"
    show: tuple[str, ...] = ()
    jobs: int = 0
    timeout: float = 300.0
    load: str = "all"
    content: str = "all"
    variants: str = "selected"
    variant_limit: int = 100
    times: str | int = "all"
    statistics: bool = False
    max_places: int = 20
    root: str | None = None
    version_pattern: str | None = None
    baseline: str | None = None
    required_version: str | None = None
    rules_as_of: str | None = None
    suppressions: str = "all"
    suppress: tuple[Suppression, ...] = ()
    per_path: tuple[PerPath, ...] = ()
    today: str | None = None
    exclude: tuple[Glob, ...] = ()
    stages: tuple[Glob, ...] = ()
    frames: tuple[float, float] | None = None
    search_path: tuple[str, ...] = ()
    assume_present: tuple[str, ...] = ()
    path_map: Mapping[str, str] = {}
    origins: Origins = Origins()

    @property
    def least_shown(self) -> Severity:
        """The severity from which on reports for people have a finding."""
        return Severity.INFO if "info" in (*self.show, self.fail_on) else Severity.WARNING

    @property
    def depth(self) -> Depth:
        """How much of each stage is checked."""
        selections = self.variant_limit if self.variants == "all" else 0
        storage = Storage(self.search_path, self.assume_present, self.path_map)
        return Depth(
            *(self.load, self.content, self.times, self.statistics),
            *(selections, self.frames, storage),
        )


class Depth(NamedTuple):
    """How much of each stage is checked, and against what.

    `load`: whether payloads are loaded (all, none).
    `content`: how many of a field's files are opened (all, first, off).
    `times`: which time samples of particles are read (all, first, ends, or their number).
    `statistics`: whether the figures of particle fields are collected.
    `selections`: how many variant selections at most, besides the authored ones.
    `frames`: the first and the last frame of the production, in place of the stage's own range.
    `storage`: where files are on this machine.
    """

    load: str = "all"
    content: str = "all"
    times: str | int = "all"
    statistics: bool = False
    selections: int = 0
    frames: tuple[float, float] | None = None
    storage: Storage = Storage()
