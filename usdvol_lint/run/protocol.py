"""What parent and worker process say to each other, pickled over two pipes."""

from __future__ import annotations

from typing import NamedTuple

from usdvol_lint.config import Depth
from usdvol_lint.model import Finding
from usdvol_lint.packs.activation import ActiveRules


class Setup(NamedTuple):
    """The parent's first message: what a worker has to know before its first stage."""

    active: ActiveRules
    packs: tuple[str, ...]
    depth: Depth


class Ready(NamedTuple):
    """The worker's first message."""

    usd_version: str


class Refusal(NamedTuple):
    """The worker's only message, where it can't work at all."""

    reason: str


class Found(NamedTuple):
    """What was found of a stage since the worker last told; then comes more."""

    findings: list[Finding]


class Advance(NamedTuple):
    """So many samples of a long sequence were read; then comes more."""

    samples: int
