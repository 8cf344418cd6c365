"""What is known of a stage: found once, on demand, never computed unless a rule asks."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema

if TYPE_CHECKING:
    from usdvol_lint.facts.assets import AssetSamples, UnlistedClips
    from usdvol_lint.facts.clips import Clips, ClipSet
    from usdvol_lint.facts.composition import Composition
    from usdvol_lint.facts.encodings import Encoding
    from usdvol_lint.facts.fields import Binding, FieldBindings, FieldNames
    from usdvol_lint.facts.files import Files
    from usdvol_lint.facts.kinds import Key, Kinds
    from usdvol_lint.facts.particles import ParticleApis


class Facts:
    """The facts of one stage: read-only for rules, each found when first asked for, and kept.

    `stage` is the `Usd.Stage`; `advance` is told of progress in long sequences.
    Modules that need pxr are imported where they are used, so that the words rules are written in
    can be loaded where there is no pxr.
    """

    def __init__(
        self,
        stage: Any,
        kinds: Kinds,
        kept: Mapping[Key, Sequence[Any]],
        advance: Callable[[int], None] = lambda count: None,
    ) -> None:
        self.stage = stage
        self.kinds = kinds
        self._kept = kept
        self._advance = advance
        self._assets: dict[tuple[Any, str], AssetSamples] = {}
        self._fields: dict[Any, FieldBindings] = {}
        self._apis: dict[Any, ParticleApis] = {}
        self._encodings: dict[Any, Encoding | None] = {}

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
        key = (prim.GetPath(), name)
        if key not in self._assets:
            from usdvol_lint.facts.assets import read_asset_samples

            self._assets[key] = read_asset_samples(
                prim.GetAttribute(name), self.files, self._advance
            )
        return self._assets[key]

    def fields(self, volume: Any) -> FieldBindings:
        """What the `field:` namespace of a Volume really binds."""
        path = volume.GetPath()
        if path not in self._fields:
            from usdvol_lint.facts.fields import read_field_bindings

            self._fields[path] = read_field_bindings(
                volume, self.kinds, lambda prim: self.composition.may_lack(prim)
            )
        return self._fields[path]

    def apis(self, prim: Any) -> ParticleApis:
        """The applied APIs of a prim, those that nobody registers among them."""
        path = prim.GetPath()
        if path not in self._apis:
            from usdvol_lint.facts.particles import read_particle_apis

            self._apis[path] = read_particle_apis(prim, self.kinds)
        return self._apis[path]

    def encoding(self, prim: Any) -> Encoding | None:
        """The encoding from before the schema that a prim is in, if it is in one."""
        path = prim.GetPath()
        if path not in self._encodings:
            from usdvol_lint.facts.encodings import recognise

            self._encodings[path] = recognise(prim)
        return self._encodings[path]

    def clip_sets(self, prim: Any) -> tuple[ClipSet, ...]:
        """The value clips that reach a prim, nearest first."""
        return self._clips.reaching(prim)

    def material_is_bound(self, prim: Any) -> bool:
        """Whether a material is bound to the prim, which replaces its own radiance."""
        from usdvol_lint.facts.particles import material_is_bound

        return material_is_bound(prim)

    def meant_field(self, binding: Binding) -> str | None:
        """The field that a relationship which binds none was probably meant to target."""
        from usdvol_lint.facts.instances import shown_path

        path = self._meant_path(binding)
        return shown_path(self.stage, path) if path else None

    def unbound_fields(self, volume: Any) -> list[Any]:
        """The field prims below a Volume that no Volume targets."""
        from usdvol_lint.facts.fields import fields_below
        from usdvol_lint.facts.instances import in_prototype

        below = fields_below(volume, self.kinds)
        used = self.used_field_paths
        return [field for field in below if in_prototype(field).GetPath() not in used]

    def hidden_animation(self, prim: Any, name: str) -> str | None:
        """What animates an attribute in vain, in words, because a stronger default hides it."""
        from usdvol_lint.facts.assets import hidden_animation

        return hidden_animation(prim.GetAttribute(name), self.clip_sets(prim))

    def unlisted_clips(self, prim: Any, name: str) -> UnlistedClips | None:
        """The clips that hold an attribute which their manifest does not declare."""
        from usdvol_lint.facts.assets import unlisted_clips

        return unlisted_clips(prim.GetAttribute(name), self.clip_sets(prim))

    @cached_property
    def used_field_paths(self) -> frozenset[Any]:
        """The paths of the prims that some Volume targets."""
        from usdvol_lint.facts.fields import field_paths

        volumes = self.of(schema.VOLUME)
        return frozenset().union(
            *(field_paths(volume, self.fields(volume)) for volume in volumes)
        )

    @cached_property
    def unused_field_paths(self) -> frozenset[Any]:
        """The paths of the fields that no Volume targets, on a stage of which all could be seen.

        Those are left out that something wrong with a Volume accounts for: they lie below it, or
        a broken relationship was probably meant to target them.
        """
        from usdvol_lint.facts.fields import fields_below
        from usdvol_lint.facts.instances import in_prototype

        volumes = self.of(schema.VOLUME)
        unused = {field.GetPath() for field in self.of(schema.FIELD)} - self.used_field_paths
        if not volumes or not unused or not self.composition.is_whole:
            return frozenset()
        for volume in volumes:
            if not self.fields(volume).is_sound:
                below = fields_below(volume, self.kinds)
                unused.difference_update(in_prototype(field).GetPath() for field in below)
                unused.difference_update(map(self._meant_path, self.fields(volume).bindings))
        return frozenset(unused)

    @cached_property
    def composition(self) -> Composition:
        """What USD could not compose."""
        from usdvol_lint.facts.composition import read_composition

        names = (schema.FIELD, schema.VOLUME, schema.PARTICLE_FIELD)
        subjects = [prim for name in names for prim in self.of(name)]
        clip_sets = dict.fromkeys(found for prim in subjects for found in self.clip_sets(prim))
        return read_composition(self.stage, clip_sets)

    @cached_property
    def files(self) -> Files:
        """The state of files, each looked at once."""
        from usdvol_lint.facts.files import Files

        return Files()

    def _meant_path(self, binding: Binding) -> Any | None:
        from usdvol_lint.facts.fields import meant_path

        path = meant_path(binding)
        return self._field_names.nearest(path) if path else None

    @cached_property
    def _field_names(self) -> FieldNames:
        from usdvol_lint.facts.fields import FieldNames

        return FieldNames(self.of(schema.FIELD))

    @cached_property
    def _clips(self) -> Clips:
        from usdvol_lint.facts.clips import Clips

        return Clips()
