"""The frames of a sequence that hold other grids than most of its frames."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from usdvol_lint.facts.files.assets import Affected
from usdvol_lint.facts.grids.contents import Content
from usdvol_lint.facts.grids.timelines import FieldContents
from usdvol_lint.words import quoted

Grids: TypeAlias = tuple[tuple[str, tuple[str, ...]], ...]
"""The names of grids, in their order, each with the value types of the grids of that name."""


class GridChanges(NamedTuple):
    """The samples whose files differ from most, and how the first one does, in words.

    `is_asked_for`: whether a field names one of the grids that differ.
    """

    affected: Affected
    difference: str
    is_asked_for: bool


def find_grid_changes(fields: Sequence[FieldContents]) -> GridChanges | None:
    """Compares the frames of fields that share their files.

    Left out are files without grids or not read to their end, and frames that lack what one of the
    fields claims, which other rules report.
    None unless more than half of the frames agree: else it is open which ones differ.
    """
    first = fields[0]
    fits = ([fit for _, fit in field.timeline.answers(_fits)] for field in fields)
    all_fit = map(all, zip(*fits, strict=True))
    frames = [
        (sample, grids or ())
        for (sample, grids), fit in zip(first.timeline.answers(_grids), all_fit, strict=True)
        if fit and sample.time is not None
    ]
    counts = Counter(grids for _, grids in frames)
    usual, count = max(counts.items(), key=lambda item: item[1], default=((), 0))
    if not len(frames) / 2 < count < len(frames):
        return None
    differing = [(sample, grids) for sample, grids in frames if grids != usual]
    samples = tuple(sample for sample, _ in differing)
    affected = Affected(first.attribute, samples, first.timeline.total)
    selected = {name for field in fields for name in field.timeline.selected}
    changed = {name for _, grids in differing for name, _ in set(grids) ^ set(usual)}
    is_asked_for = not selected.isdisjoint(changed)
    return GridChanges(affected, _difference(dict(differing[0][1]), dict(usual)), is_asked_for)


def _fits(content: Content) -> bool:
    """Whether a file was read to its end and has what the field claims."""
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
    retyped = (
        f"has {quoted(name)} as {' and '.join(grids[name])} instead of {' and '.join(usual[name])}"
        for name in sorted(grids.keys() & usual.keys())
        if grids[name] != usual[name]
    )
    words = [f"lacks {_listed(lacking)}" if lacking else "", *retyped]
    words.append(f"also has {_listed(added)}" if added else "")
    return ", ".join(filter(None, words))


def _listed(names: Iterable[str]) -> str:
    first, *more = map(repr, sorted(names))
    return f"{first} and {len(more)} more" if len(more) > 2 else ", ".join([first, *more])
