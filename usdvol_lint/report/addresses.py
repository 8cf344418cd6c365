"""Where code hosts show a cause: a file of the repository and a line, whatever is to blame."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

from usdvol_lint.paths import below, canonical, split_package
from usdvol_lint.results import Cause, Report


class Address(NamedTuple):
    """A file in relation to the repository, with `/`, and the line and column in it from 1.

    `outside` is the layer to blame where the file is not that layer, as a person reads it.
    """

    file: str
    line: int | None = None
    column: int | None = None
    outside: str = ""


def addresses(report: Report, repository: str | None) -> Callable[[Cause], Address]:
    """The address of each cause of a report.

    A layer outside the repository, or in no file, is shown where it comes into the first stage that
    shows it: there is no other file that the host has.  A package stands for what is in it.
    """
    name = cache(lambda path: below(canonical(path), repository))

    def address(cause: Cause) -> Address:
        stage, finding = cause.places[0]
        site, layer = finding.site, finding.source.layer
        if layer is not None:
            package, inside = split_package(layer)
            file = below(package, repository)
            if file != package or repository is None:
                place = (None, None) if inside else (site.line, site.column)
                return Address(file, *place, outside=site.layer if inside else "")
        stage_file, _ = split_package(name(report.stages[stage].path))
        line, column = site.entry or (None, None)
        return Address(stage_file, line, column, "" if layer is None else site.layer)

    return address
