"""What a run does with a baseline: it is read before the run, and compared or written after it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from usdvol_lint.baseline.compare import brought_up_to_date, compare, held, pruned
from usdvol_lint.baseline.entry import Entry, least_held
from usdvol_lint.baseline.file import Baseline, check_writable, write_baseline
from usdvol_lint.baseline.moved import Move, moves, renamed
from usdvol_lint.baseline.reading import read_baseline
from usdvol_lint.baseline.scope import Scope, lacking, not_done, scope_of, widest
from usdvol_lint.model import Severity, UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE
from usdvol_lint.paths import canonical
from usdvol_lint.results import BaselineUse, Cause, Report, State
from usdvol_lint.words import printable, quoted


class Use(NamedTuple):
    """What a run is to do with baselines: which file it reads, and which one it writes.

    `prune` takes out of the file that is read what is gone; `moved` are layers and folders, in
    relation to the root, that are called otherwise now.
    """

    read: str | None = None
    write: str | None = None
    prune: bool = False
    moved: tuple[Move, ...] = ()

    @property
    def target(self) -> str | None:
        """The file to write."""
        return self.write or (self.read if self.prune else None)

    @property
    def option(self) -> str:
        """What asked for the file to be written."""
        return f"--write-baseline {self.write}" if self.write else "--prune-baseline"


class Applied(NamedTuple):
    """A report with the states of its causes, and in a line why not all was done as asked."""

    report: Report
    failure: str = ""


class Prepared(NamedTuple):
    """What to do with a baseline, and what was read for it."""

    use: Use
    baseline: Baseline | None

    @property
    def root(self) -> str | None:
        """The folder that the layers of the run are to go by, if the baseline says so."""
        return self.baseline.root if self.baseline else None

    def check_root(self, root: str | None) -> None:
        """Raises UsageError where layers go by another root than those of the baseline do."""
        use, baseline = self
        if use.write and root is None:
            hint = 'set `root = "."` in a usdvol-lint.toml, or --root FOLDER'
            raise UsageError(f"{use.option}: there is no root that layers go by: {hint}")
        if baseline and baseline.root and baseline.root != root:
            theirs, ours = quoted(baseline.root), quoted(str(root))
            said = f"its layers go by {theirs}, and the root of this run is {ours}"
            raise UsageError(f"{baseline.file}: {said}: leave out --root, or write it anew")
        if baseline and baseline.is_report and baseline.has_root != (root is not None):
            one, other = ("a", "none") if baseline.has_root else ("no", "one")
            raise UsageError(f"{baseline.file}: was written with {one} root, this run has {other}")

    def apply(self, report: Report) -> Applied:
        """Compares the causes of a run with the baseline, and writes what is to be written.

        In what was written all causes are known that it holds.  A file that is replaced keeps what
        the run did not look at.
        """
        if self.use.write and not report.stages and os.path.exists(self.use.write):
            file = printable(self.use.write)
            return Applied(report._replace(nothing=f"{report.nothing}; {file} stays as it is"))
        compared, unmatched = _compared(report, self.baseline)
        if self.use.write and self.baseline is None:
            self = self._replace(baseline=_left_by(self.use.write, report))
        now = _scope(compared, self.baseline)
        told = compared._replace(baseline=_told(compared, self, unmatched, now.lacking))
        if not self.use.target:
            return Applied(told)
        if self.use.prune and now.lacking:
            why = f"this run sees less than {self.use.read} has: {now.lacking}"
            return Applied(told, f"--prune-baseline: {why}")
        return _written(told, self, now)


def prepare(use: Use) -> Prepared:
    """Reads the baseline; raises UsageError for all that can be known to fail before the run."""
    if use.target:
        check_writable(use.option, Path(use.target), replaces=use.write is not None)
    if use.read is None or _is_first_write(use):
        return Prepared(use, None)
    baseline = read_baseline(use.read)
    if baseline.is_report and not use.write and use.prune:
        hint = "--write-baseline FILE makes a baseline of it"
        raise UsageError(f"--prune-baseline: {use.read} is a report: {hint}")
    return Prepared(use, renamed(baseline, use.moved))


def _is_first_write(use: Use) -> bool:
    """Whether the file that a configuration names is to be written for the first time."""
    if not use.read or not use.write or os.path.exists(use.read):
        return False
    return canonical(use.read) == canonical(use.write)


def _left_by(file: str, report: Report) -> Baseline | None:
    """The baseline that a run replaces which sees less; None where it sees all, or there is none.

    One that can't be read, or goes by another root, is replaced as a whole.
    """
    if not os.path.exists(file):
        return None
    try:
        baseline = read_baseline(file)
    except UsageError:
        return None
    is_alike = baseline.root == report.root and not baseline.is_report
    return baseline if is_alike and _scope(report, baseline).lacking else None


class _Scopes(NamedTuple):
    """What a baseline that is written now has looked at, and what this run lacks of the old one."""

    written: Scope
    lacking: str


def _scope(report: Report, baseline: Baseline | None) -> _Scopes:
    ours = scope_of(report)
    if baseline is None:
        return _Scopes(ours, "")
    words = "; ".join((*lacking(baseline.scope, ours, report.root), *not_done(report)))
    return _Scopes(widest(baseline.scope, ours) if words else ours, words)


def _compared(report: Report, baseline: Baseline | None) -> tuple[Report, tuple[Entry, ...]]:
    if baseline is None:
        return report, ()
    causes, unmatched = compare(baseline.entries, report.causes)
    return report.with_causes(causes), unmatched


def _told(
    report: Report, prepared: Prepared, unmatched: Sequence[Entry], lacking: str
) -> BaselineUse | None:
    """What a report says of the baseline that it was compared with."""
    baseline = prepared.baseline
    if baseline is None:
        return None
    if lacking:
        return BaselineUse(baseline.file, len(baseline.entries), None, lacking)
    return BaselineUse(
        path=baseline.file,
        entries=len(baseline.entries),
        gone=tuple(map(str, unmatched)),
        moved=_moved(report, unmatched),
    )


def _moved(report: Report, unmatched: Sequence[Entry]) -> tuple[Move, ...]:
    """The places that may have moved; the run that wrote the baseline had infos in it, or not."""
    new = [cause for cause in report.causes if cause.state is State.NEW] if unmatched else []
    levels = (Severity.WARNING, Severity.INFO)
    return tuple(sorted({move for least in levels for move in moves(unmatched, held(new, least))}))


def _written(report: Report, prepared: Prepared, now: _Scopes) -> Applied:
    use, baseline = prepared
    entries = _entries(report, prepared, covers=not now.lacking)
    only_pruned = baseline and not use.write
    scope = baseline.scope if baseline and only_pruned else now.written
    file = use.target or ""
    try:
        write_baseline(Baseline(file, report.root, scope, entries))
    except OSError as error:
        return Applied(report, f"{use.option}: {error.strerror}; what was there is as it was")
    told = report.baseline or BaselineUse(file, 0, ())
    known = report.with_causes([_known(cause, entries) for cause in report.causes])
    return Applied(
        known._replace(
            baseline=told._replace(path=file, entries=len(entries), moved=(), written=True)
        ),
        _left_out(report, file) if use.write else "",
    )


def _entries(report: Report, prepared: Prepared, covers: bool) -> Mapping[str, Entry]:
    """What the file is to hold."""
    entries = prepared.baseline.entries if prepared.baseline else {}
    if not prepared.use.write:
        return pruned(entries, report.causes)
    now = held(report.causes, least_held(report.settings))
    return brought_up_to_date(entries, now, covers)


def _known(cause: Cause, entries: Mapping[str, Entry]) -> Cause:
    """The cause, known if what was written holds it as it is."""
    entry = entries.get(cause.fingerprint)
    if entry is None or not cause.state.counts or (cause.was and entry.cover == cause.was):
        return cause
    return cause._replace(state=State.KNOWN, was=None)


def _left_out(report: Report, file: str) -> str:
    """In a line what can't be in a baseline, though it makes the run fail."""
    stages = sorted(
        {
            f"{report.stages[place.stage].path} ({cause.code})"
            for cause in report.causes
            if cause.code in NOT_IGNORABLE and cause.state is not State.SUPPRESSED
            for place in cause.places
        }
    )
    if not stages:
        return ""
    hint = "mend it, or check the others without it"
    return f"{file} is written, but it can't hold {printable(', '.join(stages))}: {hint}"
