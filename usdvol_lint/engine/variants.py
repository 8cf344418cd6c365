"""The other variant selections of a stage that may show what we check, composed one by one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from heapq import heappop, heappush
from itertools import count
from typing import Any, NamedTuple

from pxr import Sdf, Usd

from usdvol_lint.engine.variant_sets import (
    Variant,
    VariantsDeclared,
    VariantSet,
    VariantSets,
    VariantSpec,
    may_bring,
    survey,
)
from usdvol_lint.facts.usd.clips import concerns_only_clips
from usdvol_lint.facts.usd.diagnostics import UNREADABLE, Unreadable
from usdvol_lint.facts.usd.indices import recomposed
from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.rule import NotChecked

_NAMED = 3


class _Choice(NamedTuple):
    """A selection to compose; the fields are in the order of precedence for the queue.

    `unknown` says that no prim that we check is known to be there, `is_repeated` that all of
    `specs`, which hold the variant's opinions, were composed elsewhere already; `number` keeps
    the order of discovery.
    """

    unknown: bool
    is_repeated: bool
    number: int
    selection: Any
    specs: frozenset[VariantSpec]


class OtherSelections:
    """The selections of a stage besides the authored ones; iterating composes them in turn.

    One variant set is switched at a time, and the others stay as authored; sets that only another
    variant brings are switched below that variant.
    Variants of prims that hold what we check come first, then those that were composed nowhere yet.
    At most `limit` are composed; the stage needs a session layer of its own.
    """

    def __init__(self, stage: Any, kinds: PrimKinds, limit: int) -> None:
        self.composed = 0
        self._stage = stage
        self._kinds = kinds
        self._limit = limit
        self._chosen: list[Any] = []
        self._waiting: list[_Choice] = []
        self._numbers = count()
        self._seen: set[tuple[Any, VariantSpec]] = set()
        self._variant_sets = VariantSets()
        self._looked_into: set[tuple[Any, bool, VariantsDeclared]] = set()
        self._composed_specs: set[VariantSpec] = set()
        self._out_of_reach: dict[frozenset[VariantSpec], str] = {}

    def __iter__(self) -> Iterator[tuple[str | None, Unreadable | None]]:
        """Each selection that shows or hides prims that we check, as a path: `/model{look=thin}`.

        The stage is composed that way until the next is asked for, or the error says why it can't
        be.  None instead of a path means that USD raised for the authored selections, so that
        their variants are not known.
        """
        try:
            self._explore(Sdf.Path.absoluteRootPath)
        except UNREADABLE as error:
            yield None, error
        while self._waiting and self.composed < self._limit:
            choice = heappop(self._waiting)
            if not choice.is_repeated and choice.specs <= self._composed_specs:
                heappush(self._waiting, choice._replace(is_repeated=True))
                continue
            self.composed += 1
            self._composed_specs |= choice.specs
            path = choice.selection.StripAllVariantSelections()
            try:
                self._compose(choice.selection)
                holders = self._explore(choice.selection)
            except UNREADABLE as error:
                yield str(choice.selection), error
            else:
                if not choice.unknown or path in holders or self._may_lack(path):
                    yield str(choice.selection), None

    def not_checked(self) -> Iterator[NotChecked]:
        """What iterating left out; ask once it is done."""
        root = self._stage.GetPseudoRoot()
        if left := len(self._waiting):
            one = left == 1
            yield NotChecked(
                f"{left} other variant selection{'' if one else 's'} {'was' if one else 'were'} "
                f"not composed: the limit is {self._limit}",
                at=root,
                suggestion="raise `variant-limit`, or check the assets with the variants by "
                "themselves",
            )
        if self._out_of_reach:
            prims = sorted(set(self._out_of_reach.values()))
            more = ", …" if len(prims) > _NAMED else ""
            yield NotChecked(
                "variant sets inside instances can't be selected from the stage, so only the "
                f"authored selections were checked: {', '.join(prims[:_NAMED])}{more}",
                at=root,
                suggestion="check the instanced assets by themselves",
            )

    def _compose(self, selection: Any) -> None:
        try:
            self._select(selection)
        except UNREADABLE as error:
            if not concerns_only_clips(error, self._stage):
                raise

    def _select(self, selection: Any) -> None:
        session = self._stage.GetSessionLayer()
        with Sdf.ChangeBlock():
            for path in self._chosen:
                session.GetPrimAtPath(path).ClearInfo("variantSelection")
            self._chosen.clear()
            for path, name, variant in _steps(selection):
                Sdf.CreatePrimInLayer(session, path).variantSelections[name] = variant
                self._chosen.append(path)
        recomposed(self._stage)

    def _may_lack(self, path: Any) -> bool:
        """Whether prims that we check may be below a path, in what was not composed or loaded."""
        return self._stage.GetLoadRules() != Usd.StageLoadRules.LoadAll() or any(
            error.rootSite.path.HasPrefix(path) for error in self._stage.GetCompositionErrors()
        )

    def _explore(self, selection: Any) -> set[Any]:
        """Queues the variants that a selection brings; returns the paths of `Survey.holders`."""
        above = selection.StripAllVariantSelections()
        chosen = {(path, name) for path, name, _ in _steps(selection)}
        found = survey(self._stage, self._stage.GetPrimAtPath(above), self._kinds)
        for prim in found.switches:
            path = prim.GetPath()
            unknown = path not in found.holders
            for variant_set in self._variant_sets.of(prim):
                self._take_selected(prim, variant_set)
                is_chosen = (path, variant_set.name) in chosen
                if not is_chosen and self._is_new(prim, unknown, variant_set):
                    self._queue(prim, unknown, path.ReplacePrefix(above, selection), variant_set)
        return found.holders

    def _take_selected(self, prim: Any, variant_set: VariantSet) -> None:
        specs = variant_set.variant(variant_set.selected).specs
        self._notice(prim, specs)
        self._composed_specs.update(specs)

    def _is_new(self, prim: Any, unknown: bool, variant_set: VariantSet) -> bool:
        """Whether the variants of a set of a prim were not looked into before."""
        key = (_noticed_as(prim), unknown, variant_set.declared)
        before = len(self._looked_into)
        self._looked_into.add(key)
        return len(self._looked_into) > before

    def _queue(self, prim: Any, unknown: bool, base: Any, variant_set: VariantSet) -> None:
        """Queues the variants of a set that are not selected, below a selection."""
        for variant in variant_set.others():
            if (unknown and not self._may_bring(variant)) or not self._notice(prim, variant.specs):
                continue
            specs = frozenset(variant.specs)
            if prim.IsInPrototype():
                self._out_of_reach[specs] = shown(prim).path
            else:
                switch = base.AppendVariantSelection(variant_set.name, variant.name)
                choice = _Choice(unknown, False, next(self._numbers), switch, specs)
                heappush(self._waiting, choice)

    def _may_bring(self, variant: Variant) -> bool:
        specs = (layer.GetPrimAtPath(path) for (_, path), layer in variant.specs.items())
        return any(may_bring(spec, self._kinds) for spec in specs)

    def _notice(self, prim: Any, specs: Iterable[VariantSpec]) -> bool:
        """Remembers a variant of a prim; says whether it is new there."""
        path = _noticed_as(prim)
        before = len(self._seen)
        self._seen.update((path, spec) for spec in specs)
        return len(self._seen) > before


def _noticed_as(prim: Any) -> Any | None:
    """What tells prims apart: their paths; of prims in prototypes nothing does."""
    return None if prim.IsInPrototype() else prim.GetPath()


def _steps(selection: Any) -> Iterator[tuple[Any, str, str]]:
    """The prims, variant sets and variants that a selection goes through, outermost first."""
    for path in selection.GetPrefixes():
        if path.IsPrimVariantSelectionPath():
            yield path.StripAllVariantSelections(), *path.GetVariantSelection()
