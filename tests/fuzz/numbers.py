"""Numbers, texts and paths that readers stumble over."""

from __future__ import annotations

from random import Random

INTEGERS = (
    *(0, 1, -1, 7, 255, 256, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1, 2**32),
    *(2**53 + 1, 2**62, 2**63 - 1, 2**63, 2**64 - 1, -(2**31), -(2**62), -(2**63)),
)
NUMBERS = (
    *("0", "-0", "1", "-1", "nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "1e300", "1e16"),
    *("9007199254740993", "4611686018427387904", "0.1", "1e400", "99999999999999999999", "9" * 400),
)
TEXTS = (
    *("", " ", ".", "..", "/", "a/../b", "$F99999999999", "$F4", "${F5000}", "%05000d", "%d"),
    *("####", "#" * 300, "@" * 9, "<UDIM>", "<f99999>", "{frame:0999999d}", '`"${X}"`'),
    *("`if(1", "a" * 5000, "9" * 5000, "smoke." + "9" * 5000 + ".vdb", "smoke.0001.vdb"),
    *("\u202e\u2066", "\ufeff", "\u0661\u0662\u0663", "\u00e9", "e\u0301", "C:\\x", "~/x", "//h/s"),
    *("a.usdz[b.vdb]", "a.usdz[b.usdz[c.vdb]]", "file:///etc/passwd", "http://x/y.vdb", "op:/x"),
    *("\x1b[31m", "::error::x", "<script>", "]]>", "nul", "con.vdb", "x\x7fy", "/dev/zero"),
    *("name.1001.1002.1003.vdb", "v" + "1" * 300 + ".vdb", "." * 300, "a\x01b", "/proc/self/mem"),
)


def number(rng: Random) -> str:
    return rng.choice(NUMBERS)


def text(rng: Random) -> str:
    return rng.choice(TEXTS)


def quoted(words: str) -> str:
    """As a string of USD's text."""
    safe = words.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{safe}"'


def asset(words: str) -> str:
    """As an asset path of USD's text."""
    return f"@@@{words}@@@" if "@" in words else f"@{words}@"
