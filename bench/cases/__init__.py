"""All cases: a module for each group, with the functions that write its stages."""

from __future__ import annotations

from bench.case import Case
from bench.cases import findings, library, particles, stages, startup, volumes

CASES: tuple[Case, ...] = (
    *startup.CASES,
    *stages.CASES,
    *library.CASES,
    *findings.CASES,
    *volumes.CASES,
    *particles.CASES,
)
