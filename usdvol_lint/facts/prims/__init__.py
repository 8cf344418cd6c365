"""What is authored on prims, compared with what the schemas declare."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import filterfalse
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.deferred import deferred
from usdvol_lint.facts.found import Wing, column, fact, summary

with deferred(globals()):
    from usdvol_lint.facts.prims import (
        ancestors,
        animated,
        bounds,
        contradictions,
        data,
        encodings,
        extents,
        handed_down,
        nesting,
        transforms,
    )
    from usdvol_lint.facts.usd import dropped, hidden, instancers, instances, values
    from usdvol_lint.layertext import source

if TYPE_CHECKING:
    from usdvol_lint.facts.prims.attributes import Authored
    from usdvol_lint.facts.prims.contradictions import Misspelt, Mistyped, Unlisted
    from usdvol_lint.facts.prims.encodings import Encoding
    from usdvol_lint.facts.prims.extents import Limits
    from usdvol_lint.facts.prims.nesting import Nested, Nesting
    from usdvol_lint.facts.prims.tables import Table, Tables
    from usdvol_lint.facts.prims.transforms import TransformFaults
    from usdvol_lint.facts.usd.clips import Clips
    from usdvol_lint.facts.usd.drawn import Drawn
    from usdvol_lint.facts.usd.dropped import DroppedList
    from usdvol_lint.facts.usd.hidden import HiddenAnimation
    from usdvol_lint.facts.usd.kinds import PrimKinds
    from usdvol_lint.facts.usd.values import Values
    from usdvol_lint.layertext.source import LayerTexts


class Prims(Wing):
    """The prims that rules ask for: schemas, attributes, extents, and Gprims above and below."""

    def __init__(self, tables: Tables, kinds: PrimKinds, clips: Clips, drawn: Drawn) -> None:
        super().__init__(tables)
        self._kinds = kinds
        self._clips = clips
        self._drawn = drawn

    def of(self, schema_name: str) -> list[Any]:
        """The live prims that answer to the schema of that name: its type, a subtype, an API."""
        return self.tables.prims(schema_name)

    def is_a(self, prim: Any, schema_name: str) -> bool:
        """Whether one prim answers to the schema of that name."""
        return self._kinds.is_a(prim, schema_name)

    def shown_path(self, prim: Any) -> str:
        """The path of a prim; for one in a prototype, the first at which an instance has it."""
        return instances.shown(prim).path

    def values(self, prim: Any, name: str) -> Values:
        """All values of an attribute, the default first."""
        return values.values_of(prim.GetAttribute(name))

    def hidden_animation(self, attribute: Any) -> HiddenAnimation | None:
        """The time samples or clips of an attribute that a stronger default hides."""
        return hidden.hidden_animation(attribute, self._clips.reaching(attribute.GetPrim()))

    def hidden_boxes_outside(self, prim: Any, relative_slack: float) -> HiddenAnimation | None:
        """The time samples of `extent` that a stronger default hides and does not enclose."""
        attribute = prim.GetAttribute("extent")
        hidden = self.hidden_animation(attribute) if attribute else None
        box = self.limits(prim).at(None) if hidden else None
        is_outside = hidden and box and extents.outside_box(box, hidden.values(), relative_slack)
        return hidden if is_outside else None

    def animated_times(self) -> list[float]:
        """The times at which Volumes, fields and particle fields have samples, in order."""
        return sorted({time for _, times in animated.animated(self.tables) for time in times})

    @column
    def authored(self, table: Table) -> Sequence[Authored]:
        """The authored properties of prims, sorted by what the schemas declare."""
        return [table.authored] * len(table.prims)

    @summary
    def may_be_mistyped(self, table: Table) -> Sequence[bool]:
        """Whether a spec may have another type than the schema declares."""
        return contradictions.may_be_mistyped(table.batch, table.authored)

    @summary
    def may_have_unlisted_tokens(self, table: Table) -> Sequence[bool]:
        """Whether a token may be one that the schema does not allow."""
        return contradictions.may_have_unlisted(table.batch, table.authored)

    @summary
    def may_be_encoded_otherwise(self, table: Table) -> Sequence[bool]:
        """Whether a prim is of no type of ours, or has properties that no schema declares."""
        is_foreign = schema.OURS.isdisjoint(table.authored.schemas)
        may_be = is_foreign or bool(table.authored.undeclared)
        return [may_be] * len(table.prims)

    def mistyped(self, prim: Any) -> Iterator[Mistyped]:
        """The specs of a prim's attributes whose type is not the one that the schema declares."""
        return contradictions.mistyped(prim, self.authored(prim))

    def misspelt(self, prim: Any) -> Iterator[Misspelt]:
        """The attributes of a prim whose names are probably misspelt."""
        return contradictions.misspelt(prim, self.authored(prim))

    def is_told_as_misspelt(self, prim: Any, *names: str) -> bool:
        """Whether SCH004 tells that an attribute is probably meant to have one of these names."""
        is_meant = any(slip.intended in names for slip in self.misspelt(prim))
        return is_meant and self.tables.tells("SCH004") and not self.encoding(prim)

    def unlisted_tokens(self, prim: Any) -> Iterator[Unlisted]:
        """The values of a prim's attributes that are tokens the schema does not allow."""
        return contradictions.unlisted_tokens(prim, self.authored(prim))

    def transform_faults(self, prim: Any) -> TransformFaults:
        """The transform ops of a prim that are not there or not finite; none where USD has none."""
        is_placed = self.is_a(prim, "Xformable")
        return transforms.transform_faults(prim) if is_placed else transforms.TransformFaults()

    @cached_property
    def above_ours(self) -> list[Any]:
        """The prims above Volumes and particle fields with a purpose, visibility or transform."""
        tables = self.tables.of(schema.VOLUME, schema.PARTICLE_FIELD)
        return ancestors.ancestors_of((table.batch for table in tables), self._kinds, self._drawn)

    def is_handed_down(self, above: Any, name: str) -> bool:
        """Whether a Volume or particle field takes what a prim above it says of a property."""
        return handed_down.is_handed_down(above, name, self._kinds)

    def dropped_lists(self, prim: Any) -> tuple[DroppedList, ...]:
        """The lists of APIs that USD drops, of a particle field that lacks one."""
        if not self.authored(prim).lacks_apis:
            return ()  # and no text of a layer need be read
        return dropped.dropped_lists(prim, self._kinds.applied(prim), self._texts)

    @cached_property
    def _texts(self) -> LayerTexts:
        return source.LayerTexts()

    @fact
    def encoding(self, prim: Any) -> Encoding | None:
        """The encoding of a prim that predates the schema, if it has one."""
        return encodings.recognise(prim)

    def has_data_of(self, prim: Any, type_name: str) -> bool:
        """Whether properties are authored that a prim of this type of UsdVol is read for."""
        return data.has_data_of(prim, type_name)

    @column
    def limits(self, table: Table) -> Sequence[Limits]:
        """The `extent` of prims, all values as boxes."""
        return extents.read_limits(table.batch)

    @summary
    def have_malformed_extents(self, table: Table) -> Sequence[bool]:
        """Whether an authored `extent` is malformed."""
        return [limits.are_malformed for limits in self.limits.all(table)]

    def extents(self, prim: Any) -> Values:
        """All values of `extent` that are arrays of vectors, as `Extent`, the default first."""
        return extents.read_extents(prim.GetAttribute("extent"))

    @cached_property
    def without_extent(self) -> list[Any]:
        """The Volumes and particle fields whose bounds USD can't tell, sorted by path."""
        readable = self.limits.readable(schema.VOLUME, schema.PARTICLE_FIELD)
        unauthored = (prim for prim, limits in readable if not limits.are_authored)
        return sorted(filterfalse(bounds.has_bounds, unauthored), key=self.shown_path)

    @cached_property
    def moved_prototypes(self) -> frozenset[Any]:
        """The paths of the prototypes that PointInstancers show at changing places."""
        return instancers.moved_prototypes(self._drawn.live_instancers)

    @summary
    def are_nested(self, table: Table) -> Sequence[bool]:
        """Whether there is a Gprim among the ancestors or descendants."""
        return self._nesting.are_likely(table.batch)

    def gprim_above(self, prim: Any) -> Any | None:
        """The nearest Gprim among the ancestors of a prim; None if there is none."""
        return self._nesting.above(prim)

    def gprims_below(self, prim: Any) -> Iterator[Nested]:
        """The Gprims below a prim, except Volumes, particle fields and what is below these."""
        return self._nesting.below(prim)

    @cached_property
    def _nesting(self) -> Nesting:
        return nesting.Nesting(self._kinds)
