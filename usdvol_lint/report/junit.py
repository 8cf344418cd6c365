"""The report for CI servers: JUnit XML, in which each stage is a test case.

A stage passes where it is clean, fails with all that `--fail-on` counts, and is in error where the
job was not done.  What else it shows stands in `system-out`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, islice
from pathlib import PurePath
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from usdvol_lint.model import Severity, Status
from usdvol_lint.report import Options, Writer
from usdvol_lint.report.limits import Room, cut
from usdvol_lint.report.numbers import count, counts
from usdvol_lint.report.stagewise import Looks, Shown, Stagewise, Told
from usdvol_lint.report.verdict import unpruned
from usdvol_lint.results import Report, StageResult
from usdvol_lint.words import printable

_TOOL = "usdvol-lint"
_NO_STAGES = "no stages checked"

# GitLab takes files of up to 30 MB.  Of these so much is for what is told of stages.
_MOST_BYTES = 20_000_000
_MOST_TOLD = 50_000
_MOST_CAUSES = 200
_MORE_AS_XML = 4


class JUnit(Writer):
    """One suite; its first line has the counts over all stages."""

    def end(self, report: Report) -> Iterator[str]:
        suites = _suites(report, self.options)
        indent(suites)
        yield '<?xml version="1.0" encoding="UTF-8"?>\n'
        # `##[` and `##vso[` are commands to CI hosts, in whatever log they stand.
        yield tostring(suites, encoding="unicode").replace("##", "#&#35;") + "\n"


def _suites(report: Report, options: Options) -> Element:
    cases = list(_cases(report, options))
    numbers = {
        "tests": str(len(cases)),
        "failures": _having("failure", cases),
        "errors": _having("error", cases),
        "time": _time(report.run.seconds),
    }
    suites = Element("testsuites", {"name": _TOOL, **numbers})
    suite = SubElement(suites, "testsuite", {"name": _TOOL, **numbers})
    suite.set("skipped", _having("skipped", cases))
    suite.set("timestamp", printable(report.run.date))
    suite.extend(cases)
    return suites


def _having(outcome: str, cases: Iterable[Element]) -> str:
    return str(sum(case.find(outcome) is not None for case in cases))


def _time(seconds: float) -> str:
    return f"{seconds:.3f}"


def _cases(report: Report, options: Options) -> Iterator[Element]:
    names = _Names()
    if report.failure:
        words = cut(printable(report.failure))
        yield _with(names.case(_TOOL, "run"), "error", words, "failure", words)
    elif not report.stages:  # where nothing changed, say; a file without a test fails a build
        yield _with(names.case(_TOOL, "run"), "skipped", _NO_STAGES, "skipped")
    if gone := unpruned(report, options):
        yield _with(names.case(_TOOL, "baseline"), "failure", gone, "error", gone)
    stagewise = Stagewise(report, options)
    shown = [stagewise.shown(stage) for stage in report.stages]
    texts = _Texts(report, shown)
    for number, stage in enumerate(report.stages):
        case = names.case(*_folder_and_name(stage.path))
        case.set("time", _time(sum(stage.seconds.values())))
        yield _judged(case, number, report, shown[number], texts)


class _Names:
    """The names of test cases: readers take two of one name and class for one and the same."""

    def __init__(self) -> None:
        self._taken: set[tuple[str, str]] = set()
        self._last: Counter[tuple[str, str]] = Counter()

    def case(self, classname: str, name: str) -> Element:
        unique = name
        while (classname, unique) in self._taken:
            self._last[classname, name] += 1
            unique = f"{name} ({self._last[classname, name] + 1})"
        self._taken.add((classname, unique))
        return Element("testcase", classname=classname, name=unique)


def _folder_and_name(path: str) -> tuple[str, str]:
    parts = PurePath(path)
    return printable(parts.parent.as_posix()), printable(parts.name or path or ".")


# --- one stage ------------------------------------------------------------------------------------


class _Texts:
    """What is told of stages, each told of about as much as any other where there is too much."""

    def __init__(self, report: Report, shown: Iterable[Shown]) -> None:
        self._looks = Looks(report)
        self._left = Room(_MOST_BYTES)
        sizes = (number for each in shown for number in _sizes(each))
        self._most = _share([min(size, _MOST_CAUSES) for size in sizes if size])

    def text(self, stage: int, number: int, told: Iterable[Told]) -> str:
        """The first of so many causes, as far as there is room, and how many are left."""
        said: list[str] = []
        for cause, level in islice(told, self._most):
            look = self._looks.on(stage, cause, level)
            if not self._left.takes(look, more=_MORE_AS_XML * sum(map(look.count, "<>&"))):
                break
            said.append(look)
        if len(said) < number:
            more = count(number - len(said), "cause")
            said.append(f"… and {more} more: --output-format json has them all")
        return "\n".join(said)


def _sizes(shown: Shown) -> tuple[int, int]:
    """How many causes each of the texts on a stage has to tell."""
    failing = len(shown.undone) + shown.failing.number
    return failing, shown.below.number + len(shown.uncounted)


def _share(sizes: Sequence[int]) -> int:
    """How many causes a text may have at most, so that all of them stay below the limit."""
    left, texts = _MOST_TOLD, len(sizes)
    for size in sorted(sizes):
        if size * texts > left:
            return max(1, left // texts)
        left -= size
        texts -= 1
    return _MOST_CAUSES


def _judged(case: Element, number: int, report: Report, shown: Shown, texts: _Texts) -> Element:
    """The test case with what is told of the stage."""
    stage = report.stages[number]
    told, others = _sizes(shown)
    text = texts.text(number, told, chain(shown.undone, shown.failing.told))
    if shown.undone or stage.status is not Status.CHECKED:
        _with(case, "error", _why_not(stage, shown, report), _kind(stage), text)
    elif told:
        levels = shown.failing.levels
        _with(case, "failure", _numbers(levels), max(levels).label, text)
    if others:
        SubElement(case, "system-out").text = texts.text(
            number, others, chain(shown.below.told, shown.uncounted)
        )
    return case


def _with(case: Element, outcome: str, message: str, kind: str, text: str = "") -> Element:
    SubElement(case, outcome, message=message, type=kind).text = text or None
    return case


def _why_not(stage: StageResult, shown: Shown, report: Report) -> str:
    """Why the job was not done, in the words of what says so."""
    if not shown.undone:
        return stage.status.replace("_", " ")
    number, _ = shown.undone[0]
    return cut(printable(report.causes[number].first.message))


def _kind(stage: StageResult) -> str:
    return "failed" if stage.status is Status.CHECKED else str(stage.status)


def _numbers(levels: Mapping[Severity, int]) -> str:
    return counts(*((levels.get(level, 0), level.label) for level in reversed(Severity)))
