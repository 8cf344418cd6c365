"""What parent and worker process say to each other, pickled over two pipes."""

from __future__ import annotations

from dataclasses import dataclass

from usdvol_lint.config import ActiveRules


@dataclass(frozen=True, slots=True)
class Setup:
    """The parent's first message: what a worker has to know before its first stage."""

    active: ActiveRules
    packs: tuple[str, ...]
    load: str
    content: str
    selections: int
    times: str | int
    statistics: bool


@dataclass(frozen=True, slots=True)
class Ready:
    """The worker's first message."""

    usd_version: str


@dataclass(frozen=True, slots=True)
class Refusal:
    """The worker's only message, where it can't work at all."""

    reason: str


@dataclass(frozen=True, slots=True)
class Advance:
    """So many samples of a long sequence were read; then comes more."""

    samples: int
