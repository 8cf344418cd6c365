"""What git knows to have changed since a revision: committed, staged, unstaged and untracked."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable, Iterator, Sequence

from usdvol_lint.files import Changes
from usdvol_lint.files.names import is_among, names_of
from usdvol_lint.model import UsageError
from usdvol_lint.words import printable, quoted

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
    """Git in the repository that a folder belongs to, of which `folder` is then the top."""

    def __init__(self, folder: str) -> None:
        self.folder = folder
        code, top, said = self._call("rev-parse", "--show-toplevel")
        if code:
            if b"not a git repository" in said or not said:
                raise _NoRepositoryError
            raise UsageError(f"--changed-since: {_first_line(said)}")
        self.folder = _path(top.removesuffix(b"\n"))

    def merge_base(self, revision: str) -> str:
        """The last commit that HEAD and a revision have in common."""
        code, commit, _ = self._call("rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")
        if code:
            raise UsageError(f"--changed-since: git finds no revision {quoted(revision)}; {_FETCH}")
        code, base, _ = self._call("merge-base", commit.decode("ascii").strip(), "HEAD")
        if code:
            raise UsageError(
                f"--changed-since: git finds no commit that {quoted(revision)} and HEAD have in "
                f"common; {_FETCH}"
            )
        return base.decode("ascii").strip()

    def changed(self, base: str) -> Iterator[str]:
        """The absolute paths of what differs, those that are gone too."""
        diff = ("diff", "--name-only", "-z", "--no-renames", "--no-ext-diff", base, "--")
        yield from self._paths(*diff)
        yield from self._paths(diff[0], "--cached", *diff[1:])
        yield from self._paths("ls-files", "--others", "--exclude-standard", "-z")

    def _paths(self, *arguments: str) -> Iterator[str]:
        code, out, said = self._call(*arguments)
        if code:
            raise UsageError(f"--changed-since: git {arguments[0]}: {_first_line(said)}")
        for name in filter(None, out.split(b"\0")):
            yield os.path.join(self.folder, _path(name.rstrip(b"/")))

    def _call(self, *arguments: str) -> tuple[int, bytes, bytes]:
        """The exit code, and what git wrote to standard output and standard error."""
        command = [_program(), "-C", self.folder, "-c", "core.fsmonitor=false", *arguments]
        environment = {**os.environ, "LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0"}
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
