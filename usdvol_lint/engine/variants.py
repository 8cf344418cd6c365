"""Every other variant selection of a stage that may show what we check, composed one at a time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from heapq import heappop, heappush
from itertools import chain, count
from typing import Any, NamedTuple, TypeAlias

from pxr import Sdf, Tf, Usd

from usdvol_lint import schema
from usdvol_lint.engine.site import blamed_spec
from usdvol_lint.facts.usd.clips import concerns_only_clips
from usdvol_lint.facts.usd.instances import path_in_prototype, shown
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.rule import STAGE, NotChecked, Problem, Rule

_OURS = frozenset(
    {
        *(schema.VOLUME, schema.FIELD, schema.PARTICLE_FIELD),
        *(schema.UNKNOWN_TYPE, schema.ABSTRACT_TYPE),
        *schema.API_INCLUDES,
    }
)
_BRINGS = (
    *("references", "payload", "inheritPaths", "specializes"),
    *("apiSchemas", "active", "variantSelection"),
)
"""What a spec without a type may say that puts prims on the stage, or changes what they are."""
_NAMED = 3

Identity: TypeAlias = tuple[str, ...]
VariantSpec: TypeAlias = tuple[str, str]
"""A variant in a layer: the layer's identifier, and the path in it."""


class _Survey(NamedTuple):
    """Part of the stage as it is composed: prims with variant sets, and where ours are.

    `holders` are the paths of our prims and of all prims above them.
    """

    switches: list[Any]
    holders: set[Any]


class _Choice(NamedTuple):
    """A selection to compose, in the order in which that is worth it.

    It is `unknown` whether there is anything of ours at all; `specs` hold the variant.
    """

    unknown: bool
    is_repeated: bool
    number: int
    selection: Any
    specs: frozenset[VariantSpec]


class OtherSelections:
    """The selections of a stage besides the authored ones: to iterate is to compose them in turn.

    One variant set is switched at a time, and the others stay as authored; sets that only another
    variant brings are switched below that variant.
    What is known to hold our prims comes first, then variants that were composed nowhere yet.
    The stage needs a session layer of its own.
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
        self._composed_specs: set[VariantSpec] = set()
        self._out_of_reach: dict[frozenset[VariantSpec], str] = {}

    def __iter__(self) -> Iterator[tuple[str | None, Tf.ErrorException | None]]:
        """Each selection that shows or hides something of ours, as a path: `/model{look=thin}`.

        The stage is composed that way until the next is asked for, or an error says why it can't
        be; for that of no selection, it can't be told what there is to select.
        """
        try:
            self._explore(Sdf.Path.absoluteRootPath)
        except Tf.ErrorException as error:
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
            except Tf.ErrorException as error:
                yield str(choice.selection), error
            else:
                if not choice.unknown or path in holders or self._may_lack(path):
                    yield str(choice.selection), None

    def not_checked(self) -> Iterator[NotChecked]:
        """What iterating left out."""
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
            places = sorted(set(self._out_of_reach.values()))
            more = ", …" if len(places) > _NAMED else ""
            yield NotChecked(
                "variant sets inside instances can't be selected from the stage, so only the "
                f"authored selections were checked: {', '.join(places[:_NAMED])}{more}",
                at=root,
                suggestion="check the instanced assets by themselves",
            )

    def _compose(self, selection: Any) -> None:
        try:
            self._select(selection)
        except Tf.ErrorException as error:
            if not concerns_only_clips(error, self._stage):
                raise

    def _select(self, selection: Any) -> None:
        session = self._stage.GetSessionLayer()
        with Sdf.ChangeBlock():
            for path in self._chosen:
                session.GetPrimAtPath(path).ClearInfo("variantSelection")
            self._chosen.clear()
            for path, name, variant in _choices(selection):
                Sdf.CreatePrimInLayer(session, path).variantSelections[name] = variant
                self._chosen.append(path)

    def _may_lack(self, path: Any) -> bool:
        """Whether something of ours may be below a prim in what could not be composed or loaded."""
        return self._stage.GetLoadRules() != Usd.StageLoadRules.LoadAll() or any(
            error.rootSite.path.HasPrefix(path) for error in self._stage.GetCompositionErrors()
        )

    def _explore(self, selection: Any) -> set[Any]:
        """Queues what a selection brings to choose from; says where something of ours is."""
        above = selection.StripAllVariantSelections()
        chosen = {(path, name) for path, name, _ in _choices(selection)}
        survey = self._survey(self._stage.GetPrimAtPath(above))
        for prim in survey.switches:
            path = prim.GetPath()
            unknown = path not in survey.holders
            for name, variant, is_selected, specs in _variants(prim):
                if is_selected:
                    self._notice(prim, specs)
                    self._composed_specs.update(specs)
                elif (
                    (path, name) not in chosen
                    and (not unknown or any(map(self._may_bring, specs.values())))
                    and self._notice(prim, specs)
                ):
                    place = path.ReplacePrefix(above, selection)
                    switch = place.AppendVariantSelection(name, variant)
                    self._queue(prim, unknown, switch, frozenset(specs))
        return survey.holders

    def _notice(self, prim: Any, specs: Iterable[VariantSpec]) -> bool:
        """Whether the prim never had this variant to choose from."""
        place = None if prim.IsInPrototype() else prim.GetPath()
        before = len(self._seen)
        self._seen.update((place, spec) for spec in specs)
        return len(self._seen) > before

    def _queue(self, prim: Any, unknown: bool, switch: Any, specs: frozenset[VariantSpec]) -> None:
        if prim.IsInPrototype():
            self._out_of_reach[specs] = shown(prim).path
        else:
            heappush(self._waiting, _Choice(unknown, False, next(self._numbers), switch, specs))

    def _survey(self, start: Any) -> _Survey:
        """Looks below a prim, and into all prototypes."""
        switches, ours = [], []
        starts = (*([start] if start else []), *self._stage.GetPrototypes())
        for prim in chain.from_iterable(map(Usd.PrimRange, starts)):
            if not _OURS.isdisjoint(self._kinds.names(self._kinds.key(prim))):
                ours.append(prim)
            if prim.HasVariantSets():
                switches.append(prim)
        return _Survey(switches, _holders(ours))

    def _may_bring(self, variant: Any) -> bool:
        """Whether a variant's spec, or one below it, may put something of ours on the stage."""
        waiting = [variant]
        while waiting:
            spec = waiting.pop()
            type_name = spec.typeName
            untyped = spec.specifier == Sdf.SpecifierDef and not type_name
            if untyped or not _OURS.isdisjoint(self._kinds.names((type_name,))):
                return True
            if any(map(spec.HasInfo, _BRINGS)):
                return True
            waiting += spec.nameChildren
            for variant_set in spec.variantSets.values():
                waiting += (inner.primSpec for inner in variant_set.variants.values())
        return False


