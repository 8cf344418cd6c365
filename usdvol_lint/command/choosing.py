"""Which files the command line asks for: arguments, lists, and what changed since a revision."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from usdvol_lint.command.settings import check_filled, read_settings
from usdvol_lint.config import Config
from usdvol_lint.config.files import nearer_files
from usdvol_lint.files import Changes, Listing
from usdvol_lint.paths import named
from usdvol_lint.words import printable, quoted


def arguments(paths: tuple[str, ...], given: dict[str, Any]) -> tuple[str, ...]:
    """The arguments, and the paths in the list that `--files-from` names."""
    check_filled(given)
    if given["files_from"] is None:
        return paths
    from usdvol_lint.files.lists import read_list

    return (*paths, *read_list(given["files_from"]))


def changes(
    paths: tuple[str, ...], given: dict[str, Any], config: Config, file: Path | None
) -> Changes | None:
    """What changed since the revision that `--changed-since` names; None without one."""
    revision = given["changed_since"]
    if revision is None:
        return None
    from usdvol_lint.files.changes import changes_since

    settings = (config.baseline, *config.origins.files, *config.packs, *_nearer(given, file))
    return changes_since(revision, paths, [path for path in settings if path])


def _nearer(given: dict[str, Any], file: Path | None) -> Iterator[str]:
    """The files that would be the configuration instead: one that is gone, or has no table now."""
    if given["config_file"] is None and not given["isolated"]:
        yield from map(str, nearer_files(Path.cwd(), file))


def shown(paths: tuple[str, ...], given: dict[str, Any]) -> tuple[Iterator[str], str]:
    """The lines of `--show-files`, and what to say beside them."""
    from usdvol_lint.files.listing import list_stages

    config, file = read_settings(given)
    paths = arguments(paths, given)
    listing = list_stages(paths, config.exclude, config.stages)
    changed = changes(paths, given, config, file)
    remark = f"nothing to check: {listing.nothing}" if listing.nothing else ""
    if changed and not changed.everything:
        if not changed.paths:
            return iter(()), f"nothing changed since {quoted(changed.since)}"
        remark = "which of them use what changed is seen when they are opened"
    return _lines(listing, bool(config.stages)), remark


def _lines(listing: Listing, are_declared: bool) -> Iterator[str]:
    """A path a line; where wholes are declared, after `whole` or `part`."""
    for stage in listing.stages:
        kind = ("part   " if stage.is_part else "whole  ") if are_declared else ""
        yield f"{kind}{printable(named(stage.path))}\n"
