"""Value clips with samples of attributes of ours that their manifest does not declare."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from usdvol_lint.facts.layers.lost_clips import without_samples
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.clip_faults import find_fault, used_sets
from usdvol_lint.facts.usd.clips import Clips, ClipSet, authored_path, open_layer
from usdvol_lint.facts.usd.hidden import HiddenAnimation
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.schema import DECLARED_BY
from usdvol_lint.words import quoted

_NEEDED = frozenset({"filePath", "positions", "positionsh"})
"""Without one of these, there is nothing to draw."""


class UnlistedClips(NamedTuple):
    """A clip set on `prim` with samples of `attributes`, which its manifest does not declare.

    `without_value` are those of them for which no default stands in.
    """

    prim: Any
    clip_set: ClipSet
    attributes: tuple[Any, ...]
    without_value: tuple[Any, ...]

    @property
    def missed(self) -> tuple[Any, ...]:
        """The attributes without a value, or all where each has a default."""
        return self.without_value or self.attributes

    @property
    def leaves_nothing(self) -> bool:
        """Whether there is nothing to draw."""
        return any(attribute.GetName() in _NEEDED for attribute in self.without_value)

    @property
    def words(self) -> str:
        """What is wrong."""
        first, more = self.missed[0], len(self.missed) - 1
        clip: Any = self.clip_set.layer_with_samples(first)
        manifest: Any = open_layer(self.clip_set.manifest)
        spec = manifest.GetAttributeAtPath(self.clip_set.path_in_layers(first))
        names = first.GetName() + (f" and {more} more" if more else "")
        them = "them" if more else "it"
        fault = f"declares {them} as uniform" if spec else f"does not declare {them}"
        left = "no value" if self.without_value else "only a default, the same at all times"
        return (
            f"the clip {quoted(clip.GetDisplayName())} holds {names}, but the manifest "
            f"{quoted(manifest.GetDisplayName())} {fault}: "
            f"USD ignores the clips, which leaves {left}"
        )

    @property
    def manifest_path(self) -> str:
        """The path of the manifest as it is authored."""
        manifest: Any = self.clip_set.manifest
        return authored_path(manifest) or str(manifest.path)

    @property
    def spec(self) -> Any:
        """The prim spec that names the manifest."""
        return self.clip_set.spec_with("manifestAssetPath")


def find_unlisted(
    tables: Tables, clips: Clips, bearers: Iterable[tuple[Any, list[Any]]]
) -> Iterator[UnlistedClips]:
    """The clip sets whose manifests lack attributes that have no samples from elsewhere."""
    for bearer, ours in bearers:
        keys = used_sets(bearer)
        for clip_set in clips.on(bearer):
            if clip_set.manifest and not find_fault(keys[clip_set.name]):
                lost = tuple(_lost(clip_set, tables, ours))
                without_value = tuple(each for each in lost if not _has_default(each))
                if lost:
                    yield UnlistedClips(bearer, clip_set, lost, without_value)


def _lost(clip_set: ClipSet, tables: Tables, prims: Iterable[Any]) -> Iterator[Any]:
    for prim in prims:
        for attribute in without_samples(tables, prim):
            is_ours = attribute.GetName() in DECLARED_BY
            if is_ours and clip_set.passes_over(attribute) and _would_count(clip_set, attribute):
                yield attribute


def _would_count(clip_set: ClipSet, attribute: Any) -> bool:
    """Whether the clips hold what the attribute lacks: any value, or values that differ."""
    layers = clip_set.layers_with_samples(attribute)
    if not layers or any(each.GetNumTimeSamples() for each in _of_both_precisions(attribute)):
        return False
    default = strongest_opinion(attribute, None)
    is_outranked = default is not None and clip_set.is_outranked_by(default.spec)
    if not _has_default(attribute):
        return not is_outranked
    # In the layer with the clips a default stands in for them; in a stronger one it is an edit.
    if default and is_outranked and default.spec.layer != clip_set.spec_with(clip_set.key).layer:
        return False
    return HiddenAnimation("", layers, clip_set.path_in_layers(attribute)).differs


def _has_default(attribute: Any) -> bool:
    return any(each.Get() is not None for each in _of_both_precisions(attribute))


def _of_both_precisions(attribute: Any) -> list[Any]:
    """The attribute, and its float or half twin, if it has one."""
    name, prim = attribute.GetName(), attribute.GetPrim()
    return list(filter(None, map(prim.GetAttribute, (name, f"{name}h", name.removesuffix("h")))))
