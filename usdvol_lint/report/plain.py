"""What may reach a terminal: foreign text made harmless, and the only escape codes of our own."""

from __future__ import annotations


def printable(text: str) -> str:
    r"""Text from a stage as one visible line: what does not print is shown as `\x1b` or `\u202e`.

    That covers control characters, line breaks, bidirectional overrides, invisible characters,
    spaces that only look like one, and bytes that were never text (`\xff`).
    """
    return text if text.isprintable() else "".join(map(_visible, text))


def _visible(char: str) -> str:
    if char.isprintable():
        return char
    point = ord(char)
    if 0xDC80 <= point <= 0xDCFF:  # a byte that Python could not decode in a file name
        point -= 0xDC00
    if point <= 0xFF:
        return f"\\x{point:02x}"
    return f"\\u{point:04x}" if point <= 0xFFFF else f"\\U{point:08x}"


def paint(text: str, style: str, color: bool) -> str:
    """Printable text in a style of rich, such as `bold red`; as it is without colour."""
    if not color:
        return text
    # rich costs more start-up time than all our formats together, and most runs have no colour.
    from rich.color import ColorSystem
    from rich.style import Style

    return Style.parse(style).render(text, color_system=ColorSystem.STANDARD)
