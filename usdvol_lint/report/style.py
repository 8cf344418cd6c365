"""Colour for terminals: no other module writes escape codes."""

from __future__ import annotations

from usdvol_lint.model import Severity

SEVERITY_STYLES = {
    Severity.ERROR: "bold red",
    Severity.WARNING: "bold yellow",
    Severity.INFO: "bold cyan",
}


def paint(text: str, style: str, color: bool) -> str:
    """Text in a style of rich, such as `bold red`; without `color` the text itself.

    Text has to be printable already: see `words.printable`.
    """
    if not color:
        return text
    # Importing rich takes longer than importing all formats, and most runs have no colour.
    from rich.color import ColorSystem
    from rich.style import Style

    return Style.parse(style).render(text, color_system=ColorSystem.STANDARD)