def identity(rule: Rule, problem: Problem | NotChecked) -> Identity:
    """What is the same of one problem under several selections.

    Rules on the stage sum up, and what is in a prototype shows now at this instance, now at that
    one: there the words change with the selection, and the spec to blame is what counts.
    """
    spec = problem.spec or blamed_spec(problem)[0]
    place = (spec.layer.identifier, str(spec.path)) if spec else ("", "")
    kind = (rule.code, type(problem).__name__, *place, problem.asset or "")
    if STAGE in rule.on:
        return kind
    prim = problem.at.GetPrim()
    where = (path_in_prototype(prim), problem.at.GetName())
    return (*kind, *where) if prim.IsInPrototype() else (*kind, *where, problem.message)


def _choices(selection: Any) -> Iterator[tuple[Any, str, str]]:
    """The prims, variant sets and variants that a selection goes through, outermost first."""
    for path in selection.GetPrefixes():
        if path.IsPrimVariantSelectionPath():
            yield path.StripAllVariantSelections(), *path.GetVariantSelection()


def _variants(prim: Any) -> Iterator[tuple[str, str, bool, dict[VariantSpec, Any]]]:
    """Each variant of a prim: its set, its name, whether it is selected, its specs."""
    stack = prim.GetPrimStack()
    sets = prim.GetVariantSets()
    for name in sets.GetNames():
        selected = sets.GetVariantSelection(name)
        for variant in sets.GetVariantSet(name).GetVariantNames():
            specs = {}
            for spec in stack:
                variant_set = spec.variantSets.get(name)
                found = variant_set.variants.get(variant) if variant_set else None
                if found:
                    specs[spec.layer.identifier, str(found.path)] = found.primSpec
            yield name, variant, variant == selected, specs


def _holders(prims: Iterable[Any]) -> set[Any]:
    """The paths of the prims and of all above them; instances hold what their prototype does."""
    holders: set[Any] = set()
    waiting = list(prims)
    while waiting:
        prim = waiting.pop()
        while prim and prim.GetPath() not in holders:
            holders.add(prim.GetPath())
            if prim.IsPrototype():
                waiting += prim.GetInstances()
            prim = prim.GetParent()
    return holders
