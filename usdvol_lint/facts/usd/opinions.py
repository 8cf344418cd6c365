"""Which spec holds the value of an attribute."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple, TypeVar

from pxr import Usd

from usdvol_lint.facts.usd.calls import get_stack_with_offsets
from usdvol_lint.facts.usd.diagnostics import UNREADABLE

_Found = TypeVar("_Found", bound=Any)
_DEFAULT = Usd.TimeCode.Default()
_OF_DEFAULT, _OF_TIMES = ("default",), ("timeSamples", "default", "spline")


class Opinion(NamedTuple):
    """A spec that holds a value, and the `Sdf.LayerOffset` from its layer's time to the stage's."""

    spec: Any
    offset: Any


def strongest_opinion(attribute: Any, time: float | None) -> Opinion | None:
    """The opinion that gives the value at a time code of the stage, or at the default time (None).

    Stronger specs are skipped if they hold only metadata, or at the default time only time samples.
    """
    return next(iter(opinions(attribute, time)), None)


def opinions(attribute: Any, time: float | None) -> list[Opinion]:
    """The opinions that have a value at a time of the stage, or by default, strongest first."""
    stack = _stack(attribute, time)
    found = _valued(stack, time)
    retimed = [offset for _, offset in stack if not offset.IsIdentity()]
    if time is None or not retimed or not is_from_clips(attribute, time):
        return found
    # Of retimed clips USD lists the one at that time of the layer with the clips (26.11): another
    # one, which may hold nothing.
    own = retimed[0].GetInverse() * time
    return _valued(_stack(attribute, own), own)[:1] or found[:1]


def _stack(attribute: Any, time: float | None) -> list[tuple[Any, Any]]:
    """The specs of an attribute, strongest first, each with the offset to the time of the stage."""
    try:
        stack = get_stack_with_offsets(attribute, _DEFAULT if time is None else time)
    except UNREADABLE:  # not all clips open
        stack = get_stack_with_offsets(attribute, _DEFAULT)
    return list(stack)


def _valued(stack: Iterable[tuple[Any, Any]], time: float | None) -> list[Opinion]:
    keys = _OF_DEFAULT if time is None else _OF_TIMES
    return [Opinion(spec, offset) for spec, offset in stack if any(map(spec.HasInfo, keys))]


def is_of_retimed_clip(attribute: Any, time: float, opinion: Opinion) -> bool:
    """Whether an opinion is that of a value clip in a layer whose times are not the stage's."""
    return not opinion.offset.IsIdentity() and is_from_clips(attribute, time)


def is_from_clips(attribute: Any, time: float | None) -> bool:
    """Whether the value comes from a value clip: then it may lie in another layer at each time."""
    if time is None:
        return False
    source = attribute.GetResolveInfo(time).GetSource()
    return bool(source == Usd.ResolveInfoSourceValueClips)


def are_of_one(attribute: Any, time: float) -> bool:
    """Whether one spec gives the value at the default time and that at a time of the stage."""
    default, sample = strongest_opinion(attribute, None), strongest_opinion(attribute, time)
    return bool(default and sample and default.spec == sample.spec)


def by_opinion(found: _Found) -> Iterator[_Found]:
    """Occurrences of values, or those at the default time and the others, if two specs hold them.

    They are a dataclass with `samples`, of which that of the default time is the first.
    """
    if not (found.at_default and found.times) or are_of_one(found.attribute, found.times[0]):
        yield found
        return
    first, *others = found.samples
    yield replace(found, samples=(first,))
    yield replace(found, samples=tuple(others))
