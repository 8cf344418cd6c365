"""Which USD is installed."""

from __future__ import annotations

from pxr import Usd


def usd_version() -> str:
    """The installed USD's version, as its wheel spells it: `26.11`."""
    major, minor, patch = Usd.GetVersion()
    return ".".join(str(part) for part in (major, minor, patch)[0 if major else 1 :])
