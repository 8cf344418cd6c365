"""Which spec is to blame for a problem: where somebody has to edit, whatever shows it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile
from typing import Any, NamedTuple

from pxr import Sdf, Usd

from usdvol_lint.engine.fallbacks import losing_fallback
from usdvol_lint.engine.forwards import Forwards
from usdvol_lint.engine.leading import leading
from usdvol_lint.engine.restating import VALUES, first_alike, first_with
from usdvol_lint.engine.saying import has_value, maker, of_prim, weakest, with_metadata
from usdvol_lint.engine.strength import Opinion, Standing, decisive, path_beside, standing_of
from usdvol_lint.engine.sublayers import sublayer_path, sublayer_with
from usdvol_lint.engine.taking import Edit, Takings
from usdvol_lint.engine.variables import deciding_layer
from usdvol_lint.facts.usd.bringing import node_of
from usdvol_lint.facts.usd.calls import (
    get_name,
    get_parent,
    get_prim,
    get_property_stack,
    get_stage,
    has_metadata,
    is_pseudo_root,
)
from usdvol_lint.facts.usd.clips import ClipSet, clip_sets_on
from usdvol_lint.facts.usd.firsts import first_to_say
from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.rule import CLIPS, NAME, TYPE, VALUED_NAME, NotChecked, Problem


class Blame(NamedTuple):
    """What is to blame: a spec, or None where a stage is nothing but what it holds.

    `time` is the first time of the problem in the time of the spec's layer, and `offset` leads from
    there to the stage's; both are None where the problem is at no time, or the spec holds no value.
    `property` and `subject` tell what it is about at the spec; `clip` is the clip that holds the
    value where the spec is the one with the clips, `asset` a path to look for in the spec.
    `clean` is the name of the layer that has no such problem by itself: the spec is what makes one,
    `instead_of` the one there.
    `beside` are the specs of the weaker opinions that it contradicts.
    """

    spec: Any | None
    property: str | None = None
    subject: str = ""
    time: float | None = None
    offset: Any | None = None
    clip: str | None = None
    asset: str | None = None
    clean: str = ""
    beside: tuple[Any, ...] = ()
    instead_of: Any | None = None


class Blaming:
    """Finds what is to blame for the problems of one stage; the clips of a prim are read once."""

    def __init__(self) -> None:
        self._root: Any | None = None
        self._has_variables: bool | None = None
        self._takings = Takings()
        self._forwards: Forwards[Blame] = Forwards()
        self._clip_sets: dict[Any, list[tuple[ClipSet, frozenset[str]]]] = {}

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._takings.recomposed()
        self._forwards.recomposed()
        self._clip_sets.clear()

    def blame(self, problem: Problem | NotChecked) -> Blame:
        """What is to blame for a problem."""
        own = self._own(problem)
        if problem.against or problem.absent or _is_relationship(problem.at):
            return self._decided(problem, own)
        return own

    def _decided(self, problem: Problem | NotChecked, own: Blame) -> Blame:
        """Which of the opinions that bring about a problem is to blame for it."""
        at, prim = problem.at, get_prim(problem.at)
        others = [each for other in problem.against if (each := self._opinion(other, problem))]
        if _is_relationship(at):
            others += self._forwards.behind(at, self._standing)
        if edit := self._edit(problem, own):
            others.append((edit.prim, Blame(edit.spec, clean=_name_beside(edit.spec, edit.kept))))
        if own.spec is None or not others:
            return own
        opinions = [
            Opinion(prim, own.spec),
            *(Opinion(get_prim(each), blame.spec) for each, blame in others),
        ]
        found = decisive(opinions)
        beside = tuple(each.spec for each in opinions if each.spec != found.spec)
        if found.spec == own.spec:
            return own._replace(beside=beside)
        theirs = next((blame for _, blame in others if blame.spec == found.spec), Blame(found.spec))
        path = "" if problem.subject else _path_of(at, prim, found.spec)
        name = theirs.property if theirs.clip else _property_of(found.spec)
        name = name or (None if path else own.property)
        subject = problem.subject or path or theirs.subject
        return theirs._replace(property=name, subject=subject, beside=beside)

    def _standing(self, relationship: Any) -> tuple[Blame, Standing] | None:
        """What is to blame for where a relationship leads, and how it stands."""
        blame = self._own(Problem("", at=relationship))
        opinion = Opinion(relationship.GetPrim(), blame.spec)
        standing = standing_of(opinion) if blame.spec else None
        return (blame, standing) if standing else None

    def _edit(self, problem: Problem | NotChecked, own: Blame) -> Edit | None:
        """The edit of another layer that takes away what is missing."""
        may_miss = problem.absent or _is_relationship(problem.at)
        if not may_miss or own.spec is None:
            return None
        if self._root is None:
            self._root = get_stage(problem.at).GetRootLayer()
        return self._takings.edit(problem) if own.spec.layer != self._root else None

    def _own(self, problem: Problem | NotChecked) -> Blame:
        """The spec whose opinion counts where the problem is."""
        at, subject = problem.at, problem.subject
        if not isinstance(at, Usd.Property):
            prim = get_prim(at)
            if blocked := _blocked(problem):
                return Blame(blocked, str(blocked.name), subject)
            if problem.of == TYPE and (losing := losing_fallback(prim)):
                return Blame(losing, None, subject or str(prim.GetTypeName()))
            given = problem.spec and first_alike(prim, problem.spec, problem.of)
            return Blame(given or of_prim(prim, problem.of), None, subject)
        name = get_name(at)
        if problem.spec:
            return _given(problem, name)
        if problem.of in (NAME, VALUED_NAME):
            return Blame(
                weakest(at, problem.of == VALUED_NAME) or maker(get_prim(at)), name, subject
            )
        if problem.of == CLIPS and (clips := self._clips_reaching(at)):
            return _of_clips(at, clips, subject)
        if isinstance(problem.of, str) and (spec := first_with(get_property_stack(at), problem.of)):
            return Blame(spec, name, subject)
        if isinstance(at, Usd.Attribute) and (problem.at_default or problem.times):
            time = None if problem.at_default else problem.times[0]
            if found := self._value(at, time, name, subject):
                return found
        if _is_relationship(at):
            spec = leading(at) or weakest(at)
        else:
            stack = get_property_stack(at)
            is_absent = problem.absent and all(map(_is_block, filter(has_value, stack)))
            spec = None if is_absent else first_with(stack, *VALUES)
        return Blame(spec or _declared(maker(get_prim(at)), name), name, subject)

    def _value(self, attribute: Any, time: float | None, name: str, subject: str) -> Blame | None:
        """The spec with the value at a time of the stage; of one in clips, that with the clips."""
        found = first_to_say(attribute, time)
        if found is None:
            return None
        spec, offset = found
        local = None if time is None else offset.GetInverse() * time
        if self._says_variables(attribute) and (
            top := deciding_layer(get_prim(attribute), spec, local)
        ):
            return Blame(top.pseudoRoot, name, subject or str(spec.path))
        if time is None:
            return Blame(spec, name, subject, None, offset)
        prim = get_prim(attribute)
        if node_of(prim, spec) is None and (clips := self._clips_with(prim, spec.layer)):
            clip = next(each for each in clips.clips if each.resolvedPath == spec.layer.realPath)
            return _of_clips(attribute, clips, subject)._replace(clip=clips.named(clip))
        return Blame(spec, name, subject, local, offset)

    def _says_variables(self, at: Any) -> bool:
        """Whether any layer of the stage has expression variables, of which few stages have one."""
        if self._has_variables is None:
            layers = get_stage(at).GetUsedLayers()
            self._has_variables = any(layer.HasExpressionVariables() for layer in layers)
        return self._has_variables

    def _clips_with(self, prim: Any, layer: Any) -> ClipSet | None:
        """The clip set that has a layer among its clips, of a prim or the next one above it."""
        return next((each for each, paths in self._clips(prim) if layer.realPath in paths), None)

    def _clips_reaching(self, attribute: Any) -> ClipSet | None:
        """The clip set of which USD takes the values of an attribute."""
        every = (each for each, _ in self._clips(get_prim(attribute)))
        return next((each for each in every if not each.passes_over(attribute)), None)

    def _clips(self, prim: Any) -> Iterator[tuple[ClipSet, frozenset[str]]]:
        """The clip sets of a prim and of those above it, with the paths of their clips."""
        while not is_pseudo_root(prim):
            if has_metadata(prim, "clips"):
                if prim not in self._clip_sets:
                    self._clip_sets[prim] = [(each, _paths_of(each)) for each in clip_sets_on(prim)]
                yield from self._clip_sets[prim]
            prim = get_parent(prim)

    def _opinion(self, other: Any, problem: Problem | NotChecked) -> tuple[Any, Blame] | None:
        """The opinion of what contradicts: of a prim, a property, an occurrence or of metadata.

        A property counts with its value at the times of the problem.
        """
        if isinstance(other, tuple):
            at, of = other
            blame = Blame(of if isinstance(of, Sdf.Spec) else with_metadata(at, of))
        elif isinstance(other, Usd.Prim):
            at, blame = other, Blame(maker(other))
        elif isinstance(other, Usd.Property):
            at = other
            times, at_default = problem.times, problem.at_default
            blame = self._own(Problem("", at=at, times=times, at_default=at_default))
        else:
            at, blame = other.attribute, self._own(Problem("", at=other))
        return (at, blame) if blame.spec else None


def on_other(spec: Any, problem: Problem | NotChecked, clean: Any) -> Blame:
    """The blame of another spec than the `clean` one that a problem is of: it makes that wrong."""
    at, prim = problem.at, get_prim(problem.at)
    path = _path_of(at, prim, spec)
    name = _property_of(spec) or (None if path or at == prim else get_name(at))
    subject = " ".join(filter(None, (path, problem.subject)))
    is_root = spec.path == Sdf.Path.absoluteRootPath
    asset = sublayer_path(spec.layer, (clean.layer,)) if is_root else None
    name_of_clean = _name_beside(spec, clean)
    return Blame(spec, name, subject, asset=asset, clean=name_of_clean, instead_of=clean)


def _name_beside(spec: Any, other: Any) -> str:
    """The name of the layer of another spec; empty if it is the same layer."""
    return "" if spec.layer == other.layer else str(other.layer.GetDisplayName())


def _is_relationship(at: Any) -> bool:
    return isinstance(at, Usd.Relationship)


def _paths_of(clip_set: ClipSet) -> frozenset[str]:
    return frozenset(each.resolvedPath for each in clip_set.clips)


def _of_clips(attribute: Any, clips: ClipSet, subject: str) -> Blame:
    """The spec with the clips that bring the values of an attribute."""
    path = attribute.GetPath().MakeRelativePath(clips.prim.GetPath())
    bearer, offset = clips.first_opinion
    first = clips.named(clips.clips[0]) if clips.clips else None
    return Blame(bearer, "clips", subject or str(path), None, offset, asset=first)


def _given(problem: Problem | NotChecked, name: str | None) -> Blame:
    """The spec that the rule names; for the top of a layer also which sublayer it is about."""
    spec, at, subject = problem.spec, problem.at, problem.subject
    if spec.path != Sdf.Path.absoluteRootPath:
        return Blame(first_alike(get_prim(at), spec, problem.of), name, subject)
    sublayer = sublayer_with(at, spec.layer)
    subject = subject or sublayer or _path_of(at, at.GetPrim(), spec)
    return Blame(spec, name, subject, asset=sublayer)


def _blocked(problem: Problem | NotChecked) -> Any | None:
    """The spec that takes away what is absent, where a weaker one has it."""
    for prim, name in (lack for part in problem.absent for lack in part):
        prop = prim.GetProperty(name) if Sdf.Path.IsValidNamespacedIdentifier(name) else None
        values = [spec for spec in (prop.GetPropertyStack() if prop else ()) if has_value(spec)]
        blocks = list(takewhile(_is_block, values))
        if blocks and len(values) > len(blocks):
            return blocks[-1]
    return None


def _is_block(spec: Any) -> bool:
    return isinstance(spec, Sdf.AttributeSpec) and isinstance(spec.default, Sdf.ValueBlock)


def _declared(spec: Any | None, name: str) -> Any | None:
    """The property of a prim's spec, if that declares it, or else the prim's spec."""
    own = spec and spec.layer.GetPropertyAtPath(spec.path.AppendProperty(name))
    return own or spec


def _property_of(spec: Any) -> str | None:
    return str(spec.name) if spec.path.IsPropertyPath() else None


def _path_of(at: Any, prim: Any, spec: Any) -> str:
    """What a problem is about, as the layer to blame sees it; "" if that is of the same prim."""
    path = path_beside(prim, spec) or shown(prim).path
    if path == str(spec.path.GetPrimPath().StripAllVariantSelections()):
        return ""
    return f"{path}.{at.GetName()}" if isinstance(at, Usd.Property) else path
