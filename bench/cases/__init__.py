"""What is measured: a module for each group of cases, with what makes their stages."""

from __future__ import annotations

from bench.case import Case
from bench.cases import particles, stages, startup, volumes

CASES: tuple[Case, ...] = (*startup.CASES, *stages.CASES, *volumes.CASES, *particles.CASES)
