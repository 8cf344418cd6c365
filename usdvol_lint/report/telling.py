"""What reports for people tell, and where: each cause once, under the first stage that shows it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from usdvol_lint.model import Finding, Severity, Site
from usdvol_lint.report import Options
from usdvol_lint.report.numbers import count, few
from usdvol_lint.results import Cause, Report, StageResult, State
from usdvol_lint.words import printable


class Told(NamedTuple):
    """What is told at once: one cause, or several that are folded into the line of the first.

    `stage` is the number of the stage under which it is told, `others` are those of all others
    that show it, as far as they are known.
    `numbers` are those of the causes; `was` is how bad it was when it was told before, if so.
    """

    causes: tuple[Cause, ...]
    stage: int
    others: tuple[int, ...] = ()
    numbers: tuple[int, ...] = ()
    was: Severity | None = None

    @property
    def first(self) -> Cause:
        return self.causes[0]

    @property
    def finding(self) -> Finding:
        return self.causes[0].places[0].finding


Heard: TypeAlias = tuple[int, Cause, Severity | None]
"""A cause with its number, and how bad it was when it was told before, if so."""


def told(report: Report, options: Options) -> Mapping[int, list[Told]]:
    """What is told under each stage that has something to tell, by prim."""
    causes = enumerate(report.causes)
    heard = [(number, cause, None) for number, cause in causes if options.shows(cause)]
    shown_in = stages_by_cause(report)
    result: dict[int, list[Told]] = {}
    for one in folded(heard):
        others = {other for number in one.numbers for other in shown_in.get(number, ())}
        whole = one._replace(others=tuple(sorted(others - {one.stage})))
        result.setdefault(one.stage, []).append(whole)
    return result


def folded(heard: Iterable[Heard]) -> Iterator[Told]:
    """What is told of these causes, by stage and prim."""
    together: dict[tuple[object, ...], list[Heard]] = {}
    for one in sorted(heard, key=_place_of):
        together.setdefault(_key(one), []).append(one)
    for several in together.values():
        numbers, causes, was = zip(*several, strict=True)
        yield Told(causes, causes[0].places[0].stage, (), numbers, was[0])


def _place_of(heard: Heard) -> tuple[int, str]:
    first = heard[1].places[0]
    return first.stage, first.finding.site.prim or ""


def _key(heard: Heard) -> tuple[object, ...]:
    """What causes that are told in one line have in common."""
    number, cause, was = heard
    stage, finding = cause.places[0]
    if finding.fold is None or was:
        return stage, number
    return stage, finding.code, finding.fold, cause.severity, cause.state, cause.reason


def stages_by_cause(report: Report) -> Mapping[int, list[int]]:
    """The numbers of the stages that show a cause, for those that have several places."""
    shown_in: dict[int, list[int]] = {
        number: [] for number, cause in enumerate(report.causes) if cause.count > 1
    }
    for number, stage in enumerate(report.stages):
        for cause in shown(stage, report):
            if cause in shown_in:
                shown_in[cause].append(number)
    return shown_in


def shown(stage: StageResult, report: Report) -> Iterator[int]:
    """The numbers of the causes that a stage shows, without what is suppressed on it alone."""
    for number, worst in zip(stage.causes, stage.worst, strict=True):
        if worst is not None or report.causes[number].state is State.SUPPRESSED:
            yield number


# --- in words -------------------------------------------------------------------------------------


def message(one: Told, every: bool) -> str:
    """The message, with what is folded into it; with `every`, all of that by name."""
    text = printable(one.finding.message)
    more = one.causes[1:]
    if not more:
        return text
    where = list(dict.fromkeys(_place(cause.places[0].finding) for cause in more))
    return f"{text} … and {len(more):,} more: {few(where, every)}"


def _place(finding: Finding) -> str:
    site = finding.site
    return f"<{printable(site.prim)}>" if site.prim else printable(site.layer)


def variant_and_frames(site: Site) -> Iterator[str]:
    """Under which variant and when it is seen."""
    if site.variant:
        yield f"variant {printable(site.variant)}"
    if site.frames:
        several = len(site.times) > 1 or site.at_default
        yield f"{'frames' if several else 'frame'} {site.frames}"


def elsewhere(one: Told, report: Report, every: bool) -> str:
    """Where else it shows, after `also`; empty if nowhere."""
    stages = [printable(report.stages[number].path) for number in one.others]
    here = on_this_stage(one, every, named=not stages)
    if not stages:
        return here
    there = f"in {count(len(stages), 'other stage')}: {few(stages, every)}"
    return f"{here}, and {there}" if here else there


def on_this_stage(one: Told, every: bool, named: bool = True) -> str:
    """Where else it shows on the stage where it is told; empty if nowhere."""
    if _is_cut_off(one):
        return f"at {count(more_here(one), 'other place')} of this stage"
    return _other_prims(one, every, named)


def more_here(one: Told) -> int:
    """The number of other places on the stage where it is told."""
    return sum(cause.here - 1 for cause in one.causes)


def _is_cut_off(one: Told) -> bool:
    """Whether there are more places on the stage where it is told than the causes carry."""
    return any(
        cause.here > sum(place.stage == one.stage for place in cause.places) for cause in one.causes
    )


def _other_prims(one: Told, every: bool, named: bool) -> str:
    sites = [
        place.finding.site
        for cause in one.causes
        for place in cause.places[1:]
        if place.stage == one.stage
    ]
    told_already = {cause.places[0].finding.site.prim for cause in one.causes}
    prims = {site.prim: None for site in sites if site.prim and site.prim not in told_already}
    if not prims:
        return f"at {count(len(sites), 'other place')} of this prim" if sites else ""
    names = f": {few([f'<{printable(prim)}>' for prim in prims], every)}" if named else ""
    return f"at {count(len(prims), 'other prim')} of this stage{names}"


def remarks(one: Told) -> Iterator[tuple[str, str]]:
    """What is to be said of its state, with labels: how it got worse, or why it is suppressed."""
    cause = one.first
    if cause.state == State.WORSE and cause.was is not None:
        from usdvol_lint.baseline.cover import exceeds  # few runs have anything that is worse

        yield "worse:", exceeds(cause.was, cause.cover) or ""
    if one.was:
        yield "raised:", f"told as {one.was.label} above"
    if cause.state == State.SUPPRESSED and cause.reason:
        others = (place.finding.ignored for place in cause.places)
        for reason in dict.fromkeys((cause.reason, *filter(None, others))):
            yield "reason:", printable(reason)
