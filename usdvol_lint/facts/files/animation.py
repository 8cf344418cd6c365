"""Clips without samples of an asset attribute that they should hold."""

from __future__ import annotations

from typing import Any, NamedTuple

from usdvol_lint.facts.usd.calls import ARCS
from usdvol_lint.facts.usd.clips import ClipSet, open_layer
from usdvol_lint.facts.usd.held import has_default, misspelt_in
from usdvol_lint.words import quoted

_BRINGS = (*ARCS, "variantSetNames")


class EmptyClip(NamedTuple):
    """A clip that has the prim it is asked for, but no samples of an attribute.

    `clip` is the display name of its layer; `spec` is the prim spec that names it.
    `has_default`: whether it has a default of the attribute; `slip`: the misspelt name that it has
    in its place, or "".
    `is_composed`: whether the clip refers to other layers; `hides_default`: whether the attribute
    has a default elsewhere, which counts at no time because the manifest declares it.
    """

    clip: str
    prim_path: str
    spec: Any
    has_default: bool
    slip: str
    is_composed: bool
    hides_default: bool

    @property
    def words(self) -> str:
        """What a message about the values that the field lacks says of it."""
        clip = f"the clip {quoted(self.clip)}"
        if self.has_default:
            return f"{clip} has it as a default, and USD takes only time samples from clips"
        if self.slip:
            return f"{clip} has {quoted(self.slip)} in its place"
        return f"{clip} has <{self.prim_path}>, and no value for this field"

    @property
    def advice(self) -> str:
        """What to do about the clips."""
        if self.has_default:
            return "write it as a time sample, in each clip"
        if self.slip:
            return "rename it in each clip"
        if self.is_composed:
            return (
                "write the values into the clip itself: USD does not compose what a clip refers to"
            )
        advice = "write it into the clips as time samples"
        return f"{advice}, or take it out of the manifest" if self.hides_default else advice


def empty_clip(attribute: Any, clips: tuple[ClipSet, ...]) -> EmptyClip | None:
    """The first clip that should hold samples of an attribute, where none of the first ones does.

    That it should, the manifest says, or an arc in the clip, behind which USD does not look.
    """
    for clip_set in clips:
        path = clip_set.path_in_layers(attribute)
        declared = open_layer(clip_set.manifest) if clip_set.manifest else None
        is_declared = bool(declared and declared.GetAttributeAtPath(path))
        for layer in () if clip_set.layer_with_samples(attribute) else clip_set.opened():
            is_composed = _composes(layer, path)
            if layer.GetPrimAtPath(clip_set.prim_path) and (is_declared or is_composed):
                return EmptyClip(
                    layer.GetDisplayName(),
                    clip_set.prim_path,
                    clip_set.spec_with(clip_set.key),
                    has_default(layer, path),
                    misspelt_in(layer, path),
                    is_composed,
                    attribute.Get() is not None,
                )
    return None


def _composes(layer: Any, path: Any) -> bool:
    """Whether a layer would have further opinions on a property if it were a stage."""
    if layer.subLayerPaths:
        return True
    specs = filter(None, map(layer.GetPrimAtPath, path.GetPrimPath().GetPrefixes()))
    return any(spec.HasInfo(arc) for spec in specs for arc in _BRINGS)
