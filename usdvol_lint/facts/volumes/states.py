"""States of field relationships and their targets, as rules name them; needs no pxr."""

from __future__ import annotations

from enum import Enum, auto


class TargetState(Enum):
    """What a target of a field relationship is; each target has exactly one state."""

    FIELD = auto()
    MISSING = auto()
    UNLOADED = auto()
    """It may be in a payload that was not loaded."""
    UNCOMPOSED = auto()
    """Its definition may be in a layer that does not open, which is a finding of its own."""
    PROPERTY = auto()
    NOT_A_FIELD = auto()
    UNKNOWN_TYPE = auto()
    """A prim whose type is not registered."""
    ABSTRACT_TYPE = auto()
    """A prim whose type is a field base that may not be instantiated."""
    INACTIVE = auto()
    """Inactive, or below an inactive prim."""
    OVER = auto()
    """Only overs, no definition."""
    ABSTRACT = auto()
    """A `class`, or below one."""


class BindingMark(Enum):
    """What preconditions test of a Volume's bindings, besides the states of its targets."""

    NONE = auto()
    """There is no binding."""
    SEVERAL = auto()
    """There are several bindings."""
    SEVERAL_TARGETS = auto()
    """A relationship has several targets."""
    ATTRIBUTE = auto()
    """A property in the namespace is an attribute."""
    UNDECLARED = auto()
    """A relationship outside the namespace seems to be intended as a binding."""
    NESTED = auto()
    """A name contains a namespace of its own."""
    OUTSIDE = auto()
    """A target is not below the Volume."""


class Emptiness(Enum):
    """Why a relationship has no target."""

    UNAUTHORED = auto()
    BLOCKED = auto()
    """Explicitly no target: `= None` or `= []`."""
    DELETED = auto()
    """A list operation deleted the targets."""
    CIRCULAR = auto()
    """It forwards to another relationship, and that one back to it."""
    LOST = auto()
    """Specs have targets, and composition dropped them."""
