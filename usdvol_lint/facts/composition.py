"""What USD could not compose: layers that do not open, and every other composition error."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from pxr import Pcp, Sdf

from usdvol_lint.facts.assets import is_uri
from usdvol_lint.facts.clips import ClipSet

_QUOTED = re.compile(r"@(.+?)@(?:<([^>]*)>)?")
_ANONYMOUS = re.compile(r"(?:,@)?anon:0x[0-9a-f]+(?::[^@>\s]*)?@?")


@dataclass(frozen=True, slots=True)
class MissingLayer:
    """A layer that an arc names and USD can't open.

    `arc` is sublayer, reference, payload, clip or clip manifest; `asset` is the path as authored.
    `layer` holds the arc, on the spec at `path` of that layer; `prim` is the prim of the stage.
    `reason` is what USD says of a file that is there but can't be read, or "".
    """

    arc: str
    asset: str
    layer: Any
    path: Any
    prim: Any
    reason: str

    @property
    def is_uri(self) -> bool:
        return is_uri(self.asset)


@dataclass(frozen=True, slots=True)
class CompositionError:
    """Any other error: `message` in one line, `prim` is where the stage shows it."""

    message: str
    prim: Any


@dataclass(frozen=True, slots=True)
class Composition:
    """Everything that a stage could not compose, each once, in a stable order."""

    missing_layers: tuple[MissingLayer, ...]
    errors: tuple[CompositionError, ...]
    unloaded: tuple[Any, ...]
    """Prims with payloads that were not loaded."""


def read_composition(stage: Any, clip_sets: Iterable[ClipSet]) -> Composition:
    """Reads the composition errors of the whole stage and opens what the clip sets name."""
    missing = set(_missing_clips(clip_sets))
    errors = set()
    for error in stage.GetCompositionErrors():
        prim = stage.GetPrimAtPath(error.rootSite.path) or stage.GetPseudoRoot()
        layer = _missing_layer(error, prim)
        if layer:
            missing.add(layer)
        else:
            errors.add(CompositionError(_one_line(str(error)), prim))
    loaded = set(stage.GetLoadSet())
    unloaded = (path for path in stage.FindLoadable() if path not in loaded)
    return Composition(
        tuple(sorted(missing, key=lambda m: (str(m.prim.GetPath()), m.arc, m.asset))),
        tuple(sorted(errors, key=lambda e: (str(e.prim.GetPath()), e.message))),
        tuple(stage.GetPrimAtPath(path) for path in sorted(unloaded)),
    )


def _missing_layer(error: Any, prim: Any) -> MissingLayer | None:
    """Python sees no more of these errors than their text, which is the same in all versions."""
    text = str(error)
    quoted = _QUOTED.findall(text)
    if error.errorType not in _ASSET_ERRORS or len(quoted) < 2:
        return None
    (resolved, _), (identifier, path) = quoted[:2]
    layer = Sdf.Layer.Find(identifier)
    if layer is None:
        return None
    sdf_path = Sdf.Path(path) if path else Sdf.Path.absoluteRootPath
    arc = next((arc for arc in _ARCS if f" {arc} " in text.partition("@")[0] + _between(text)), "")
    _, _, reason = text.partition(" -- ")
    authored = _authored(layer, sdf_path, resolved)
    return MissingLayer(arc, authored, layer, sdf_path, prim, _one_line(reason))


_ASSET_ERRORS = frozenset({Pcp.ErrorType_InvalidAssetPath, Pcp.ErrorType_InvalidSublayerPath})
_ARCS = ("sublayer", "reference", "payload")


def _between(text: str) -> str:
    """The words between the first and the second quoted layer."""
    parts = text.split("@")
    return parts[2] if len(parts) > 2 else ""


def _authored(layer: Any, path: Any, resolved: str) -> str:
    """The asset path as the layer has it, where USD only says what it became."""
    for asset in _assets_named(layer, path):
        if resolved in (asset, layer.ComputeAbsolutePath(asset), asset.replace("//", "/")):
            return asset
    return resolved


def _assets_named(layer: Any, path: Any) -> Iterator[str]:
    if path == Sdf.Path.absoluteRootPath:
        yield from layer.subLayerPaths
        return
    spec = layer.GetPrimAtPath(path)
    if spec:
        for list_op in (spec.referenceList, spec.payloadList):
            yield from (arc.assetPath for arc in list_op.GetAddedOrExplicitItems())


def _missing_clips(clip_sets: Iterable[ClipSet]) -> Iterator[MissingLayer]:
    for clip_set in clip_sets:
        spec = clip_set.prim.GetPrimStack()[0]
        named = [("clip", clip) for clip in clip_set.clips]
        if clip_set.manifest:
            named.append(("clip manifest", clip_set.manifest))
        for arc, asset in named:
            if not asset.resolvedPath:
                yield MissingLayer(arc, asset.path, spec.layer, spec.path, clip_set.prim, "")


def _one_line(text: str) -> str:
    """USD's words without its line breaks and without the addresses of anonymous layers."""
    return " ".join(_ANONYMOUS.sub("", text).split())
