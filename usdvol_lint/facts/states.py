"""What asset paths and relationship targets turn out to be: names without any pxr."""

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


class TargetState(Enum):
    """What one target of a field relationship turns out to be; each has exactly one."""

    FIELD = auto()
    MISSING = auto()
    UNLOADED = auto()
    """It may lie in a payload that was not loaded."""
    UNCOMPOSED = auto()
    """What it is may be said in a layer that does not open, which is a finding by itself."""
    PROPERTY = auto()
    NOT_A_FIELD = auto()
    UNKNOWN_TYPE = auto()
    """A prim of a type that nobody registers."""
    ABSTRACT_TYPE = auto()
    """A prim whose type is a field base that may not be instantiated."""
    INACTIVE = auto()
    """Inactive, or below an inactive prim."""
    OVER = auto()
    """Only overs, no definition."""
    ABSTRACT = auto()
    """A `class`, or below one."""


class BindingMark(Enum):
    """What else the `field:` namespace of a Volume has about it, beside its targets' states."""

    NONE = auto()
    """There is nothing in it."""
    SEVERAL = auto()
    """There are several fields."""
    SEVERAL_TARGETS = auto()
    ATTRIBUTE = auto()
    """Something in it is an attribute."""
    STRAY = auto()
    """A relationship outside of it targets a field."""
    NESTED = auto()
    """A name in it is a namespace of its own."""
    OUTSIDE = auto()
    """A field lies elsewhere than below the Volume."""


class Emptiness(Enum):
    """Why a relationship has no target."""

    UNAUTHORED = auto()
    BLOCKED = auto()
    """Explicitly no target: `= None` or `= []`."""
    DELETED = auto()
    """A list operation took the targets away."""
    CIRCULAR = auto()
    """It forwards to another relationship, and that one back to it."""
    LOST = auto()
    """Specs hold targets, composition dropped them."""
