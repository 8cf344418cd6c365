"""Patterns as in a .gitignore match as pathspec has them, and no pattern takes long."""

from __future__ import annotations

import re
from pathlib import Path
from random import Random

import pytest
from pathspec import GitIgnoreSpec
from process import run, write

from usdvol_lint.gitignore import in_one_pass, spec_of

SLOW = [
    ("a*" * 25 + "b", "a" * 120),
    ("*a" * 3000, "a" * 255 + "b"),
    ("**/a/" * 12 + "b", "a/" * 100 + "c"),
    ("*[!b]*[!b]*[!b]*[!b]*[!b]*[!b]*[!b]*[!b]*b", "a" * 255),
]
"""To try all ways in which the stars may share such a path would take years."""


def patterns(random: Random) -> str:
    """Some segments of stars, classes and letters."""
    pieces = ("a", "b", "*", "*", "?", "[ab]", "[!a]", "\\*", "ab", ".")
    segments = [
        "**" if random.random() < 0.3 else "".join(random.choices(pieces, k=random.randint(1, 5)))
        for _ in range(random.randint(1, 5))
    ]
    return f"{random.choice(('', '', '/', '!'))}{'/'.join(segments)}{random.choice(('', '', '/'))}"


def paths(random: Random) -> str:
    names = ("".join(random.choices("aab.*", k=random.randint(1, 5))) for _ in range(6))
    return "/".join(list(names)[: random.randint(1, 6)])


def test_they_match_as_before() -> None:
    """But for classes, in which pathspec has the slash, and git has not."""
    random = Random(3)
    for _ in range(3_000):
        for pattern in GitIgnoreSpec.from_lines([patterns(random)]).patterns:
            if pattern.include is None:
                continue
            before = re.compile(pattern.regex.pattern.replace("[^a]", "[^a/]"))
            after = re.compile(in_one_pass(pattern.regex.pattern))
            for path in (paths(random) for _ in range(10)):
                one, other = before.search(path), after.search(path)
                told = f"{pattern.regex.pattern} on {path}"
                assert (one and one.groupdict()) == (other and other.groupdict()), told


@pytest.mark.parametrize(
    ("pattern", "path"),
    [
        ("**/a/**/b", "ab/a/x/b"),
        ("**/a?/**/b", "ax/ay/b"),
        ("x/**/a*/**/*b", "x/y/a/b/cb"),
        ("*a*b*c", "xabbac"),
        ("*[!a]*c/d", "bc/d/e"),
    ],
)
def test_what_is_found_first_need_not_be_it(pattern: str, path: str) -> None:
    assert spec_of([pattern]).match_file(path)


@pytest.mark.parametrize(("pattern", "path"), SLOW)
def test_no_pattern_takes_long(pattern: str, path: str) -> None:
    assert not spec_of([pattern]).match_file(path)
    assert spec_of([pattern, path]).match_file(path)


def test_a_pattern_of_a_stranger_does_not_hang_a_run(tmp_path: Path) -> None:
    pattern, name = SLOW[0]
    (tmp_path / "usdvol-lint.toml").write_text(
        f'exclude = ["{pattern}"]\nassume-present = ["{pattern}c"]\n', encoding="utf-8"
    )
    text = f'#usda 1.0\ndef OpenVDBAsset "f"\n{{\n    asset filePath = @./{name}.vdb@\n}}\n'
    write(tmp_path, **{name: text})
    ran = run(".", "--select", "AST002", cwd=tmp_path)
    assert (ran.code, ran.err) == (1, "")
