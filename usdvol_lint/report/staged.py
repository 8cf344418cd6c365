"""What reports for people have in common: they tell stage by stage what each is first to show."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from usdvol_lint.model import Severity
from usdvol_lint.report import Options, Writer
from usdvol_lint.report.telling import Heard, Told, folded
from usdvol_lint.results import Cause


class Staged(Writer):
    """Keeps causes until the stage is known that they are told under.

    `levels` has how bad each cause is by its number, as far as it was told.
    """

    def __init__(self, options: Options) -> None:
        super().__init__(options)
        self.levels: dict[int, Severity] = {}
        self._heard: dict[int, list[Heard]] = defaultdict(list)

    def cause(self, number: int, cause: Cause) -> Iterable[str]:
        self._hear(number, cause)
        return ()

    def raised(self, number: int, cause: Cause, was: Severity) -> Iterable[str]:
        self._hear(number, cause)
        return ()

    def _hear(self, number: int, cause: Cause) -> None:
        if self.options.shows(cause):
            was = self.levels.get(number)
            self.levels[number] = cause.severity
            self._heard[cause.places[0].stage].append((number, cause, was))

    def told_on(self, stage: int) -> list[Told]:
        """What was heard that is told under this stage."""
        return list(folded(self._heard.pop(stage, ())))

    def told_late(self) -> Mapping[int, list[Told]]:
        """What was heard after the stage that it is told under, by that."""
        return {stage: self.told_on(stage) for stage in sorted(self._heard)}
