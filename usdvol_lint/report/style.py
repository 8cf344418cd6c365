"""Colour on a terminal: the only escape codes that reach one."""

from __future__ import annotations


def paint(text: str, style: str, color: bool) -> str:
    """Printable text in a style of rich, such as `bold red`; as it is without colour."""
    if not color:
        return text
    # rich costs more start-up time than all our formats together, and most runs have no colour.
    from rich.color import ColorSystem
    from rich.style import Style

    return Style.parse(style).render(text, color_system=ColorSystem.STANDARD)
