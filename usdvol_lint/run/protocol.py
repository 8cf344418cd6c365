"""The messages between the parent and a worker process, pickled over two pipes.

After `Setup` the parent sends paths, and the worker answers each with a StageReport.
"""

from __future__ import annotations

from typing import NamedTuple

from usdvol_lint.config import Depth
from usdvol_lint.model import Finding
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.suppressions import InStages


class Setup(NamedTuple):
    """The parent's first message: the rules to run, and how stages are to be checked."""

    active: ActiveRules
    packs: tuple[str, ...]
    depth: Depth
    suppressions: InStages


class Ready(NamedTuple):
    """The worker's answer to Setup."""

    usd_version: str


class Refusal(NamedTuple):
    """The worker's answer to Setup if it can't load USD or the rules."""

    reason: str


class NewFindings(NamedTuple):
    """Findings on a stage since the last such message; more messages about the stage follow."""

    findings: list[Finding]


class Advance(NamedTuple):
    """Samples of a long sequence read since the last such message; more messages follow."""

    samples: int
