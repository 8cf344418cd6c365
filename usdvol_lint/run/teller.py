"""Who is told what a run comes to, while it goes on."""

from __future__ import annotations

from typing import Protocol

from usdvol_lint.model import Severity
from usdvol_lint.results import Cause, Place, Report, StageResult


class Teller(Protocol):
    """Is told what a run comes to while it goes on, in an order that no worker can change.

    `begin` comes first; then, stage by stage, `cause` for what is seen for the first time, with
    all that is known of it so far, `place` for each other place that a cause carries, `raised`
    where a cause is worse than it `was`, with the place where it is, and `stage` for what came of
    the stage so far.  What depends on the rest of the run comes after the last stage.
    One that is not `listening` once it was told the beginning is told no causes.
    """

    @property
    def listening(self) -> bool: ...
    def begin(self, head: Report) -> None: ...
    def cause(self, number: int, cause: Cause) -> None: ...
    def place(self, number: int, place: Place) -> None: ...
    def raised(self, number: int, cause: Cause, was: Severity) -> None: ...
    def stage(self, number: int, stage: StageResult) -> None: ...


class Silent:
    """Tells nobody."""

    listening = False

    def begin(self, head: Report) -> None: ...
    def cause(self, number: int, cause: Cause) -> None: ...
    def place(self, number: int, place: Place) -> None: ...
    def raised(self, number: int, cause: Cause, was: Severity) -> None: ...
    def stage(self, number: int, stage: StageResult) -> None: ...
