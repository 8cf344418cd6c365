"""What the command line and the configuration want of baselines."""

from __future__ import annotations

import posixpath
from typing import Any

import click

from usdvol_lint.baseline.moved import Move
from usdvol_lint.baseline.use import Prepared, Use, prepare
from usdvol_lint.config import Config
from usdvol_lint.model import UsageError
from usdvol_lint.paths import display

_NEEDING = ("prune_baseline", "fail_on_unpruned", "moved")


def prepared(given: dict[str, Any], config: Config) -> Prepared:
    """The baseline in use, read; raises UsageError for what is wrong with it, or left out.

    `config` is that with the command line on top, so that its baseline is the one in use.
    """
    if config.baseline is None:
        for name in _NEEDING:
            if given[name]:
                option = f"--{name.replace('_', '-')}"
                raise click.UsageError(f"{option} needs a baseline: name it with --baseline FILE")
    file = config.baseline
    if file and given["baseline"] is None:
        file = display(file)  # the configuration's folder stands before it
    moves = tuple(map(_move, given["moved"]))
    try:
        return prepare(Use(file, given["write_baseline"], given["prune_baseline"], moves))
    except UsageError as error:
        if given["baseline"] is not None or not file:
            raise
        raise UsageError(f"{config.origins.words('baseline')}: {error}") from error


def _move(pair: str) -> Move:
    """Two places in relation to the root, from `OLD=NEW`."""
    old, equals, new = (part.strip().replace("\\", "/").rstrip("/") for part in pair.partition("="))
    if not (old and equals and new):
        raise UsageError(f"--moved {pair}: write it as OLD=NEW, such as assets/smoke=lib/smoke")
    return posixpath.normpath(old), posixpath.normpath(new)
