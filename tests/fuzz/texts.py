"""Configurations, baselines and reports: those of real runs, changed, and hostile ones."""

from __future__ import annotations

import json
from random import Random

from .mutating import mutated_bytes, mutated_value
from .numbers import quoted, text

CONFIG = "usdvol-lint.toml"
PYPROJECT = "pyproject.toml"
_CONFIG = """select = ["AST", "VOL001"]
ignore = ["SCH007"]
fail-on = "warning"
timeout = 3
variant-limit = 9
frames = "1001-1100"
exclude = ["old/**"]
assume-present = ["*.0001.vdb"]
rules-as-of = "0.1"

[severity]
AST002 = "warning"

[path-map]
"/show" = "./"

[[per-path]]
paths = ["assets/**"]
severity = { VOL001 = "info" }

[[suppress]]
rules = ["AST002"]
layers = ["*.usda"]
reason = "known"
expires = 2031-01-01
"""


def configuration(rng: Random) -> bytes:
    """A configuration."""
    if rng.random() < 0.6:
        return _changed(rng, _CONFIG)
    return _hostile_toml(rng)


def pyproject(rng: Random) -> bytes:
    """A `pyproject.toml` with a table of ours, and those of others."""
    if rng.random() < 0.5:
        return b'[project]\nname = "x"\n[tool.usdvol-lint]\n' + _changed(rng, "timeout = 3\n")
    return b"[tool.usdvol-lint]\n" + _hostile_toml(rng)


def _hostile_toml(rng: Random) -> bytes:
    size = rng.choice((10, 3000, 30_000))
    hostile = (
        "a" + ".a" * size + " = 1\n",
        "select = " + "[" * size + "]" * size,
        "select = " + "{a=" * size,
        f"timeout = {'9' * size}",
        "timeout = nan\nvariant-limit = -1",
        f"timeout = 1e{size}",
        "variant-limit = 0x" + "f" * size,
        "exclude = [" + '"**/", ' * size + "]",
        f'exclude = ["{"*a" * size}"]',
        f"select = [{quoted(text(rng))}]",
        "extend = " + quoted(rng.choice((CONFIG, text(rng), "/dev/zero", "."))),
        'extend = "a\\u0000b"',
        f"{quoted(text(rng))} = {quoted(text(rng))}",
        "[" * size,
        "select = ['\0']",
        "a = 1\n" * 2,
        '"\\ud800" = 1',
        "expires = 9999-99-99",
    )
    return rng.choice(hostile).encode("utf-8", "surrogatepass")


def baseline(rng: Random, real: bytes) -> bytes:
    """A baseline, from one that a run wrote."""
    if rng.random() < 0.7:
        return _changed(rng, real.decode())
    lines = real.decode().splitlines()
    return rng.choice(_hostile_lines(rng, lines)).encode("utf-8", "surrogatepass")


def _hostile_lines(rng: Random, lines: list[str]) -> tuple[str, ...]:
    first, entry = lines[0], lines[-1]
    size = rng.choice((10, 3000))
    frames = ", ".join(["0-999990"] * size)
    wider = entry.replace('"frames":"all"', f'"frames":"{frames}"')
    return (
        "[" * size * 100,
        f"{first}\n{wider}\n",
        f'{first}\n{{"a":' + "9" * 5000 + "}\n",
        first.replace('"root":"', '"root":"' + rng.choice(("../" * size, "\\u0000", "\\ud800"))),
        "\n".join([first, *[entry] * size]),
        "\n" * size * 100,
        first + "\n<<<<<<< a\n" + entry,
        f'{first}\n{{"{text(rng)}": NaN}}\n',
    )


def report(rng: Random, real: bytes) -> bytes:
    """A JSON report of an earlier run, which is a baseline too."""
    if rng.random() < 0.7:
        return _changed(rng, real.decode())
    value = json.loads(real)
    key = rng.choice(sorted(value))
    value[key] = rng.choice((None, [], {}, -1, 1e308, "x" * 5000, [[]] * 500, value))
    if value[key] is value:
        value[key] = dict(value) | {key: None}
    return json.dumps(value).encode()


def _changed(rng: Random, real: str) -> bytes:
    changed = mutated_value(rng, real).encode("utf-8", "surrogatepass")
    return mutated_bytes(rng, changed) if rng.random() < 0.3 else changed
