"""Stages to test with: one Volume as text, and random ones of every kind from a seed.

`text` has what tests write by hand; all else generates, see `python -m tests.stages --help`.
"""

from .shown import by_stage
from .text import CONTENT, findings, only, package, said, volume, write

__all__ = ["CONTENT", "by_stage", "findings", "only", "package", "said", "volume", "write"]
