"""What the values of asset attributes turn out to be: names that need no pxr."""

from __future__ import annotations

from enum import Enum, StrEnum, auto


class AssetState(Enum):
    """What one value of an asset attribute turns out to be; each has exactly one."""

    FILE = auto()
    """A readable file with content."""
    MISSING = auto()
    """Nothing is there."""
    PATTERN = auto()
    """Nothing is there, and the name holds `$F4`, `####` or the like."""
    NOT_A_FILE = auto()
    """Something is there, but a folder, empty, unreadable, a Git-LFS pointer."""
    BROKEN_EXPRESSION = auto()
    """A variable expression that can't be evaluated."""
    UNSET_VARIABLE = auto()
    """A variable expression with a variable that is not set where it is evaluated."""
    UNVERIFIABLE = auto()
    """A URI that no resolver here answers for."""
    LIVE_SESSION = auto()
    """A path into a running Houdini session."""
    EMPTY = auto()
    BLOCKED = auto()
    """No value: blocked, or a value clip that gives none."""
    MISTYPED = auto()
    """A value that is no asset path."""


ON_DISK = frozenset({AssetState.FILE, AssetState.NOT_A_FILE, AssetState.MISSING})
"""The states of values that name a path on disk, whether or not a file is there."""
PLACES = ON_DISK | {AssetState.PATTERN}
"""The same, with those that name a pattern of paths."""


class PathMark(Enum):
    """What else the values of an asset attribute have about them, beside their states."""

    NONE = auto()
    """No value names anything."""
    SEVERAL = auto()
    """There are several values."""
    UNPLAIN = auto()
    """Some path is absolute, or has blanks, backslashes, a colon or a tilde in it."""
    FOREIGN = auto()
    """Some path has not the extension that the type of the prim asks for."""
    CASE_BLIND = auto()
    """Something is missing, or lies in a folder that finds names in any case."""
    PACKAGED = auto()
    """Some layer of the stage lies in a package."""
    LAYERED = auto()
    """Several specs have a say, or value clips."""
    CLIPPED = auto()
    """Value clips have a say."""


class FileFault(StrEnum):
    """Why something that is there is no readable file with content, in words that follow `is`."""

    FOLDER = "a folder"
    SPECIAL = "not a regular file"
    EMPTY = "a file of 0 bytes"
    UNREADABLE = "not readable"
    BROKEN_LINK = "a symbolic link that leads nowhere"
    PACKED = "compressed or encrypted in its package, where USD can't read it"
    LFS_POINTER = "a Git-LFS pointer, not the file itself"
