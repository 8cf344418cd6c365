"""Where along a sequence a file holds other grids than most."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from usdvol_lint.facts.files.assets import Affected
from usdvol_lint.facts.grids.contents import Content
from usdvol_lint.facts.grids.timelines import FieldContents
from usdvol_lint.model import quoted

Grids: TypeAlias = tuple[tuple[str, tuple[str, ...]], ...]
"""The names of grids, in their order, each with the value types of the grids of that name."""


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
    first = fields[0]
    fits = zip(
        *([fit for _, fit in field.timeline.answers(_fits)] for field in fields), strict=True
    )
    frames = [
        (sample, grids or ())
        for (sample, grids), fit in zip(first.timeline.answers(_grids), fits, strict=True)
        if sample.time is not None and all(fit)
    ]
    counts = Counter(grids for _, grids in frames)
    usual, count = max(counts.items(), key=lambda item: item[1], default=((), 0))
    if not len(frames) / 2 < count < len(frames):
        return None
    differing = [(sample, grids) for sample, grids in frames if grids != usual]
    found = Affected(
        first.attribute, tuple(sample for sample, _ in differing), first.timeline.total
    )
    return GridChanges(found, _difference(dict(differing[0][1]), dict(usual)))


def _fits(content: Content) -> bool:
    file, claim, grid = content.file, content.claim, content.grid
    if file is None or not file.complete or not file.grids or (claim.name and not grid):
        return False
    return not (claim.data_type and grid) or claim.data_type in content.data_types


def _grids(content: Content) -> Grids:
    grids: dict[str, tuple[str, ...]] = defaultdict(tuple)
    for grid in content.file.grids if content.file else ():
        grids[grid.unique_name] += (grid.value_type,)
    return tuple(sorted(grids.items()))


def _difference(grids: Mapping[str, tuple[str, ...]], usual: Mapping[str, tuple[str, ...]]) -> str:
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
