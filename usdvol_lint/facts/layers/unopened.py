"""Layers that USD can't open: those that clip sets name, and the reasons."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.files.disk import file_fault
from usdvol_lint.facts.files.paths import extension_of, is_packaged
from usdvol_lint.facts.layers.error_texts import LayerArc, as_reason
from usdvol_lint.facts.usd.clips import ClipSet, authored_path, open_layer
from usdvol_lint.facts.usd.diagnostics import UNREADABLE, sayings, without_parser_rule

_COMPRESSED = frozenset({".sc", ".gz", ".bz2", ".xz", ".zst"})


def missing_clips(clip_sets: Iterable[ClipSet]) -> Iterator[tuple[LayerArc, Any]]:
    """The layers that clip sets name and USD can't open, each with the prim of its clip set."""
    for clip_set in clip_sets:
        for arc, key, asset, authored in _clip_assets(clip_set):
            if not open_layer(asset):
                spec = clip_set.spec_with(key)
                path = asset.resolvedPath or spec.layer.ComputeAbsolutePath(asset.path)
                yield LayerArc(arc, authored, path, spec), clip_set.prim


def _clip_assets(clip_set: ClipSet) -> Iterator[tuple[str, str, Any, str]]:
    """The layers that a clip set names.

    Each is `LayerArc.arc`, the key in the clip set, the asset path, and `LayerArc.asset`.
    """
    template, clips = clip_set.template, clip_set.clips
    if template and not clips:
        yield "clip template", "templateAssetPath", Sdf.AssetPath(template), template
    yield from (("clip", clip_set.key, clip, clip_set.named(clip)) for clip in clips)
    if manifest := clip_set.manifest:
        name = authored_path(manifest) or manifest.path
        yield "clip manifest", "manifestAssetPath", manifest, name


def unopened_reason(path: str, reported: Iterable[str]) -> str:
    """What is wrong with the layer at a path, in the same words in every run; "" if it is missing.

    `reported` are the reasons in USD's errors, the last resort: USD gives them for only some of the
    arcs that name the layer, and not for the same arcs in every run.
    """
    fault = file_fault(path)
    if os.path.exists(path):
        reason = f"it is {fault}" if fault else _why_not_open(path)
    else:
        reason = _why_not_open(path) if is_packaged(path) and not fault else ""
    return reason or min(filter(None, reported), default="")


def unread_extension(path: str) -> str:
    """The extension of a file that is there and whole, if no plugin here reads it; else ""."""
    is_there = os.path.isabs(path) and file_fault(path) is None
    return _format_of(path) if is_there and not Sdf.FileFormat.FindByExtension(path) else ""


def _format_of(path: str) -> str:
    """The extension of a file, of a compressed one with that of what is in it: `.bgeo.sc`."""
    extension = extension_of(path)
    inner = extension_of(path[: -len(extension)]) if extension in _COMPRESSED else ""
    return inner + extension if inner[1:2].isalpha() else extension


def _why_not_open(resolved: str) -> str:
    """Why USD can't open the layer at a path, or "" if it can."""
    try:
        return "" if Sdf.Layer.FindOrOpen(resolved) else "it is not a valid layer"
    except UNREADABLE as error:
        words = "; ".join(dict.fromkeys(map(without_parser_rule, sayings(error))))
        return as_reason(words, resolved) or "it is not a valid layer"
