"""Which of its stages a child looks at together, and which alone, after it went meanwhile."""

from __future__ import annotations

_MOST_SECONDS = 5.0
"""After that stages that are looked at together are looked at one by one, each with its limit."""


class Group:
    """The first of the stages that a child has not answered; `of` is how many it has together."""

    def __init__(self) -> None:
        self.of = 0
        self._alone = 0

    def limit(self, limit: float) -> float:
        """The seconds for the next answer, where a stage has so many."""
        return min(limit, _MOST_SECONDS) if self.of > 1 else limit

    def asked(self, *paths: str) -> tuple[str, ...]:
        """Those that the child is to have: of a group that is taken apart only the first."""
        return paths[:1] if self._alone else paths

    def take_apart(self) -> bool:
        """Says that the child has gone; whether any of several stages may be why."""
        if self.of <= 1:
            return False
        self._alone, self.of = self.of, 0
        return True

    def answered(self) -> None:
        """Says that the first stage has its answer."""
        self.of, self._alone = max(self.of - 1, 0), max(self._alone - 1, 0)
