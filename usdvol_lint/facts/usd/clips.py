"""The value clips that reach a prim: its own and those of its ancestors."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain
from typing import Any

from pxr import Sdf, Tf, Usd

from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.diagnostics import commentary

_CLIPS_LOOKED_AT = 4
_ALL = Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)


@dataclass(frozen=True, slots=True)
class ClipSet:
    """One clip set as authored on `prim`: asset paths are as USD resolved them.

    `template` names clips by a pattern, and is None where `clips` are named one by one.
    Where there is no `manifest`, USD makes one.
    """

    prim: Any
    name: str
    prim_path: str
    clips: tuple[Any, ...]
    manifest: Any | None
    template: str | None

    def path_in_layers(self, attribute: Any) -> Any:
        """Where the values of an attribute of this prim, or of one below it, lie in the clips."""
        place = attribute.GetPrim().GetPath().ReplacePrefix(self.prim.GetPath(), self.prim_path)
        return place.AppendProperty(attribute.GetName())

    def layer_with_samples(self, attribute: Any) -> Any | None:
        """The first of the leading clip layers that holds time samples of an attribute."""
        path = self.path_in_layers(attribute)
        for clip in self.clips[:_CLIPS_LOOKED_AT]:
            layer = open_layer(clip)
            if layer and layer.GetNumTimeSamplesForPath(path):
                return layer
        return None

    def spec_with(self, key: str) -> Any:
        """The strongest spec of the prim that authors a key of the clip set."""
        stack = self.prim.GetPrimStack()
        authors = (
            spec
            for spec in stack
            if spec.HasInfo("clips") and key in spec.GetInfo("clips").get(self.name, {})
        )
        return next(authors, stack[0])

    def is_outranked_by(self, spec: Any) -> bool:
        """Whether a spec of an attribute, of this prim or of one below it, beats the clips.

        Clips are weaker than what their own layer says, and stronger than weaker layers.
        """
        stack = self.prim.GetPrimStack()
        own = self.spec_with("templateAssetPath" if self.template else "assetPaths")
        ranks = (
            rank
            for rank, other in enumerate(stack)
            if spec.layer == other.layer and spec.path.HasPrefix(other.path)
        )
        return bool(next(ranks, 0) <= stack.index(own))


def open_layer(asset: Any) -> Any | None:
    """The layer at a resolved asset path; None where there is none that USD can read."""
    try:
        return Sdf.Layer.FindOrOpen(asset.resolvedPath) if asset.resolvedPath else None
    except Tf.ErrorException:
        return None


def authored_path(asset: Any) -> str:
    """An asset path as written; empty in a USD that forgets what it was evaluated from."""
    return str(getattr(asset, "authoredPath", ""))


def clip_sets_on(prim: Any) -> tuple[ClipSet, ...]:
    """The clip sets authored on this very prim."""
    api = Usd.ClipsAPI(prim)
    found = []
    for name in sorted(api.GetClips() or ()):
        prim_path = api.GetClipPrimPath(name)
        if prim_path and Sdf.Path.IsValidPathString(prim_path):
            manifest = api.GetClipManifestAssetPath(name)
            paths = _clip_paths(api, name)
            named = manifest is not None and bool(manifest.path)
            template = None if api.GetClipAssetPaths(name) else api.GetClipTemplateAssetPath(name)
            found.append(
                ClipSet(prim, name, prim_path, paths, manifest if named else None, template or None)
            )
    return tuple(found)


def _clip_paths(api: Any, name: str) -> tuple[Any, ...]:
    try:
        return tuple(api.ComputeClipAssetPaths(name) or ())
    except Tf.ErrorException:
        # So USD answers where a template fits no file, and for a set that it can't use.
        return ()


def concerns_only_clips(error: Any, stage: Any) -> bool:
    """Whether an error of USD tells of value clips that do not open, and of nothing else.

    USD makes a manifest for clips without one, and so opens them when it composes the stage.
    """
    words: set[str] = set()
    with_clips = (
        prim for prim in Usd.PrimRange.Stage(stage, _ALL) if prim.HasAuthoredMetadata("clips")
    )
    for clip_set in chain.from_iterable(map(clip_sets_on, with_clips)):
        for clip in filter(None, (asset.resolvedPath for asset in clip_set.clips)):
            try:
                Sdf.Layer.FindOrOpen(clip)
            except Tf.ErrorException as its:
                words.update(map(commentary, its.args))
    return set(map(commentary, error.args)) <= words


class Clips:
    """Finds clip sets; `prims` are those of the stage on which some are authored."""

    def __init__(self, prims: Iterable[Any]) -> None:
        self._prims = frozenset(prims)
        self._own: dict[Any, tuple[ClipSet, ...]] = {}

    def reach(self, batch: PrimBatch) -> list[bool]:
        """Whether there are clip sets for each of many prims."""
        if not self._prims:
            return [False] * len(batch.prims)  # so it is nearly always
        return [bool(self.reaching(prim)) for prim in batch.prims]

    def reaching(self, prim: Any) -> tuple[ClipSet, ...]:
        """The clip sets on the prim and its ancestors, nearest first."""
        found: tuple[ClipSet, ...] = ()
        while self._prims and not prim.IsPseudoRoot():
            if prim in self._prims:
                found += self._of(prim)
            prim = prim.GetParent()
        return found

    def _of(self, prim: Any) -> tuple[ClipSet, ...]:
        if prim not in self._own:
            self._own[prim] = clip_sets_on(prim)
        return self._own[prim]
