"""Where code hosts show a cause: a file of the repository and a line, whatever is to blame."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

from usdvol_lint.paths import below, canonical, split_package
from usdvol_lint.results import Cause, Place, Report


class Address(NamedTuple):
    """A file in relation to the repository, with `/`, and the line and column in it from 1.

    What lies outside the repository has its absolute path.
    `outside` is the layer to blame where the file is not that layer, as a person reads it.
    """

    file: str
    line: int | None = None
    column: int | None = None
    outside: str = ""

    @property
    def is_absolute(self) -> bool:
        """Whether the host has no such file."""
        return os.path.isabs(self.file)


def addresses(report: Report, repository: str | None) -> Callable[[Cause], Address]:
    """The address of each cause of a report.

    A layer outside the repository, or in no file, is shown where it comes into the first stage of
    the repository that shows it, or into the first one at all where there is no such: the host has
    no other file.  A package stands for what is in it.
    """
    stage_of = stage_addresses(report, repository)

    @cache
    def file_of(layer: str) -> tuple[str | None, bool]:
        """The file of a layer, None if it is not in the repository; and whether it is a package."""
        package, inside = split_package(layer)
        file = below(package, repository)
        return (file if file != package or repository is None else None), bool(inside)

    def address(cause: Cause) -> Address:
        finding = cause.places[0].finding
        site, layer = finding.site, finding.source.layer
        if layer is None:
            return stage_of(cause.places[0])
        file, is_package = file_of(layer)
        if file is None:
            found = map(stage_of, cause.places)
            shown = next((each for each in found if not each.is_absolute), None)
            return (shown or stage_of(cause.places[0]))._replace(outside=site.layer)
        if is_package:
            return Address(file, outside=site.layer)
        return Address(file, site.line, site.column)

    return address


def stage_addresses(report: Report, repository: str | None) -> Callable[[Place], Address]:
    """The address of the stage of each place: the line is that through which the layer comes in."""

    @cache
    def file_of(stage: int) -> str:
        path = report.stages[stage].path
        file, _ = split_package(below(canonical(path), repository) if repository else path)
        return file

    def address(place: Place) -> Address:
        line, column = place.finding.site.entry or (None, None)
        return Address(file_of(place.stage), line, column)

    return address
