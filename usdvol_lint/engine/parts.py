"""A problem is of one opinion: two where the default is one spec's and the samples another's."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy

from pxr import Usd

from usdvol_lint.facts.usd.opinions import are_of_one, by_opinion
from usdvol_lint.rule import NotChecked, Problem


def parts_of(problem: Problem | NotChecked) -> Iterator[Problem | NotChecked]:
    """A problem at the default time and at others, or the parts of it that are of one opinion."""
    is_of_values = isinstance(problem.at, Usd.Attribute) and not problem.spec
    if not is_of_values or are_of_one(problem.at, problem.times[0]):
        yield problem
        return
    of_default, of_samples = copy(problem), copy(problem)
    of_default.times, of_samples.at_default = (), False
    if problem.cover and hasattr(problem.cover, "samples"):
        of_default.cover, of_samples.cover = by_opinion(problem.cover)
    yield of_default
    yield of_samples
