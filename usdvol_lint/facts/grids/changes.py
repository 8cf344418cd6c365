"""Where along a sequence a file holds other grids than most."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

from usdvol_lint.facts.files.assets import Affected
from usdvol_lint.facts.grids.contents import Content, FieldContents
from usdvol_lint.model import quoted

_T = TypeVar("_T")

Grids: TypeAlias = Mapping[str, tuple[str, ...]]
"""The value types of the grids of each name."""


@dataclass(frozen=True, slots=True)
class GridChanges:
    """The samples whose files differ from most, and how the first one of them does, in words."""

    found: Affected
    difference: str


def find_grid_changes(fields: Sequence[FieldContents]) -> GridChanges | None:
    """Compares the frames of fields that share their files.

    Files without grids, and such as could not be read to their end, are left out; and so are
    frames in which some field does not find what it asks for, since that is said of the field.
    Where no more than half of the frames agree, nobody knows which are the odd ones.
    """
    first, fits, grids_of = fields[0], _by_kind(_fits), _by_kind(_grids)
    frames = [
        (contents[0].sample, grids_of(contents[0]))
        for contents in zip(*(field.all.contents for field in fields), strict=True)
        if contents[0].sample.time is not None and all(map(fits, contents))
    ]
    kinds = Counter(tuple(sorted(grids.items())) for _, grids in frames)
    commonest, count = max(kinds.items(), key=lambda item: item[1], default=((), 0))
    if not len(frames) / 2 < count < len(frames):
        return None
    usual = dict(commonest)
    differing = [(sample, grids) for sample, grids in frames if grids != usual]
    found = Affected(first.attribute, tuple(sample for sample, _ in differing), first.all.total)
    return GridChanges(found, _difference(differing[0][1], usual))


def _by_kind(ask: Callable[[Content], _T]) -> Callable[[Content], _T]:
    """The same question, asked once among contents of one kind."""
    answers: dict[Hashable, _T] = {}

    def answer(content: Content) -> _T:
        kind = (content.reading.layout, content.claim)
        if kind not in answers:
            answers[kind] = ask(content)
        return answers[kind]

    return answer


def _fits(content: Content) -> bool:
    file, claim, grid = content.file, content.claim, content.grid
    if file is None or not file.complete or not file.grids or (claim.name and not grid):
        return False
    return not (claim.data_type and grid) or claim.data_type in content.data_types


def _grids(content: Content) -> Grids:
    grids: dict[str, tuple[str, ...]] = defaultdict(tuple)
    for grid in content.file.grids if content.file else ():
        grids[grid.unique_name] += (grid.value_type,)
    return dict(grids)


def _difference(grids: Grids, usual: Grids) -> str:
    lacking = usual.keys() - grids.keys()
    added = grids.keys() - usual.keys()
    others = sorted(name for name in grids.keys() & usual.keys() if grids[name] != usual[name])
    retyped = (
        f"has {quoted(name)} as {' and '.join(grids[name])} instead of {' and '.join(usual[name])}"
        for name in others
    )
    words = [f"lacks {_listed(lacking)}" if lacking else "", *retyped]
    words.append(f"has {_listed(added)} beside" if added else "")
    return ", ".join(filter(None, words))


def _listed(names: Iterable[str]) -> str:
    first, *more = map(repr, sorted(names))
    return f"{first} and {len(more)} more" if len(more) > 2 else ", ".join([first, *more])
