"""The lists of applied APIs that USD drops because a name stands in one twice."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint import spelling
from usdvol_lint.facts.usd.kinds import is_registered, raw_apis

if TYPE_CHECKING:
    from usdvol_lint.layertext.source import LayerTexts

_ITEMS = {
    "": "explicitItems",
    "add": "addedItems",
    "prepend": "prependedItems",
    "append": "appendedItems",
}
"""Where a list that brings APIs belongs in a list op, by the word before it."""


class DroppedList(NamedTuple):
    """A list of `apiSchemas` in the text of a spec that USD does not have.

    `how` is the word before it; `names` are without repetition, and those that are misspelt as
    they are probably meant; `doubled` are the repeated ones, as written.
    """

    spec: Any
    how: str
    names: tuple[str, ...]
    doubled: tuple[str, ...]


def dropped_lists(prim: Any, applied: Iterable[str], texts: LayerTexts) -> tuple[DroppedList, ...]:
    """The lists that would bring a prim APIs beside those `applied` to it, strongest first.

    USD says nothing of them and keeps nothing, so they are looked for in the texts of the layers.
    """
    composed: list[str] = []
    dropped: list[DroppedList] = []
    for spec in reversed(prim.GetPrimStack()):
        operation = spec.GetInfo("apiSchemas")
        for found in _dropped_from(spec, texts):
            setattr(operation, _ITEMS[found.how], list(found.names))
            dropped.append(found)
        composed = operation.ApplyOperations(composed)
    lost = frozenset(composed).difference(applied, raw_apis(prim))
    return tuple(found for found in reversed(dropped) if not lost.isdisjoint(found.names))


def _dropped_from(spec: Any, texts: LayerTexts) -> list[DroppedList]:
    from usdvol_lint.layertext.lists import doubled_lists  # costs start-up time; few stages ask

    text = texts.of(spec.layer)
    lists = doubled_lists(text.heading(str(spec.path))) if text else {}
    return [
        DroppedList(spec, how, tuple(dict.fromkeys(map(_meant, names))), _doubled(names))
        for how, names in lists.items()
        if how in _ITEMS
    ]


def _meant(name: str) -> str:
    is_known = is_registered(name.partition(":")[0])
    return name if is_known else spelling.misspelt_api(name) or name


def _doubled(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(name for name in dict.fromkeys(names) if names.count(name) > 1)
