"""What is known of a stage: found once, on demand, never computed unless a rule asks."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.usd.instances import in_prototype, shown, shown_path
from usdvol_lint.facts.volumes.states import TargetState

if TYPE_CHECKING:
    from usdvol_lint.facts.files.assets import Affected, AssetReader, AssetSamples, UnlistedClips
    from usdvol_lint.facts.files.disk import Files
    from usdvol_lint.facts.files.marks import PathMarks
    from usdvol_lint.facts.files.places import Recased
    from usdvol_lint.facts.files.sequences import SampleSequence
    from usdvol_lint.facts.grids.changes import GridChanges
    from usdvol_lint.facts.grids.claims import ClaimReader, FieldClaims
    from usdvol_lint.facts.grids.contents import ContentReader, Contents, FieldContents
    from usdvol_lint.facts.layers.composition import Composition
    from usdvol_lint.facts.particles.apis import ParticleApis
    from usdvol_lint.facts.particles.arrays import ParticleArrays
    from usdvol_lint.facts.particles.colour_spaces import ColourSpace
    from usdvol_lint.facts.particles.extent import Strays
    from usdvol_lint.facts.prims.attributes import (
        Authored,
        AuthoredReader,
        Misspelt,
        Mistyped,
        Unlisted,
    )
    from usdvol_lint.facts.prims.encodings import Encoding
    from usdvol_lint.facts.prims.extents import Limits
    from usdvol_lint.facts.prims.nesting import Nested, Nesting
    from usdvol_lint.facts.prims.tables import Chunk, Place, Table, Tables
    from usdvol_lint.facts.usd.clips import Clips, ClipSet
    from usdvol_lint.facts.usd.kinds import Key, Kinds
    from usdvol_lint.facts.usd.values import Values
    from usdvol_lint.facts.volumes.bindings import (
        Binding,
        BindingReader,
        Bound,
        FieldBindings,
        FieldNames,
        Target,
    )
    from usdvol_lint.facts.volumes.enclosure import Enclosure, Shortfall, Standing
    from usdvol_lint.facts.volumes.mixture import MixedFiles
    from usdvol_lint.facts.volumes.placement import Displacement, Placement
    from usdvol_lint.model import ParticleFieldStats
    from usdvol_lint.volumefile.cache import VolumeFiles


class Facts:
    """The facts of one stage: read-only for rules, each found when first asked for, and kept.

    `stage` is the `Usd.Stage`, `kept` are those of its prims that rules ask for, and on `clipped`
    value clips are authored; `advance` is told of progress in long sequences; `content` says how
    many of a field's files are looked into, and `volume_files` has those of other stages; `times`
    says which time samples of particles are looked at, `statistics` whether to count in passing
    what `particle_field_stats` tells.
    What is found of many prims in one go is kept in the columns of tables, what is found of one at
    a time in `_found`; `passed_over` are prims that a fact about the stage as a whole does without,
    because USD can't read them.
    Modules that need pxr are imported where they are used, so that the words rules are written in
    can be loaded where there is no pxr.
    """

    def __init__(
        self,
        stage: Any,
        kinds: Kinds,
        kept: Mapping[Key, Sequence[Any]],
        clipped: Sequence[Any],
        advance: Callable[[int], None] = lambda count: None,
        content: str = "all",
        volume_files: VolumeFiles | None = None,
        times: str | int = "all",
        statistics: bool = False,
    ) -> None:
        self.stage = stage
        self.kinds = kinds
        self._kept = kept
        self._clipped = clipped
        self._advance = advance
        self._content = content
        self._volume_files = volume_files
        self._times = times
        self._statistics = statistics
        self._accounted_for: set[Any] = set()
        self._found: dict[Any, dict[str, Any]] = defaultdict(dict)
        self.passed_over: list[tuple[Any, Exception]] = []

    def composed_anew(self, kept: Mapping[Key, Sequence[Any]], clipped: Sequence[Any]) -> Facts:
        """The facts of the same stage under another variant selection.

        Files stay known, and a field that was used before is not unused now.
        """
        other = Facts(
            self.stage,
            self.kinds,
            kept,
            clipped,
            self._advance,
            self._content,
            self._volume_files,
            self._times,
            self._statistics,
        )
        other.files = self.files
        other._accounted_for = self._accounted_for
        return other

    def of(self, schema_name: str) -> list[Any]:
        """The live prims that answer to the schema of that name: its type, a subtype, an API."""
        return [
            prim
            for key, prims in self._kept.items()
            if schema_name in self.kinds.names(key)
            for prim in prims
        ]

    def is_a(self, prim: Any, schema_name: str) -> bool:
        """Whether one prim answers to the schema of that name."""
        return self.kinds.is_a(prim, schema_name)

    def assets(self, prim: Any, name: str) -> AssetSamples:
        """Every value of an asset attribute, resolved and classified."""
        samples: AssetSamples = self._one(prim, name)
        return samples

    def claims(self, field: Any) -> FieldClaims:
        """What a field says of the content of its files."""
        claims: FieldClaims = self._one(field, ":claims")
        return claims

    def contents(self, field: Any) -> FieldContents:
        """What is inside the files that a field names."""
        from usdvol_lint.facts.grids.contents import FieldContents

        attribute = self.assets(field, "filePath").attribute
        return FieldContents(attribute, self._one(field, ":contents"))

    def sequence(self, prim: Any, name: str) -> SampleSequence | None:
        """The time samples of an asset attribute as a sequence, or None if there are not two."""
        if len(self.assets(prim, name).samples) < 2:
            return None
        known = self._found[prim]
        key = f":sequence of {name}"
        if key not in known:
            from usdvol_lint.facts.files.sequences import read_sequence

            known[key] = read_sequence(self.assets(prim, name))
        sequence: SampleSequence | None = known[key]
        return sequence

    def recased(self, prim: Any, name: str) -> Recased | None:
        """The samples of an asset attribute that differ by case from what the folders hold."""
        from usdvol_lint.facts.files.places import recased

        return recased(self.assets(prim, name), self.files)

    def outside_package(self, prim: Any, name: str) -> Affected | None:
        """The samples of an asset attribute in a package that name files outside it."""
        if not self._has_packages:
            return None
        from usdvol_lint.facts.files.places import outside_package

        return outside_package(self.assets(prim, name))

    def below_layer(self, affected: Affected) -> str | None:
        """The first path in relation to its layer, if the file lies below the layer's folder."""
        from usdvol_lint.facts.files.places import below_layer

        return below_layer(affected)

    def fields(self, volume: Any) -> FieldBindings:
        """What the `field:` namespace of a Volume really binds."""
        found: FieldBindings | None = self._one(volume, ":bound").looked_at
        if found:
            return found
        known = self._found[volume]
        if ":fields" not in known:
            known[":fields"] = self._binding_reader.read(volume, self._may_lack)
        bindings: FieldBindings = known[":fields"]
        return bindings

    def apis(self, prim: Any) -> ParticleApis:
        """The applied APIs of a prim, those that nobody registers among them."""
        known = self._found[prim]
        if ":apis" not in known:
            from usdvol_lint.facts.particles.apis import read_particle_apis

            known[":apis"] = read_particle_apis(prim, self.kinds)
        apis: ParticleApis = known[":apis"]
        return apis

    def encoding(self, prim: Any) -> Encoding | None:
        """The encoding from before the schema that a prim is in, if it is in one."""
        known = self._found[prim]
        if ":encoding" not in known:
            from usdvol_lint.facts.prims.encodings import recognise

            known[":encoding"] = recognise(prim)
        encoding: Encoding | None = known[":encoding"]
        return encoding

    def arrays(self, prim: Any) -> ParticleArrays:
        """The arrays of a particle field: empty where SCH011 says that it is no UsdVol."""
        known = self._found[prim]
        if ":arrays" not in known:
            from usdvol_lint.facts.particles.arrays import read_particle_arrays

            is_ours = not self.encoding(prim)
            known[":arrays"] = read_particle_arrays(
                prim,
                self.kinds.names(self.kinds.key(prim)) if is_ours else (),
                self.authored(prim).declared if is_ours else (),
                {each.attribute.GetName() for each in self.mistyped(prim) if not each.only_role},
                self._times,
                self._statistics,
                self._advance,
            )
        arrays: ParticleArrays = known[":arrays"]
        return arrays

    def particle_field_stats(self) -> tuple[ParticleFieldStats, ...]:
        """What each particle field holds, in the order of their paths."""
        from usdvol_lint.facts.particles.statistics import stats_of

        stats = (
            stats_of(self.shown_path(prim), self.arrays(prim))
            for prim in self.of(schema.PARTICLE_FIELD)
        )
        return tuple(sorted(stats, key=lambda each: each.prim))

    def stray_positions(self, prim: Any, slack: float, clamp: float) -> Strays | None:
        """The positions that lie outside the extent at the same time."""
        from usdvol_lint.facts.particles.extent import stray_positions

        extent = prim.GetAttribute("extent")
        positions = next(self.arrays(prim).used("positions"), None)
        if not positions or not extent.HasAuthoredValue():
            return None
        return stray_positions(positions, extent, slack, clamp)

    def colour_space(self, prim: Any) -> ColourSpace | None:
        """The colour space that a prim names, or the nearest prim above it that names one."""
        from usdvol_lint.facts.particles.colour_spaces import colour_space

        return colour_space(prim)

    def authored(self, prim: Any) -> Authored:
        """The authored attributes of a prim, by what the schemas declare of them."""
        return self._tables.find(prim)[0].authored

    def mistyped(self, prim: Any) -> Iterator[Mistyped]:
        """The specs of a prim's attributes that have another type than the schema declares."""
        from usdvol_lint.facts.prims.attributes import mistyped

        return mistyped(prim, self.authored(prim))

    def misspelt(self, prim: Any) -> Iterator[Misspelt]:
        """The attributes of a prim that no schema declares for a slip in their names."""
        from usdvol_lint.facts.prims.attributes import misspelt

        return misspelt(prim, self.authored(prim))

    def unlisted_tokens(self, prim: Any) -> Iterator[Unlisted]:
        """The tokens in attributes of a prim that the schema does not allow there."""
        from usdvol_lint.facts.prims.attributes import unlisted_tokens

        return unlisted_tokens(prim, self.authored(prim))

    def values(self, prim: Any, name: str) -> Values:
        """Every value of an attribute, the default first."""
        from usdvol_lint.facts.usd.values import values_of

        return values_of(prim.GetAttribute(name))

    def extents(self, prim: Any) -> Values:
        """Every `extent` of a prim, the default first; empty where none is authored."""
        from usdvol_lint.facts.prims.extents import read_extents

        return read_extents(prim.GetAttribute("extent"))

    def limits(self, prim: Any) -> Limits:
        """Every `extent` of a prim as a box."""
        limits: Limits = self._one(prim, ":limits")
        return limits

    def gprim_above(self, prim: Any) -> Any | None:
        """The nearest Gprim among the ancestors of a prim."""
        return self.nesting.above(prim)

    def gprims_below(self, prim: Any) -> Iterator[Nested]:
        """The Gprims below a prim, but none that is a Volume or particle field or below one."""
        return self.nesting.below(prim)

    def shown_path(self, prim: Any) -> str:
        """The path of a prim as the stage shows it, also in a prototype."""
        return shown(prim).path

    def clip_sets(self, prim: Any) -> tuple[ClipSet, ...]:
        """The value clips that reach a prim, nearest first."""
        return self._clips.reaching(prim)

    def material_is_bound(self, prim: Any) -> bool:
        """Whether a material is bound to the prim, which replaces its own radiance."""
        from usdvol_lint.facts.particles.apis import material_is_bound

        return material_is_bound(prim)

    def meant_field(self, binding: Binding) -> str | None:
        """The field that a relationship which binds none was probably meant to target."""
        path = self._meant_path(binding)
        return shown_path(self.stage, path) if path else None

    def unbound_fields(self, volume: Any) -> list[Any]:
        """The field prims below a Volume that no Volume targets."""
        from usdvol_lint.facts.volumes.bindings import fields_below

        places, used = self._tables.fields, self._field_users
        below = fields_below(volume, self.kinds)
        return [each for each in below if places.get(in_prototype(each).GetPath()) not in used]

    def hidden_animation(self, prim: Any, name: str) -> str | None:
        """What animates an attribute in vain, in words, because a stronger default hides it."""
        from usdvol_lint.facts.files.assets import hidden_animation

        return hidden_animation(prim.GetAttribute(name), self.clip_sets(prim))

    def unlisted_clips(self, prim: Any, name: str) -> UnlistedClips | None:
        """The clips that hold an attribute which their manifest does not declare."""
        from usdvol_lint.facts.files.assets import unlisted_clips

        return unlisted_clips(prim.GetAttribute(name), self.clip_sets(prim))

    def is_shared(self, volume: Any, field: Any) -> bool:
        """Whether other Volumes target a field of this one too, or instances of this one do."""
        place = self._tables.fields.get(in_prototype(field).GetPath())
        if place and self._field_users[place] > 1:
            return True
        instanced = volume.IsInPrototype() and not field.IsInPrototype()
        return instanced and shown(volume).instances > 1

    def displacement(self, volume: Any, field: Any) -> Displacement | None:
        """How a field is moved in relation to a Volume that binds it, if it is."""
        from usdvol_lint.facts.volumes.placement import read_placements

        for path, placement in read_placements(volume, field):
            if found := placement.displacement():
                return found._replace(words=f"{found.words} in <{path}>") if path else found
        return None

    def extent_shortfall(self, volume: Any, relative_slack: float) -> Shortfall | None:
        """What the grids of a Volume have outside its extent, if one is authored."""
        return self.enclosure.shortfall(self.standing(volume), relative_slack)

    def standing(self, volume: Any) -> Standing:
        """A Volume with its extent, and what there is to enclose in it."""
        fields = []
        for _, target in self._bound_assets(volume):
            field = in_prototype(target.prim)
            contents = self.contents(field).all
            if contents.select_grids:
                fields.append((target, self.assets(field, "filePath"), contents))
        return volume, self.limits(volume), fields

    def overhangs(self, table: Table) -> Iterator[float]:
        """How far grids may reach out of each extent, in relation to their largest coordinate."""
        overhang, stands = self.enclosure.overhang, self._stands
        columns = (table.prims, self.each(table, ":limits"), self.each(table, ":bound"))
        for volume, limits, bound in zip(*columns, strict=True):
            yield overhang(limits, stands(volume, bound)) if limits.are_authored else 0.0

    def _stands(self, volume: Any, bound: Bound) -> list[tuple[Contents, Placement]]:
        """The contents of the files that a Volume gets, and where their fields stand."""
        from usdvol_lint.facts.volumes.placement import AT_REST, read_placements

        if bound.looked_at:
            return [
                (contents, placement)
                for target, _, contents in self.standing(volume)[2]
                for _, placement in read_placements(volume, target.prim)
            ]
        found = []
        for place in bound.fields:
            table, row = self._tables.find_at(place)
            moves = "xformOpOrder" in table.authored.declared
            contents = table.cell(row, ":contents", self._read)
            if moves:
                placements = read_placements(volume, table.prims[row])
                found += [(contents, placement) for _, placement in placements]
            else:
                found.append((contents, AT_REST))
        return found

    def mixed_files(self, volume: Any) -> MixedFiles | None:
        """The different files that the fields of a Volume name at one time, if they do."""
        if len(self.fields(volume).bindings) < 2:
            return None
        from usdvol_lint.facts.volumes.mixture import find_mixed_files

        named = [
            (binding.name, self.assets(in_prototype(target.prim), "filePath"))
            for binding, target in self._bound_assets(volume)
        ]
        return find_mixed_files(named) if len(named) > 1 else None

    @cached_property
    def unused_fields(self) -> list[Any]:
        """The fields that no Volume targets, on a stage of which all could be seen.

        Those are left out that something wrong with a Volume accounts for: they lie below it, or
        a broken relationship was probably meant to target them.
        """
        from usdvol_lint.facts.volumes.bindings import fields_below

        places, used = self._tables.fields, self._field_users
        self._accounted_for.update(path for path, place in places.items() if place in used)
        unused = places.keys() - self._accounted_for
        volumes = self.of(schema.VOLUME)
        if not volumes or not unused or not self.composition.is_whole:
            return []
        if not {prim for prim, _ in self.passed_over}.isdisjoint(volumes):
            return []  # nobody knows what these target
        for volume in volumes:
            if not self.fields(volume).is_sound:
                below = fields_below(volume, self.kinds)
                self._accounted_for.update(in_prototype(field).GetPath() for field in below)
                meant = map(self._meant_path, self.fields(volume).bindings)
                self._accounted_for.update(filter(None, meant))
        return [self.stage.GetPrimAtPath(path) for path in sorted(unused - self._accounted_for)]

    def stays_unused(self, field: Any) -> Callable[[], bool]:
        """Asks, once more variant selections were looked at, whether none of them uses a field."""
        path, accounted_for = field.GetPath(), self._accounted_for
        return lambda: path not in accounted_for

    @cached_property
    def without_extent(self) -> list[Any]:
        """The Volumes and particle fields that have no bounds to USD, by their paths."""
        from usdvol_lint.facts.prims.extents import has_bounds

        bare = [
            prim
            for prim, limits in self._readable(":limits", schema.VOLUME, schema.PARTICLE_FIELD)
            if not limits.are_authored and not has_bounds(prim)
        ]
        bare = [prim for prim in bare if not self.composition.may_lack_values(prim)]
        return sorted(bare, key=self.shown_path)

    @cached_property
    def time_range(self) -> tuple[float, float] | None:
        """The stage's startTimeCode and endTimeCode, where both are authored and in this order."""
        if not self.stage.HasAuthoredTimeCodeRange():
            return None
        start, end = self.stage.GetStartTimeCode(), self.stage.GetEndTimeCode()
        return (start, end) if start <= end else None

    @cached_property
    def composition(self) -> Composition:
        """What USD could not compose."""
        from usdvol_lint.facts.layers.composition import read_composition

        clipped: list[Any] = []
        for table in self._tables.of(*schema.OURS):
            if table.fault:
                self._pass_over(table.prims[0], table.fault)
            elif table.authored.is_clipped:
                clipped += table.prims
        clip_sets = dict.fromkeys(found for prim in clipped for found in self.clip_sets(prim))
        return read_composition(self.stage, clip_sets)

    def grid_changes(self, field: Any) -> GridChanges | None:
        """Where the grids along a field's sequence are others than in most of its frames.

        Of the fields that share a sequence, the first one is told.
        """
        contents = self.contents(field)
        if len(contents.all.kinds) < 2:
            return None
        from usdvol_lint.facts.grids.changes import find_grid_changes

        sharing = self._sharing[tuple(contents.all.files)]
        return find_grid_changes(list(map(self.contents, sharing))) if sharing[0] == field else None

    @cached_property
    def _sharing(self) -> Mapping[Hashable, list[Any]]:
        """The fields that name the same files at the same times."""
        found: dict[Hashable, list[Any]] = defaultdict(list)
        for prim, contents in self._readable(":contents", schema.FIELD_ASSET):
            found[tuple(contents.files)].append(prim)
        return found

    @cached_property
    def _asset_reader(self) -> AssetReader:
        from usdvol_lint.facts.files.assets import AssetReader

        return AssetReader(self.files, self._advance)

    @cached_property
    def path_marks(self) -> PathMarks:
        from usdvol_lint.facts.files.marks import PathMarks

        return PathMarks(self.files, self._has_packages)

    @cached_property
    def _claim_reader(self) -> ClaimReader:
        from usdvol_lint.facts.grids.claims import ClaimReader

        return ClaimReader()

    @cached_property
    def _binding_reader(self) -> BindingReader:
        from usdvol_lint.facts.volumes.bindings import BindingReader

        return BindingReader(self.kinds)

    @cached_property
    def _content_reader(self) -> ContentReader:
        from usdvol_lint.facts.grids.contents import ContentReader
        from usdvol_lint.volumefile.cache import VolumeFiles

        return ContentReader(self._volume_files or VolumeFiles(), self._content, self._advance)

    @cached_property
    def files(self) -> Files:
        """The state of files, each looked at once."""
        from usdvol_lint.facts.files.disk import Files

        return Files()

    @cached_property
    def _has_packages(self) -> bool:
        """Whether any layer lies in a package."""
        from usdvol_lint.facts.files.places import package_of

        return any(map(package_of, self.stage.GetUsedLayers()))

    def chunks(self, key: Key) -> Sequence[Chunk]:
        """The live prims of a kind, some at a time, in the order of the walk."""
        return self._tables.chunks(key)

    def tables(self, chunk: Chunk) -> Sequence[Table]:
        """The prims of a chunk, those together that are alike."""
        return self._tables.tables(chunk)

    def each(self, table: Table, name: str) -> Sequence[Any]:
        """A fact of each prim of a table, by the name that it is kept under."""
        return table.column(name, self._read)

    def _one(self, prim: Any, name: str) -> Any:
        table, row = self._tables.find(prim)
        return table.cell(row, name, self._read)

    @cached_property
    def _tables(self) -> Tables:
        from usdvol_lint.facts.prims.tables import Tables

        return Tables(self._kept, self.kinds, self._authored_reader)

    def _read(self, name: str, table: Table) -> Sequence[Any]:
        """Finds what is kept under a name for each prim of a table.

        Under the name of an attribute, that is what the asset paths in its values lead to.
        """
        usd, authored = table.usd, table.authored
        match name:
            case ":claims":
                return self._claim_reader.read(usd, authored)
            case ":contents":
                paths, claims = self.each(table, "filePath"), self.each(table, ":claims")
                return self._content_reader.read(paths, claims, authored)
            case ":bound":
                fields = self._tables.fields
                return self._binding_reader.read_many(usd, authored, fields, self._may_lack)
            case ":limits":
                from usdvol_lint.facts.prims.extents import read_limits

                return read_limits(usd)
            case _ if not name.startswith(":"):
                return self._asset_reader.read(usd, name)
        raise KeyError(name)

    def _may_lack(self, prim: Any) -> bool:
        return self.composition.may_lack(prim)

    def _meant_path(self, binding: Binding) -> Any | None:
        from usdvol_lint.facts.volumes.bindings import meant_path

        path = meant_path(binding)
        volume = binding.property.GetPrim().GetPath()
        return self._field_names.nearest(path, volume) if path else None

    @cached_property
    def enclosure(self) -> Enclosure:
        from usdvol_lint.facts.volumes.enclosure import Enclosure

        return Enclosure()

    def _bound_assets(self, volume: Any) -> Iterator[tuple[Binding, Target]]:
        """The fields with a file that a Volume really gets, with what binds them."""
        for binding, target in self.fields(volume).with_target(TargetState.FIELD):
            if schema.FIELD_ASSET in target.schemas:
                yield binding, target

    @cached_property
    def _field_users(self) -> Counter[Place]:
        """How many Volumes target each live field that one does, by its place."""
        volumes = self._readable(":bound", schema.VOLUME)
        return Counter(place for _, bound in volumes for place in bound.fields)

    def _readable(self, name: str, *schemas: str) -> Iterator[tuple[Any, Any]]:
        """The prims that answer to a schema, with a fact of each; others are `passed_over`."""
        for table in self._tables.of(*schemas):
            yield from table.readable(name, self._read, self._pass_over)

    def _pass_over(self, prim: Any, error: Exception) -> None:
        self.passed_over.append((prim, error))

    @cached_property
    def _field_names(self) -> FieldNames:
        from usdvol_lint.facts.volumes.bindings import FieldNames

        return FieldNames(self.of(schema.FIELD), self.of(schema.VOLUME))

    @cached_property
    def _authored_reader(self) -> AuthoredReader:
        from usdvol_lint.facts.prims.attributes import AuthoredReader

        return AuthoredReader(self.kinds, self._clips)

    @cached_property
    def nesting(self) -> Nesting:
        from usdvol_lint.facts.prims.nesting import Nesting

        return Nesting(self.kinds)

    @cached_property
    def _clips(self) -> Clips:
        from usdvol_lint.facts.usd.clips import Clips

        return Clips(self._clipped)
