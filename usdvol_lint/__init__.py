"""Finds what is broken in the volumes and particle fields of USD stages."""

from __future__ import annotations

TYPE_CHECKING = False  # as good as typing's, whose import would take half of the start-up time
if TYPE_CHECKING:
    from typing import Any

    from usdvol_lint.asserting import assert_clean
    from usdvol_lint.config import Config
    from usdvol_lint.model import Cover, Finding, Severity, Site, Source, Status, UsageError
    from usdvol_lint.results import Cause, Place, Report, StageResult, State
    from usdvol_lint.run.lint import lint

__version__ = "0.1.0"
__all__ = [
    "Cause",
    "Config",
    "Cover",
    "Finding",
    "Place",
    "Report",
    "Severity",
    "Site",
    "Source",
    "StageResult",
    "State",
    "Status",
    "UsageError",
    "__version__",
    "assert_clean",
    "lint",
]

_HOMES = {
    "Config": "config",
    "assert_clean": "asserting",
    "lint": "run.lint",
    **dict.fromkeys(("Cause", "Place", "Report", "StageResult", "State"), "results"),
}


def __getattr__(name: str) -> Any:
    """Public names are imported when they are first used: start-up time is a feature."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_HOMES.get(name, 'model')}"), name)
