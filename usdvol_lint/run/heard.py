"""What a child says of its stages before it answers."""

from __future__ import annotations

from collections.abc import Callable

from usdvol_lint.model import Finding
from usdvol_lint.run.protocol import Advance, NewFindings, Together


class Heard:
    """What a child says before it answers, of which the findings are kept."""

    def __init__(self, advance: Callable[[int], None], begin_group: Callable[[int], None]) -> None:
        self.findings: list[Finding] = []
        self._advance = advance
        self._begin_group = begin_group

    def __call__(self, message: Together | Advance | NewFindings) -> None:
        if isinstance(message, NewFindings):
            self.findings.extend(message.findings)
        elif isinstance(message, Together):
            self._begin_group(message.stages)
        else:
            self._advance(message.samples)
