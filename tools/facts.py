"""Prints what every wing of the facts knows of a prim: `python -m tools.facts STAGE PRIM`.

For the prim `/`, what they know of the stage as a whole.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterable, Iterator
from operator import attrgetter
from pprint import pformat
from typing import Any

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.engine.stage import open_stage
from usdvol_lint.engine.trouble import UnreadableStageError
from usdvol_lint.engine.walk import asked_by, walk
from usdvol_lint.facts import Context, Facts
from usdvol_lint.facts.found import Wing, column, fact, summary
from usdvol_lint.packs.catalog import load

_ABOUT = {
    "files": ("field", schema.FIELD_ASSET),
    "grids": ("field", schema.FIELD_ASSET),
    "volumes": ("volume", schema.VOLUME),
    "particles": ("prim", schema.PARTICLE_FIELD),
}
"""Wings that know something of prims of one schema alone, and what they call such a prim."""
_MOST_LINES = 12


def main(arguments: list[str]) -> int:
    """Prints each wing's facts, with the questions that raised."""
    if len(arguments) != 2:
        print("usage: python -m tools.facts STAGE PRIM", file=sys.stderr)
        return 2
    path, name = arguments
    try:
        stage = open_stage(path, "all")
    except UnreadableStageError as error:
        print(f"{path}: {error}", file=sys.stderr)
        return 2
    prim = stage.GetPrimAtPath(name)
    if not prim:
        print(f"{path} has no prim <{name}>", file=sys.stderr)
        return 2
    prim = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
    facts = facts_of(stage)
    if prim.IsPseudoRoot():
        return _print_stage(facts)
    for wing_name, wing in wings(facts):
        called, schema_name = _ABOUT.get(wing_name, ("prim", ""))
        if not schema_name or facts.prims.is_a(prim, schema_name):
            _print(wing_name, wing, known(wing, prim, called))
    return 0


def _print_stage(facts: Facts) -> int:
    """Prints what wings know of the stage as a whole."""
    for name, wing in wings(facts):
        if answers := list(known_of_stage(wing)):
            _print(name, wing, answers)
    return 0


def _print(name: str, wing: Wing, answers: Iterable[tuple[str, str]]) -> None:
    print(f"# {name}: {inspect.getdoc(type(wing))}".splitlines()[0])
    for question, answer in answers:
        print(f"{question}: {answer}")
    print()


def facts_of(stage: Any) -> Facts:
    """The facts of a stage for all rules, as the engine makes them."""
    context = Context.of(stage)
    walked = walk(stage, asked_by(load().rules.values()), context.kinds)
    return Facts(context, walked)


def wings(facts: Facts) -> Iterator[tuple[str, Wing]]:
    """The wings by name, lowest first."""
    yield from ((name, each) for name, each in vars(facts).items() if isinstance(each, Wing))


def known(wing: Wing, prim: Any, called: str) -> Iterator[tuple[str, str]]:
    """What a wing declares, and its methods that take one prim, with what they say of it."""
    for name, declared in vars(type(wing)).items():
        if not name.startswith("_") and (ask := _question(wing, name, declared, called)):
            yield name, _shown(ask, prim)


def known_of_stage(wing: Wing) -> Iterator[tuple[str, str]]:
    """What a wing declares of the stage, with what it says."""
    for name, declared in vars(type(wing)).items():
        if not name.startswith("_") and isinstance(declared, property | cached_property):
            yield name, _shown(attrgetter(name), wing)


def _question(wing: Wing, name: str, declared: Any, called: str) -> Callable[[Any], Any] | None:
    match declared:
        case column() | fact():
            return getattr(wing, name)  # type: ignore[no-any-return]
        case summary():
            return lambda prim: declared.keys(wing, _alone(wing, prim))[0]
    if not inspect.isfunction(declared):
        return None
    takes = list(inspect.signature(declared).parameters)
    return getattr(wing, name) if takes == ["self", called] else None


def _alone(wing: Wing, prim: Any) -> Any:
    table, row = wing.tables.find(prim)
    return table.alone(row)


def _shown(ask: Callable[[Any], Any], prim: Any) -> str:
    try:
        answer = ask(prim)
        text = pformat(list(answer) if isinstance(answer, Iterator) else answer, width=96)
        lines = text.splitlines()
        return "\n".join(lines[:_MOST_LINES] + ["…"] * (len(lines) > _MOST_LINES))
    except Exception as error:
        return f"{type(error).__name__}: {error}"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
