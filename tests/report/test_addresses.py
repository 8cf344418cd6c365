"""Where a code host shows a cause: a file that it has, whatever layer is to blame."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from reports import found, report

from usdvol_lint.model import Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.paths import canonical
from usdvol_lint.report.addresses import Address, addresses, stage_addresses
from usdvol_lint.results import Cause, Report

SITE = Site("shown.usda", "/A", line=7, column=3)


def blamed(layer: str | None, site: Site = SITE) -> Finding:
    """A mistake in that layer, seen at this site."""
    plain = found("AST002", "file-missing", Severity.ERROR, "no file", site)
    return plain._replace(source=Source(layer, "/A"))


def shown(*stages: tuple[str, Finding]) -> tuple[Report, Cause]:
    """The report on stages that show one mistake, and that one."""
    subject = report(
        *(StageReport(path, Status.CHECKED, findings=(finding,)) for path, finding in stages)
    )
    (cause,) = subject.causes
    return subject, cause


@pytest.fixture
def repository(tmp_path: Path) -> str:
    return canonical(str(tmp_path / "repository"))


@pytest.fixture
def elsewhere(tmp_path: Path) -> str:
    return canonical(str(tmp_path / "repository-of-others"))


def test_a_layer_of_the_repository_is_its_own_place(repository: str) -> None:
    layer = f"{repository}/assets/tank.usda"
    subject, cause = shown((f"{repository}/shot.usda", blamed(layer)))
    assert addresses(subject, repository)(cause) == Address("assets/tank.usda", 7, 3)


@pytest.mark.parametrize("entry", [(4, 26), None])
def test_a_layer_from_elsewhere_is_shown_where_it_comes_in(
    entry: tuple[int, int] | None, repository: str, elsewhere: str
) -> None:
    """A folder whose name only begins like that of the repository is another one."""
    layer = f"{elsewhere}/tank.usda"
    site = SITE._replace(layer="../tank.usda", entry=entry)
    subject, cause = shown((f"{repository}/shots/shot.usda", blamed(layer, site)))
    line, column = entry or (None, None)
    expected = Address("shots/shot.usda", line, column, outside="../tank.usda")
    assert addresses(subject, repository)(cause) == expected


def test_the_first_stage_of_the_repository_shows_it(repository: str, elsewhere: str) -> None:
    layer = f"{elsewhere}/tank.usda"
    subject, cause = shown(
        (layer, blamed(layer)),
        (f"{repository}/b.usda", blamed(layer, SITE._replace(entry=(5, 1)))),
        (f"{repository}/c.usda", blamed(layer, SITE._replace(entry=(6, 1)))),
    )
    address_of = addresses(subject, repository)
    assert address_of(cause) == Address("b.usda", 5, 1, outside="shown.usda")
    assert not address_of(cause).is_absolute
    alone, cause = shown((layer, blamed(layer)))
    assert addresses(alone, repository)(cause) == Address(layer, outside="shown.usda")
    assert addresses(alone, repository)(cause).is_absolute


def test_what_stands_in_no_file_is_shown_at_the_stage(repository: str) -> None:
    """An anonymous layer is named; a machine that lacks something has no name."""
    stage = f"{repository}/shot.usda"
    for layer, outside in (("anon:0x1:made.usda", "shown.usda"), (None, "")):
        subject, cause = shown((stage, blamed(layer)))
        assert addresses(subject, repository)(cause) == Address("shot.usda", outside=outside)


def test_a_package_stands_for_what_is_in_it(repository: str) -> None:
    """The line is one of a file that the host can't show."""
    package = f"{repository}/tank.usdz"
    for layer in (f"{package}[tank.usda]", f"{package}[a.usdz[tank.usda]]"):
        subject, cause = shown((package, blamed(layer)))
        expected = Address("tank.usdz", outside="shown.usda")
        assert addresses(subject, repository)(cause) == expected


def test_stages_go_by_their_real_paths(repository: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are named in relation to the working directory, which may be any folder."""
    folder = Path(repository) / "shots"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    subject, cause = shown(("../shots/./shot.usda", blamed(None)))
    assert stage_addresses(subject, repository)(cause.places[0]) == Address("shots/shot.usda")
    if os.name == "posix":
        (folder / "link").symlink_to(".")
        subject, cause = shown(("link/shot.usda", blamed(None)))
        assert addresses(subject, repository)(cause) == Address("shots/shot.usda")


def test_without_a_repository_paths_are_as_they_are() -> None:
    subject, cause = shown(("shots/shot.usda", blamed("assets/tank.usda")))
    assert addresses(subject, None)(cause) == Address("assets/tank.usda", 7, 3)
    subject, cause = shown(("shots/shot.usda", blamed(None)))
    assert addresses(subject, None)(cause) == Address("shots/shot.usda")
