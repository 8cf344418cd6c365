"""Animation of an asset attribute that USD ignores: hidden by a default, or not in a manifest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from usdvol_lint.facts.usd.clips import ClipSet, authored_path, open_layer
from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.model import quoted


def hidden_animation(attribute: Any, clips: tuple[ClipSet, ...]) -> str | None:
    """The time samples or clip set, in words, that a stronger default hides; None if none are."""
    specs = attribute.GetPropertyStack()
    if len(specs) < 2 and not clips:
        return None  # nearly always, and what follows is slow
    default = strongest_opinion(attribute, None)
    if default is None or attribute.Get() is None or attribute.GetNumTimeSamples():
        return None
    for spec in specs:
        if count := spec.layer.GetNumTimeSamplesForPath(spec.path):
            samples = "time sample" if count == 1 else f"{count} time samples"
            return f"the {samples} in {quoted(spec.layer.GetDisplayName())}"
    for clip_set in clips:
        if clip_set.is_outranked_by(default.spec) and clip_set.layer_with_samples(attribute):
            return f"the value clips {quoted(clip_set.name)} on <{shown(clip_set.prim).path}>"
    return None


@dataclass(frozen=True, slots=True)
class UnlistedClips:
    """Clips that hold samples of an attribute that their manifest does not declare.

    `clip` and `manifest` are display names of layers; `spec` is the prim spec that authors
    `manifest_path`.
    """

    clip: str
    manifest: str
    manifest_path: str
    spec: Any


def unlisted_clips(attribute: Any, clips: tuple[ClipSet, ...]) -> UnlistedClips | None:
    """The clips that would give the attribute its values if the manifest declared it."""
    if not clips or attribute.GetNumTimeSamples():
        return None
    default = strongest_opinion(attribute, None)
    for clip_set in clips:
        if default and clip_set.is_outranked_by(default.spec):
            return None
        manifest = clip_set.manifest
        declared = open_layer(manifest) if manifest else None
        if not manifest or not declared:
            continue
        clip = clip_set.layer_with_samples(attribute)
        if clip and not declared.GetAttributeAtPath(clip_set.path_in_layers(attribute)):
            return UnlistedClips(
                clip.GetDisplayName(),
                declared.GetDisplayName(),
                authored_path(manifest) or manifest.path,
                clip_set.spec_with("manifestAssetPath"),
            )
    return None
