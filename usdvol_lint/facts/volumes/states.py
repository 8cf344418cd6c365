"""What the targets of field relationships turn out to be: names that need no pxr."""

from __future__ import annotations

from enum import Enum, auto


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
    UNDECLARED = auto()
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
