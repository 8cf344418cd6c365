"""Which stages a run checks, each once, and which of them are only parts of others."""

from __future__ import annotations

from typing import NamedTuple


class Listed(NamedTuple):
    """A stage that a run checks; a part is judged by what is wrong in it, never by what is absent.

    `path` is the stage as the user named it or as it was found in a folder.
    """

    path: str
    is_part: bool = False


class Listing(NamedTuple):
    """The stages that a run checks; `nothing` says why there are none."""

    stages: tuple[Listed, ...]
    nothing: str = ""


class Changes(NamedTuple):
    """The files that differ from a revision, each by all of its names; `since` names that.

    Where `everything` is set, something changed that concerns every stage.
    """

    since: str
    paths: frozenset[str]
    everything: bool = False
