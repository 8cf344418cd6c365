"""The instances that show a finding, told apart by the reasons why it is ignored there."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from itertools import islice
from typing import Any, NamedTuple

from usdvol_lint.facts.usd.instances import instances_of, path_in_prototype, prototype_of, shown
from usdvol_lint.facts.usd.settled import settle
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
        through = settle((prototype_of(prim), code), self._find_through, self._through)
        below = path_in_prototype(prim)
        return [share._replace(path=share.path + below) for share in through]

    def _find_through(self, key: tuple[Any, str]) -> Generator[tuple[Any, str], None, list[Share]]:
        """The shares of a prototype, by what its instances and the prims above these say."""
        prototype, code = key
        found: list[Share] = []
        for instance in instances_of(prototype):
            if instance.IsInPrototype() and self._reason_at(instance, code) is None:
                around = prototype_of(instance), code
                if around not in self._through:
                    yield around
            found += self._found(instance, code)
        return _joined(found)

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
        waiting: list[tuple[Any, str, str | None]] = [(prim, "", None)]
        while waiting:
            each, below, reason = waiting.pop()
            if reason is None:
                reason = self._reason_at(each, code)
            if not each.IsInPrototype():
                yield Share(reason, f"{each.GetPath()}{below}", 1)
                continue
            below = path_in_prototype(each) + below
            instances = reversed(instances_of(prototype_of(each)))
            waiting += ((instance, below, reason) for instance in instances)


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
