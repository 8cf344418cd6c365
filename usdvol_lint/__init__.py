"""Finds what is broken in the volumes and particle fields of USD stages."""

from __future__ import annotations

TYPE_CHECKING = False  # as good as typing's, whose import would take half of the start-up time
if TYPE_CHECKING:
    from typing import Any

    from usdvol_lint.config import Config
    from usdvol_lint.model import Finding, Report, Severity, Site, StageReport, Status, UsageError
    from usdvol_lint.run.lint import lint

__version__ = "0.1.0"
__all__ = [
    "Config",
    "Finding",
    "Report",
    "Severity",
    "Site",
    "StageReport",
    "Status",
    "UsageError",
    "__version__",
    "lint",
]

_HOMES = {"Config": "config", "lint": "run.lint"}


def __getattr__(name: str) -> Any:
    """Public names are imported when they are first used: start-up time is a feature."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_HOMES.get(name, 'model')}"), name)
