"""Clips with samples of an asset attribute that their manifest does not declare."""

from __future__ import annotations

from typing import Any, NamedTuple

from usdvol_lint.facts.usd.clips import ClipSet, authored_path, open_layer
from usdvol_lint.facts.usd.opinions import strongest_opinion


class UnlistedClips(NamedTuple):
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
