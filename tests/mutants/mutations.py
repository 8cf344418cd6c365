"""The list of mutations, and how one is put into a checkout."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
_LIST = Path(__file__).with_name("mutations.toml")
_SOURCES = "usdvol_lint", "rules"


class DoesNotApplyError(Exception):
    """The code has changed, and the list must follow."""


@dataclass(frozen=True, slots=True)
class Mutation:
    """`old` becomes `new`, wherever it stands, and the tests named are to see it.

    `old` is found once in all code, so that it stays known in whatever module it moves to; where
    several modules hold it, `module` names the one that is meant, by its name and not its folder.
    `seen_by` is, for each test module, what is handed to pytest as `-k`.
    Where `usd` is given, nothing but that version of usd-core shows the difference.
    """

    id: str
    old: str
    new: str
    seen_by: Mapping[str, str]
    module: str = ""
    usd: str = ""

    def applied(self, root: Path) -> tuple[Path, str]:
        """The file of a checkout that changes, and what it then holds."""
        texts = {path: path.read_text("utf-8") for path in _sources(root, self.module)}
        holders = [path for path, text in texts.items() if self.old in text]
        if len(holders) != 1 or texts[holders[0]].count(self.old) != 1:
            where = f"modules called {self.module}" if self.module else "all modules"
            raise DoesNotApplyError(
                f"{self.old!r} is not found exactly once, but "
                f"{sum(text.count(self.old) for text in texts.values())} times in {where}"
            )
        return holders[0], texts[holders[0]].replace(self.old, self.new)


def read_mutations(path: Path = _LIST) -> list[Mutation]:
    entries = tomllib.loads(path.read_text("utf-8"))["mutation"]
    return [Mutation(**entry) for entry in entries]


def module_of_tests(root: Path, name: str) -> Path:
    """The test module of that name, in whatever folder."""
    found = list((root / "tests").rglob(f"{name}.py"))
    if len(found) != 1:
        raise DoesNotApplyError(f"there are {len(found)} test modules called {name}.py")
    return found[0]


def _sources(root: Path, name: str) -> list[Path]:
    """The modules of that name, or all; a package goes by the name of its folder."""
    return [
        path
        for folder in _SOURCES
        for path in sorted((root / folder).rglob("*.py"))
        if not name or name in (path.stem, path.parent.name if path.stem == "__init__" else "")
    ]
