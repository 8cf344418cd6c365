"""The instances that show a finding, told apart by the reasons why it is ignored there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice
from typing import Any, NamedTuple

from usdvol_lint.facts.usd.instances import instances_of, path_in_prototype, prototype_of, shown
from usdvol_lint.suppressions import matching

_MOST_PATHS = 10_000


class Share(NamedTuple):
    """Some of the instances that show a finding: the first path, and how many they are.

    `reason` says why it is ignored there, None if it is not; `matches` which globs match there.
    """

    reason: str | None
    path: str
    instances: int
    matches: tuple[bool, ...] = ()


class Shares:
    """Finds the shares; `reason_at` says why a prim ignores a code: see `Suppressions`.

    Paths that differ in which of the `globs` match them are shares of their own, so that a
    configuration can take one of them away.
    """

    def __init__(
        self,
        reason_at: Callable[[Any, str], str | None],
        globs: Sequence[Sequence[str]] = (),
    ) -> None:
        self._reason_at = reason_at
        self._matchers = [matching(patterns) for patterns in globs]
        self._through: dict[tuple[Any, str], list[Share]] = {}

    def of(self, prim: Any, code: str, otherwise: str | None) -> list[Share]:
        """The shares of a finding in a prototype; `otherwise` is the reason where none is said."""
        told = self._told_apart(prim, code) if self._matchers else self._found(prim, code)
        return _joined(
            share._replace(reason=otherwise if share.reason is None else share.reason or None)
            for share in told
        )

    def _found(self, prim: Any, code: str) -> list[Share]:
        """The shares by what prims say: None where that is nothing, "" where it is taken back."""
        reason = self._reason_at(prim, code)
        if reason is not None or not prim.IsInPrototype():
            return [Share(reason, *shown(prim))]
        key = prototype_of(prim), code
        if key not in self._through:
            self._through[key] = _joined(
                share for instance in instances_of(key[0]) for share in self._found(instance, code)
            )
        below = path_in_prototype(prim)
        return [share._replace(path=share.path + below) for share in self._through[key]]

    def _told_apart(self, prim: Any, code: str) -> list[Share]:
        """Each path, with the globs that match; where these are very many, only by reasons."""
        each = list(islice(self._each(prim, code), _MOST_PATHS + 1))
        if len(each) > _MOST_PATHS:
            return self._found(prim, code)
        return [
            share._replace(matches=tuple(matches(share.path) for matches in self._matchers))
            for share in each
        ]

    def _each(self, prim: Any, code: str) -> Iterator[Share]:
        """Each path at which a prim appears, and what is said there."""
        reason = self._reason_at(prim, code)
        if not prim.IsInPrototype():
            yield Share(reason, str(prim.GetPath()), 1)
            return
        below = path_in_prototype(prim)
        for instance in instances_of(prototype_of(prim)):
            for share in self._each(instance, code):
                said = share.reason if reason is None else reason
                yield Share(said, share.path + below, 1)


def _joined(shares: Iterable[Share]) -> list[Share]:
    """One share of each kind, those that are not ignored first."""
    by_kind: dict[tuple[object, ...], Share] = {}
    for share in shares:
        kind = share.reason, share.matches
        known = by_kind.get(kind)
        if known:
            path = min(share.path, known.path)
            share = share._replace(path=path, instances=share.instances + known.instances)
        by_kind[kind] = share
    return sorted(by_kind.values(), key=lambda share: (share.reason is not None, share.path))
