"""The states of asset attributes' values and of files, without pxr, for rules to name."""

from __future__ import annotations

from enum import Enum, StrEnum, auto


class AssetState(Enum):
    """What one value of an asset attribute leads to; each value has exactly one state."""

    FILE = auto()
    """A readable file with content."""
    MISSING = auto()
    """Nothing is there."""
    ASSUMED = auto()
    """A path whose file the configuration takes to be there, and that is not looked at."""
    PATTERN = auto()
    """Nothing is there, and the path has a placeholder such as `$F4` or `####`."""
    NOT_A_FILE = auto()
    """What is there is no readable file with content; see `FileFault`."""
    BROKEN_EXPRESSION = auto()
    """A variable expression that can't be evaluated."""
    UNSET_VARIABLE = auto()
    """A variable expression that needs a variable that is not set where it is authored."""
    UNVERIFIABLE = auto()
    """A URI that no resolver here answers for, or a file that is there with a query."""
    LIVE_SESSION = auto()
    """A path into a running Houdini session."""
    EMPTY = auto()
    """An empty path, or an expression that evaluates to one."""
    BLOCKED = auto()
    """No value: a block, or a value clip without one."""
    MISTYPED = auto()
    """A value that is no asset path."""


ON_DISK = frozenset({AssetState.FILE, AssetState.NOT_A_FILE, AssetState.MISSING})
"""The states of values that name a path on disk, whether or not a file is there."""
ON_DISK_OR_PATTERN = ON_DISK | {AssetState.ASSUMED, AssetState.PATTERN}
"""The same, with those of paths that nobody looks at, or that have a placeholder."""


class PathMark(Enum):
    """Further properties of an asset attribute's values that preconditions of rules test."""

    NONE = auto()
    """Every value is empty or blocked, or there is none."""
    SEVERAL = auto()
    """There is more than one value."""
    NUMBERED = auto()
    """The one file name ends in a number of three digits or more, and the stage has a range."""
    UNPLAIN = auto()
    """A path is absolute, or has blanks, backslashes, a colon or a tilde in it."""
    FOREIGN = auto()
    """A path does not end in the extension that the type of the prim asks for."""
    CASE_BLIND = auto()
    """A path may differ from the disk by case: nothing is there, or the folder ignores case."""
    PACKAGED = auto()
    """A layer of the stage lies in a package."""
    """There are value clips."""


class FileFault(StrEnum):
    """Why what is at a path is no readable file with content, in words that follow `is`."""

    FOLDER = "a folder"
    SPECIAL = "not a regular file"
    EMPTY = "a file of 0 bytes"
    UNREADABLE = "not readable"
    BROKEN_LINK = "a symbolic link that leads nowhere"
    PACKED = "compressed or encrypted in its package, where USD can't read it"
    LFS_POINTER = "a Git-LFS pointer, not the file itself"


class PathDefect(StrEnum):
    """Why not every platform, or none, finds the file at a path, in words that follow it."""

    DRIVE = "begins with a drive letter, which only Windows has"
    HOME = "begins with '~', which USD does not expand"
    BACKSLASHES = "has backslashes, which separate names on Windows alone"
    BLANK = "begins or ends with a blank"
