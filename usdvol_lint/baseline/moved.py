"""Layers that moved: what is gone in one place and new in another, and entries renamed."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Sequence
from typing import TypeAlias

from usdvol_lint.baseline.entry import Entry, by_fingerprint
from usdvol_lint.baseline.file import Baseline
from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.baseline.scope import Scope, lies_in, outermost
from usdvol_lint.model import UsageError
from usdvol_lint.paths import SUFFIXES
from usdvol_lint.words import printable

Move: TypeAlias = tuple[str, str]


def renamed(baseline: Baseline, moves: Sequence[Move]) -> Baseline:
    """The baseline as it would be had layers and folders been called so before."""
    if not moves:
        return baseline
    ordered = sorted(moves, key=lambda move: -len(move[0]))  # a layer's own before its folder's
    entries = baseline.entries.values()
    for old, new in ordered:
        if all(_inside(entry.source.layer, old) is None for entry in entries):
            said = f"{baseline.file} has no entry of a layer there"
            hint = "write OLD as the baseline has it"
            raise UsageError(f"--moved {printable(old)}={printable(new)}: {said}, {hint}")
        if _names_layer(old) != _names_layer(new):
            said = "one of them is a layer and the other a folder"
            raise UsageError(f"--moved {printable(old)}={printable(new)}: {said}, name both alike")
    moved = by_fingerprint(_in_place(entry, ordered) for entry in entries)
    return baseline._replace(entries=moved, scope=_scope_in_place(baseline.scope, ordered))


def _names_layer(place: str) -> bool:
    return place.removesuffix("]").lower().endswith(SUFFIXES)


def _in_place(entry: Entry, moves: Sequence[Move]) -> Entry:
    layer = _renamed(entry.source.layer, moves)
    if layer == entry.source.layer:
        return entry
    source = entry.source._replace(layer=layer)
    return entry._replace(source=source, fingerprint=fingerprint(entry.code, source))


def _scope_in_place(scope: Scope, moves: Sequence[Move]) -> Scope:
    """What was looked at, with new places where the old ones were."""
    if scope.arguments is None:
        return scope
    arguments = [str(_renamed(argument, moves)) for argument in scope.arguments]
    for old, new in moves:
        if any(lies_in(old, argument) for argument in scope.arguments):
            arguments.append(new)
    return scope._replace(arguments=outermost(arguments))


def _renamed(path: str | None, moves: Sequence[Move]) -> str | None:
    found = ((new, _inside(path, old)) for old, new in moves)
    return next((f"{new}{rest}" for new, rest in found if rest is not None), path)


def _inside(layer: str | None, place: str) -> str | None:
    """What follows a layer's or a folder's name in that of a layer; None if it is another."""
    if layer is None or not layer.startswith(place):
        return None
    rest = layer[len(place) :]
    return rest if not rest or rest[0] in "/[" else None


def moves(gone: Iterable[Entry], new: Iterable[Entry]) -> tuple[Move, ...]:
    """Places in which the same is gone as is new in another one, each pair once.

    The more of their names two layers share at the end, the sooner they are taken for one.
    """
    left, come = _by_content(gone), _by_content(new)
    pairs = (
        pair
        for content in left.keys() & come.keys()
        for pair in _pairs(left[content], come[content])
    )
    return tuple(sorted({_shortest(*pair) for pair in pairs}))


def _by_content(entries: Iterable[Entry]) -> dict[Hashable, list[str]]:
    """The layers in which the same is to blame."""
    held: defaultdict[str, Counter[Hashable]] = defaultdict(Counter)
    for entry in entries:
        if entry.source.layer is not None:
            held[entry.source.layer][entry.code, *entry.source[1:]] += 1
    layers: defaultdict[Hashable, list[str]] = defaultdict(list)
    for layer, content in held.items():
        layers[frozenset(content.items())].append(layer)
    return layers


def _pairs(old: list[str], new: list[str]) -> Iterable[Move]:
    """Layers of which no other one shares as much of the name."""
    left, come = set(old), set(new)
    for length in range(max(len(_names(layer)) for layer in old), -1, -1):
        ours, theirs = _by_end(left, length), _by_end(come, length)
        for end in ours.keys() & theirs.keys():
            if len(ours[end]) == len(theirs[end]) == 1:
                yield ours[end][0], theirs[end][0]
                left.discard(ours[end][0])
                come.discard(theirs[end][0])


def _by_end(layers: Iterable[str], length: int) -> dict[Hashable, list[str]]:
    ends: defaultdict[Hashable, list[str]] = defaultdict(list)
    for layer in layers:
        names = _names(layer)
        ends[tuple(names[len(names) - length :])].append(layer)
    return ends


def _names(layer: str) -> list[str]:
    """The names in a path; what is named in a package is one."""
    outer, bracket, inner = layer.partition("[")
    return [*outer.split("/"), *([bracket + inner] if bracket else [])]


def _shortest(old: str, new: str) -> Move:
    """Two names without what they share at the end, of which at least one name each is left."""
    ours, theirs = _names(old), _names(new)
    while min(len(ours), len(theirs)) > 1 and ours[-1] == theirs[-1]:
        ours.pop()
        theirs.pop()
    return _path(ours), _path(theirs)


def _path(names: list[str]) -> str:
    return "/".join(names).replace("/[", "[")
