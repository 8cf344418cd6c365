"""How texts and times are written in a line: in quotes, printable, as ranges of frames."""

from __future__ import annotations

from collections.abc import Sequence

_UNITS = ((1 << 40, "T"), (1 << 30, "G"), (1 << 20, "M"), (1 << 10, "K"))
_LONGEST_QUOTE = 500
_LONGEST_WORD = 4_096
_MOST_COUNTED = 10**12


def quoted(text: str) -> str:
    """Text in quotes, unchanged, backslashes too, but for what `printable` escapes.

    Of a very long one the middle is left out, and its length said.
    """
    mark = '"' if "'" in text and '"' not in text else "'"
    return f"{mark}{printable(shortened(text, _LONGEST_QUOTE))}{mark}"


def shortened(text: str, longest: int) -> str:
    """A text that is not much longer than `longest`: what is left out in its middle is counted."""
    if len(text) <= longest:
        return text
    half = longest // 2
    return f"{text[:half]}… {len(text) - 2 * half:,} characters …{text[len(text) - half :]}"


def counted(number: int) -> str:
    """A number with commas; very large ones are more than one can imagine, and just that."""
    return f"{number:,}" if number <= _MOST_COUNTED else f"more than {_MOST_COUNTED:,}"


def printable(text: str) -> str:
    r"""Text on one line, in which characters that don't print are escaped: `\x1b`, `\u202e`.

    These are control characters, line breaks, bidirectional overrides, invisible characters,
    spaces other than U+0020, and bytes that could not be decoded (`\xff`).
    Of a word that is longer than any path of a file, such as the path of a prim may be, the middle
    is left out, and its length said.
    """
    if len(text) > _LONGEST_WORD:
        text = _with_short_words(text)
    if not text.isprintable():
        text = "".join(map(_visible, text))
    # `##[` and `##vso[` are commands to CI hosts, wherever they stand in a line of a log.
    return text.replace("##[", "#\\x23[").replace("##vso[", "#\\x23vso[") if "##" in text else text


def _with_short_words(text: str) -> str:
    import re  # costs start-up time, and few texts are long

    def short(word: re.Match[str]) -> str:
        return word[0] if len(word[0]) <= _LONGEST_WORD else shortened(word[0], _LONGEST_QUOTE)

    return re.sub(r"\S+", short, text)


def without_commands(json: str) -> str:
    """JSON in which no CI host finds a command of its own, in whatever log it is printed."""
    return json.replace("##", "#\\u0023") if "##" in json else json


def escaped(json: str) -> str:
    """JSON without what a terminal or a CI host would take for its own.

    Escaped is what `printable` escapes; lone surrogates would not even be valid UTF-8.
    """
    text = without_commands(json)
    if text.isascii() and "\x7f" not in text:
        return text
    are_all_visible = text.replace("\n", "").isprintable()
    return text if are_all_visible else "".join(map(_visible_in_json, text))


def _visible_in_json(char: str) -> str:
    if char.isprintable() or char == "\n":
        return char
    units = char.encode("utf-16-be", "surrogatepass").hex()
    return "".join(f"\\u{units[at : at + 4]}" for at in range(0, len(units), 4))


def _visible(char: str) -> str:
    if char.isprintable():
        return char
    point = ord(char)
    if 0xDC80 <= point <= 0xDCFF:  # a byte that could not be decoded, as a lone surrogate
        point -= 0xDC00
    if point <= 0xFF:
        return f"\\x{point:02x}"
    return f"\\u{point:04x}" if point <= 0xFFFF else f"\\U{point:08x}"


def format_time(time: float) -> str:
    """A time code without superfluous decimals: `101`, `101.5`, never `101.0`."""
    rounded = round(time, 6)
    return repr(rounded or 0.0).removesuffix(".0")


def from_to(first: float, last: float) -> str:
    """`1-10`; `-3 to 1` where a hyphen would be taken for a sign, or joins more than digits."""
    ends = format_time(first), format_time(last)
    are_plain = all(end.replace(".", "").isdigit() for end in ends)
    return ("-" if are_plain else " to ").join(ends)


def frame_ranges(times: Sequence[float]) -> str:
    """Ascending time codes as ranges: `102-104, 117`; a step other than 1 is added, `0-10x2`."""
    parts: list[str] = []
    start = 0
    while start < len(times):
        stop = _end_of_run(times, start)
        step = times[start + 1] - times[start] if stop - start > 1 else 0.0
        if stop - start > 2 or _same(step, 1.0):
            suffix = "" if _same(step, 1.0) else f"x{format_time(step)}"
            parts.append(from_to(times[start], times[stop - 1]) + suffix)
            start = stop
        else:
            parts.append(format_time(times[start]))
            start += 1
    return ", ".join(parts)


def _end_of_run(times: Sequence[float], start: int) -> int:
    """The index after the last of the evenly spaced times that begin at index `start`."""
    stop = start + 2
    if stop > len(times):
        return len(times)
    step = times[start + 1] - times[start]
    while stop < len(times) and _same(times[stop] - times[stop - 1], step):
        stop += 1
    return stop


def _same(one: float, other: float) -> bool:
    return abs(one - other) < 1e-6


def format_size(size: float) -> str:
    """A number of bytes as `--memory-limit` takes it: `512M`, `4G`, `1.25G`."""
    unit, letter = next((each for each in _UNITS if size >= each[0]), _UNITS[-1])
    return f"{size / unit:.4g}{letter}"
