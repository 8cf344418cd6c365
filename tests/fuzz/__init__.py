"""Hostile inputs by seed and number, and what the command line makes of them.

See `python -m tests.fuzz --help`.
"""

import sys
from pathlib import Path

_TESTS = Path(__file__).resolve().parents[1]
# `python -m tests.fuzz` finds what all tests share, as pytest does.
sys.path += [path for path in (str(_TESTS), str(_TESTS.parent)) if path not in sys.path]
