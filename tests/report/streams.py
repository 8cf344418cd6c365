"""What a format writes while a run over some stages goes on."""

from __future__ import annotations

from collections.abc import Sequence

from reports import report

from usdvol_lint.model import Severity, StageReport
from usdvol_lint.report import Options, Writer, writer
from usdvol_lint.results import Cause, Place, Report, StageResult
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.folding import folded


class Listener:
    """Keeps what a writer says of a run that goes on."""

    listening = True

    def __init__(self, writer: Writer) -> None:
        self.writer = writer
        self.said: list[str] = []

    def begin(self, head: Report) -> None:
        self.said += self.writer.begin(head)

    def cause(self, number: int, cause: Cause) -> None:
        self.said += self.writer.cause(number, cause)

    def place(self, number: int, place: Place) -> None:
        self.said += self.writer.place(number, place)

    def raised(self, number: int, cause: Cause, was: Severity) -> None:
        self.said += self.writer.raised(number, cause, was)

    def stage(self, number: int, stage: StageResult) -> None:
        self.said += self.writer.stage(number, stage)


def streamed(
    format: str, stages: Sequence[StageReport], options: Options, most: int = 20
) -> tuple[str, Report]:
    """What is written while a run over these stages goes on, and the report at its end."""
    told = Listener(writer(format, options))
    head = report()
    told.begin(head)
    judged = ((stage, False) for stage in stages)
    results, causes = folded(Causes(most=most), judged, False, told)
    whole = head._replace(stages=results).with_causes(causes)
    told.said += told.writer.end(whole)
    return "".join(told.said), whole
