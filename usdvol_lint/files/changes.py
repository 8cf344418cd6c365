"""What git knows to have changed since a revision: committed, staged, unstaged and untracked."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable, Iterator, Sequence

from usdvol_lint.files import Changes
from usdvol_lint.files.names import is_among, names_of
from usdvol_lint.model import UsageError
from usdvol_lint.words import printable, quoted

_SUBMODULE = "160000"
"""The mode of what git has of a submodule: the commit that is checked out in it."""
_OF_ONE_REPOSITORY = frozenset(
    f"GIT_{name}"
    for name in (
        *("DIR", "WORK_TREE", "INDEX_FILE", "PREFIX", "COMMON_DIR", "IMPLICIT_WORK_TREE"),
        *("OBJECT_DIRECTORY", "ALTERNATE_OBJECT_DIRECTORIES", "GRAFT_FILE", "SHALLOW_FILE"),
    )
)
"""What a hook sets, and leads git to another repository than that of the folder."""

_FETCH = (
    "a clone with part of the history needs the rest: 'fetch-depth: 0' for actions/checkout, "
    "GIT_DEPTH: 0 for GitLab, or 'git fetch --unshallow'"
)

_NO_GIT = "--changed-since needs git, which is not installed"


def changes_since(revision: str, arguments: Sequence[str], settings: Iterable[str]) -> Changes:
    """What changed since the merge base of a revision and HEAD, in the repository of the arguments.

    `settings` are the files and folders that concern every stage: configuration, packs, baseline.
    Raises UsageError, never says that nothing changed, where git can't tell.
    """
    # A revision never begins like an option, and behind `--verify` none is a file's name.
    if not revision or revision.startswith("-") or not revision.isprintable():
        raise UsageError(f"--changed-since: {quoted(revision)} is no revision")
    git = _git_of(arguments)
    base = git.merge_base(revision)
    changed = frozenset(name for path in git.changed(base) for name in names_of(path))
    everything = any(is_among(path, changed) or _holds(path, changed) for path in settings)
    return Changes(revision, changed, everything)


def _holds(folder: str, changed: frozenset[str]) -> bool:
    starts = tuple(f"{name}/" for name in names_of(folder))
    return any(each.startswith(starts) for each in changed)


def _git_of(arguments: Sequence[str]) -> _Git:
    """Git in the repository that holds all arguments."""
    try:
        return _Git(_shared_folder(arguments))
    except _NoRepositoryError:
        raise UsageError(f"--changed-since: {_why_none(arguments)}") from None


def _why_none(arguments: Sequence[str]) -> str:
    """Why no repository holds all arguments."""
    tops: dict[str, str] = {}
    for argument in arguments:
        try:
            tops.setdefault(_Git(_shared_folder([argument])).folder, argument)
        except _NoRepositoryError:
            return f"{quoted(argument)} lies in no git repository"
        if len(tops) > 1:
            one, other = map(quoted, tops.values())
            return f"{one} and {other} lie in two git repositories: check each in a run of its own"
    return "the arguments lie in no git repository"


def _shared_folder(arguments: Sequence[str]) -> str:
    """The innermost folder that is there and holds all arguments."""
    try:
        shared = os.path.commonpath([os.path.realpath(each) for each in arguments or [os.curdir]])
    except ValueError:  # on several drives
        raise UsageError("--changed-since: the arguments are on several drives") from None
    while not os.path.isdir(shared):
        shared = os.path.dirname(shared)
    return shared


class _NoRepositoryError(Exception):
    """A folder that belongs to no repository."""


class _Git:
    """Git in the repository that a folder belongs to, of which `folder` is then the top.

    In a submodule nothing is heeded that is set for the repository around it.
    """

    def __init__(self, folder: str, is_submodule: bool = False) -> None:
        self.folder = folder
        self._unset = _OF_ONE_REPOSITORY if is_submodule else frozenset()
        code, top, said = self._call("rev-parse", "--show-toplevel")
        if code:
            if b"not a git repository" in said or not said:
                raise _NoRepositoryError
            raise UsageError(f"--changed-since: {_first_line(said)}")
        self.folder = _path(top.removesuffix(b"\n"))

    def merge_base(self, revision: str) -> str:
        """The last commit that HEAD and a revision have in common."""
        commit = self.commit(revision)
        if commit is None:
            raise UsageError(f"--changed-since: git finds no revision {quoted(revision)}; {_FETCH}")
        code, base, _ = self._call("merge-base", commit, "HEAD")
        if code:
            raise UsageError(
                f"--changed-since: git finds no commit that {quoted(revision)} and HEAD have in "
                f"common; {_FETCH}"
            )
        return base.decode("ascii").strip()

    def changed(self, base: str) -> Iterator[str]:
        """The absolute paths of what differs, those that are gone too, and in submodules."""
        commits = {path: at for path, at in self._submodules() if _submodule(path)}
        for path, old, new in (*self.differing(base), *self.differing("--cached", base)):
            if old is None:
                yield path
                continue
            commits[path] = old
            yield from self._between(path, old, new)
        for path, commit in commits.items():
            yield from self._in_submodule(path, commit)
        listed = self._asked("ls-files", "--others", "--exclude-standard", "-z")
        yield from map(self._absolute, filter(None, listed.split(b"\0")))

    def differing(self, *between: str) -> Iterator[tuple[str, str | None, str]]:
        """The paths that git tells to differ, of a submodule with its commits."""
        # Git may be set to tell nothing of submodules; what is in their folders is asked there.
        raw = ("--raw", "-z", "--no-abbrev", "--no-renames", "--ignore-submodules=dirty")
        told = self._asked("diff", *raw, "--no-ext-diff", *between, "--").split(b"\0")
        for entry, name in zip(told[::2], told[1::2], strict=False):
            before, after, old, new, _ = entry.removeprefix(b":").decode("ascii").split()
            is_submodule = before == after == _SUBMODULE
            yield self._absolute(name), old if is_submodule else None, new

    def _submodules(self) -> Iterator[tuple[str, str]]:
        """The submodules, each with its commit: also those of which git sees no difference."""
        for entry in filter(None, self._asked("ls-files", "--stage", "-z").split(b"\0")):
            if entry.startswith(_SUBMODULE.encode()):
                about, _, name = entry.partition(b"\t")
                yield self._absolute(name), about.split()[1].decode("ascii")

    def _between(self, path: str, old: str, new: str) -> Iterator[str]:
        """What differs between two commits of a submodule; all of it where git can't tell."""
        inner = _submodule(path)
        if not new.strip("0") or inner is None:
            return
        if inner.commit(old) is None or inner.commit(new) is None:
            yield path
            return
        yield from (each for each, _, _ in inner.differing(old, new))

    def _in_submodule(self, path: str, commit: str) -> Iterator[str]:
        """What changed in a submodule since a commit of it; all of it where git can't tell."""
        inner = _submodule(path)
        if inner is None or inner.commit(commit) is None:
            yield path
        else:
            yield from inner.changed(commit)

    def commit(self, revision: str) -> str | None:
        code, commit, _ = self._call("rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")
        return None if code else commit.decode("ascii").strip()

    def _absolute(self, name: bytes) -> str:
        return os.path.join(self.folder, _path(name.rstrip(b"/")))

    def _asked(self, *arguments: str) -> bytes:
        code, out, said = self._call(*arguments)
        if code:
            raise UsageError(f"--changed-since: git {arguments[0]}: {_first_line(said)}")
        return out

    def _call(self, *arguments: str) -> tuple[int, bytes, bytes]:
        """The exit code, and what git wrote to standard output and standard error."""
        command = [_program(), "-C", self.folder, "-c", "core.fsmonitor=false", *arguments]
        kept = {name: os.environ[name] for name in os.environ if name not in self._unset}
        environment = {**kept, "LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0"}
        try:
            done = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                check=False,
                env=environment,
            )
        except FileNotFoundError:
            raise UsageError(_NO_GIT) from None
        return done.returncode, done.stdout, done.stderr


def _submodule(path: str) -> _Git | None:
    """Git in a submodule; None where it is not checked out."""
    if not os.path.isdir(path):
        return None
    try:
        inner = _Git(path, is_submodule=True)
    except _NoRepositoryError:
        return None
    return inner if os.path.realpath(inner.folder) == os.path.realpath(path) else None


def _program() -> str:
    """Git where PATH has it: Windows would look into the working directory first."""
    name = "git.exe" if os.name == "nt" else "git"
    files = (os.path.join(each, name) for each in os.get_exec_path() if os.path.isabs(each))
    for file in files:
        if os.path.isfile(file) and os.access(file, os.X_OK):
            return file
    raise UsageError(_NO_GIT)


def _path(name: bytes) -> str:
    return os.path.normpath(os.fsdecode(name))


def _first_line(said: bytes) -> str:
    lines = said.decode("utf-8", "replace").strip().splitlines()
    return printable(lines[0]) if lines else "no reason given"
