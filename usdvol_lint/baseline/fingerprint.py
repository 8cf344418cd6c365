"""The name of a cause, which is the same in every run on every machine."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from usdvol_lint.model import Source

FINGERPRINT_VERSION = 1
"""Of what, and how, fingerprints are made; those of another version match nothing."""


def fingerprint(code: str, source: Source) -> str:
    """16 hexadecimal digits; the layer of `source` is in relation to the root."""
    named = (code, source.layer or "", source.path or "", source.property or "", source.subject)
    # A name that could not be decoded holds lone surrogates.
    return str(_sha256()("\0".join(named).encode("utf-8", "surrogatepass")).hexdigest())[:16]


@cache
def _sha256() -> Callable[[bytes], Any]:
    from hashlib import sha256  # costs start-up time, and a healthy run needs none

    return sha256
