"""Value clips: the sets authored on a prim, and those on its ancestors that apply to it too."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from pxr import Sdf, Usd

from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.diagnostics import UNREADABLE, Unreadable, sayings
from usdvol_lint.facts.usd.firsts import anchored, are_same

if TYPE_CHECKING:
    from usdvol_lint.facts.usd.clip_faults import Keys

_CLIPS_OPENED = 4
"""How many clips of a set are searched for samples, since opening all may take long."""


class ClipSet(NamedTuple):
    """One clip set authored on `prim`.

    `clips` and `manifest` are `Sdf.AssetPath`s, resolved by USD.
    `template` is the pattern that names the clips, or None where they are named one by one.
    Without a `manifest`, USD generates one.
    """

    prim: Any
    name: str
    prim_path: str
    clips: tuple[Any, ...]
    manifest: Any | None
    template: str | None

    @property
    def key(self) -> str:
        """The key that names the clips."""
        return "templateAssetPath" if self.template else "assetPaths"

    def path_in_layers(self, attribute: Any) -> Any:
        """The path in the clips of an attribute of this prim or of one below it."""
        path = attribute.GetPrim().GetPath().ReplacePrefix(self.prim.GetPath(), self.prim_path)
        return path.AppendProperty(attribute.GetName())

    def layer_with_samples(self, attribute: Any) -> Any | None:
        """The first layer with time samples of an attribute, among the first clips."""
        return next(self._with_samples(attribute), None)

    def layers_with_samples(self, attribute: Any) -> tuple[Any, ...]:
        """The layers with time samples of an attribute, among the first clips."""
        return tuple(self._with_samples(attribute))

    def _with_samples(self, attribute: Any) -> Iterator[Any]:
        path = self.path_in_layers(attribute)
        return (layer for layer in self.opened() if layer.GetNumTimeSamplesForPath(path))

    def passes_over(self, attribute: Any) -> bool:
        """Whether USD looks for no samples of an attribute, since the manifest does not declare it.

        An attribute that is declared uniform counts as little.
        """
        declared = open_layer(self.manifest) if self.manifest else None
        spec = declared and declared.GetAttributeAtPath(self.path_in_layers(attribute))
        return bool(declared) and not (spec and spec.variability == Sdf.VariabilityVarying)

    def opened(self) -> Iterator[Any]:
        """The layers of the first clips, as far as they open."""
        return filter(None, map(open_layer, self.clips[:_CLIPS_OPENED]))

    def clip_at(self, time: float) -> str | None:
        """The authored path of the clip that is active at a time of the stage."""
        api = Usd.ClipsAPI(self.prim)
        _, offset = self.opinion_with(self.key if self.template else "active")
        time = offset.GetInverse() * time
        if self.template:
            start, stride = (
                api.GetClipTemplateStartTime(self.name),
                api.GetClipTemplateStride(self.name),
            )
            frame = start + max(time - start, 0) // stride * stride
            if not math.isfinite(frame):
                return None
            number = int(frame)
            return re.sub("#+", lambda marks: f"{number:0{len(marks[0])}}", self.template, count=1)
        active = sorted(map(tuple, api.GetClipActive(self.name) or ()))
        before = [index for start, index in active if start <= time]
        if not before or not 0 <= before[-1] < len(self.clips):
            return None
        return self.named(self.clips[int(before[-1])])

    def named(self, clip: Any) -> str:
        """The path of one of the clips as the set, or its template, names it."""
        if not self.template:
            return authored_path(clip) or str(clip.path)
        folder, slash, _ = self.template.rpartition("/")
        return folder + slash + re.split(r"[/\[]", clip.path)[-1].rstrip("]")

    def spec_with(self, key: str) -> Any:
        """The strongest spec of the prim that authors a key of the clip set, or the strongest."""
        return self.opinion_with(key)[0]

    def opinion_with(self, key: str) -> tuple[Any, Any]:
        """The same spec, and the offset from its times to those of the stage."""
        stack: list[tuple[Any, Any]] = self.prim.GetPrimStackWithLayerOffsets()
        return next((each for each in stack if key in self._said_in(each[0])), stack[0])

    @property
    def first_opinion(self) -> tuple[Any, Any]:
        """The weakest spec that names the clips of those which, from the strongest on, add nothing.

        With the offset from its times to those of the stage.
        """
        stack = self.prim.GetPrimStackWithLayerOffsets()
        found = self.opinion_with(self.key)
        weaker = stack[stack.index(found) + 1 :]
        while (others := [each for each in weaker if self.key in self._said_in(each[0])]) and (
            others[0][1] == found[1] and self._adds_nothing(found[0], [spec for spec, _ in weaker])
        ):
            found = others[0]
            weaker = weaker[weaker.index(found) + 1 :]
        return found

    def _adds_nothing(self, spec: Any, weaker: Sequence[Any]) -> bool:
        """Whether weaker specs say of the clip set what a spec does."""
        said: dict[str, Any] = {}
        for each in reversed(weaker):
            said |= self._anchored_in(each)
        own = self._anchored_in(spec)
        return all(key in said and are_same(own[key], said[key]) for key in own)

    def _anchored_in(self, spec: Any) -> dict[str, Any]:
        own = self._said_in(spec)
        if template := own.get("templateAssetPath"):
            own = own | {"templateAssetPath": Sdf.AssetPath(template)}
        return {key: anchored(spec, own[key]) for key in own}

    def _said_in(self, spec: Any) -> dict[str, Any]:
        """What a spec of the prim says of the clip set."""
        said = spec.GetInfo("clips").get(self.name) if spec.HasInfo("clips") else None
        return said if isinstance(said, dict) else {}

    def is_outranked_by(self, spec: Any) -> bool:
        """Whether a spec of an attribute, of this prim or one below it, is stronger than the clips.

        Clips are weaker than opinions in the layer that names them, and stronger than opinions in
        weaker layers.
        """
        stack = self.prim.GetPrimStack()
        own = self.spec_with(self.key)
        ranks = (
            rank
            for rank, other in enumerate(stack)
            if spec.layer == other.layer and spec.path.HasPrefix(other.path)
        )
        return bool(next(ranks, 0) <= stack.index(own))


def open_layer(asset: Any) -> Any | None:
    """The layer that an `Sdf.AssetPath` resolved to; None where USD can't read one there."""
    try:
        return Sdf.Layer.FindOrOpen(asset.resolvedPath) if asset.resolvedPath else None
    except UNREADABLE:
        return None


