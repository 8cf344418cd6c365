"""The relationships that one forwards to, as far as they may be to blame for what it leads to."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import Any, Generic, TypeAlias, TypeVar

from usdvol_lint.engine.strength import Standing
from usdvol_lint.facts.usd.calls import get_path, get_stage, own_targets

_MOST = 100
"""So many kinds are kept of a chain: each is brought by arcs of its own."""

_Said = TypeVar("_Said")
_Asked: TypeAlias = Callable[[Any], tuple[_Said, Standing] | None]
_Kinds: TypeAlias = dict[tuple[object, ...], tuple[Any, _Said]]


class Forwards(Generic[_Said]):
    """Follows relationships that lead to one other each; each of them is asked once.

    Of opinions that stand alike the nearest counts, so a chain of any length comes to few.
    """

    def __init__(self) -> None:
        self._known: dict[Any, _Kinds[_Said]] = {}

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._known.clear()

    def behind(self, relationship: Any, said: _Asked[_Said]) -> Iterable[tuple[Any, _Said]]:
        """The relationships that one forwards to, from one to the next, and what is said of each.

        `said` gives the opinion on a relationship, and how it stands.
        """
        following = _following(relationship)
        return self._from(following, said).values() if following else ()

    def _from(self, relationship: Any, said: _Asked[_Said]) -> _Kinds[_Said]:
        """One, and those that it forwards to."""
        passed: dict[Any, Any] = {}
        each = relationship
        while each and (path := get_path(each)) not in self._known and path not in passed:
            passed[path] = each
            each = _following(each)
        last = get_path(each) if each else None
        kinds = self._known.get(last, {})
        ring = list(_from_on(passed, last))
        for path in (*reversed(ring), *reversed(passed)):  # of a ring, each has all of it behind
            kinds = self._known[path] = _with(passed[path], said(passed[path]), kinds)
        return kinds


def _with(
    relationship: Any, found: tuple[_Said, Standing] | None, behind: _Kinds[_Said]
) -> _Kinds[_Said]:
    """What is said of a relationship, and of those behind it as far as that stands otherwise."""
    if found is None:
        return behind
    said, standing = found
    key = standing.order, standing.keys
    others = ((other, each) for other, each in behind.items() if other != key)
    return {key: (relationship, said), **dict(islice(others, _MOST - 1))}


def _from_on(paths: Iterable[Any], first: Any) -> Iterator[Any]:
    """The paths from one on; none where it is not among them."""
    is_on = False
    for path in paths:
        is_on = is_on or path == first
        if is_on:
            yield path


def _following(relationship: Any) -> Any | None:
    """The only one that a relationship leads to."""
    targets = own_targets(relationship)
    if len(targets) != 1 or not (path := targets[0]).IsPropertyPath():
        return None
    return get_stage(relationship).GetRelationshipAtPath(path)
