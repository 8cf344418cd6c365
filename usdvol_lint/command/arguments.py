"""How a command line is read, where click's own way would not do."""

from __future__ import annotations

import os
from collections.abc import Container, Iterable, Iterator

import click

OUTPUTS = "usdvol_lint.outputs"
"""Where a context has the formats and files of reports, in the order in which they are given."""


class Arguments(click.Command):
    """A command with an option whose value may be left out, though a path may follow it."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        from usdvol_lint.config import SUMMARIES

        if os.environ.get("PRE_COMMIT"):
            args = list(map(_as_path, args))
        ctx.meta[OUTPUTS] = list(outputs(args))
        following = [*args, ""][1:]
        return super().parse_args(
            ctx,
            [
                f"{each}={SUMMARIES[0]}" if each == "--summary" and after not in SUMMARIES else each
                for each, after in zip(args, following, strict=True)
            ],
        )


def outputs(arguments: Iterable[str]) -> Iterator[tuple[str, str]]:
    """The formats and files of reports in the order in which they are given."""
    return values_of(arguments, ("--output-format", "--output"))


def values_of(arguments: Iterable[str], names: Container[str]) -> Iterator[tuple[str, str]]:
    """The options with these names, each with its value, in the order in which they are given."""
    following = iter(arguments)
    for each in following:
        if each == "--":
            return
        name, equals, value = each.partition("=")
        if name in names:
            yield name, value if equals else next(following, "")


def _as_path(argument: str) -> str:
    """A stage of a commit whose name begins as an option does, as the path that it is."""
    from usdvol_lint.paths import SUFFIXES

    is_stage = argument.startswith("-") and argument.lower().endswith(SUFFIXES)
    return os.path.join(os.curdir, argument) if is_stage and os.path.lexists(argument) else argument