def authored_path(asset: Any) -> str:
    """An asset path before expressions were evaluated; "" in versions of USD that lose it."""
    return str(getattr(asset, "authoredPath", ""))


def clip_sets_on(prim: Any) -> tuple[ClipSet, ...]:
    """The clip sets authored on this prim, by name.

    Those that `clipSets` leaves out are ignored, and those that can bring nothing: without a valid
    `primPath`, or with a template that USD refuses.
    """
    from usdvol_lint.facts.usd.clip_faults import used_sets

    sets = used_sets(prim)
    return tuple(filter(None, (_read_clip_set(prim, name, sets[name]) for name in sets)))


def _read_clip_set(prim: Any, name: str, keys: Keys) -> ClipSet | None:
    from usdvol_lint.facts.usd.clip_faults import find_fault

    api = Usd.ClipsAPI(prim)
    prim_path = api.GetClipPrimPath(name)
    if not prim_path or not Sdf.Path.IsValidPathString(prim_path):
        return None
    if "assetPaths" not in keys and find_fault(keys):
        return None
    manifest = api.GetClipManifestAssetPath(name)
    if manifest is not None and not manifest.path:
        manifest = None
    template = None if "assetPaths" in keys else api.GetClipTemplateAssetPath(name)
    return ClipSet(prim, name, prim_path, _clip_paths(api, name), manifest, template or None)


def _clip_paths(api: Any, name: str) -> tuple[Any, ...]:
    try:
        return tuple(api.ComputeClipAssetPaths(name) or ())
    except UNREADABLE:
        # USD raises where a template matches no file, and for a set that it can't use.
        return ()


def is_from_clips(attribute: Any) -> bool:
    """Whether the first time sample of an attribute is one of value clips."""
    times = attribute.GetTimeSamples()
    if not times:
        return False
    source = attribute.GetResolveInfo(times[0]).GetSource()
    return bool(source == Usd.ResolveInfoSourceValueClips)


def concerns_only_clips(error: Unreadable, stage: Any) -> bool:
    """Whether an error that USD raised is about value clips that do not open, and nothing else.

    USD generates a manifest for clips without one, so it opens the clips when it composes the
    stage.
    """
    known: set[str] = set()
    with_clips = (
        prim
        for root in (stage.GetPseudoRoot(), *stage.GetPrototypes())
        for prim in Usd.PrimRange.AllPrims(root)
        if prim.HasAuthoredMetadata("clips")
    )
    for clip_set in chain.from_iterable(map(clip_sets_on, with_clips)):
        for clip in filter(None, (asset.resolvedPath for asset in clip_set.clips)):
            try:
                Sdf.Layer.FindOrOpen(clip)
            except UNREADABLE as clip_error:
                known.update(sayings(clip_error))
    return set(sayings(error)) <= known


class Clips:
    """The clip sets of a stage; `prims` include all on which clip sets are authored."""

    def __init__(self, prims: Iterable[Any]) -> None:
        self._prims = frozenset(prims)
        self._own: dict[Any, tuple[ClipSet, ...]] = {}

    @property
    def bearing(self) -> frozenset[Any]:
        """All prims on which clip sets are authored, as far as prims of ours are concerned."""
        return self._prims

    @property
    def are_authored(self) -> bool:
        """Whether any of the prims has clip sets."""
        return bool(self._prims)

    def reach(self, batch: PrimBatch) -> list[bool]:
        """Whether clip sets apply to each prim of a batch."""
        if not self._prims:
            return [False] * len(batch.prims)  # as on most stages
        return [bool(self.reaching(prim)) for prim in batch.prims]

    def reaching(self, prim: Any) -> tuple[ClipSet, ...]:
        """The clip sets that apply to a prim: its own, then those of each ancestor upwards."""
        return tuple(chain.from_iterable(map(self.on, self.bearers(prim))))

    def bearers(self, prim: Any) -> Iterator[Any]:
        """The prim and its ancestors, those of them on which clip sets are authored."""
        while self._prims and not prim.IsPseudoRoot():
            if prim in self._prims:
                yield prim
            prim = prim.GetParent()

    def on(self, prim: Any) -> tuple[ClipSet, ...]:
        """The clip sets authored on a prim itself, as `clip_sets_on` finds them."""
        if prim not in self._own:
            self._own[prim] = clip_sets_on(prim)
        return self._own[prim]
