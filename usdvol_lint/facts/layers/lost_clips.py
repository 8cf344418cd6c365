"""Value clips that USD does not use, and the attributes of ours that lack what they hold."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.facts.files.paths import anchored_to
from usdvol_lint.facts.files.places import names_listed, place_of
from usdvol_lint.facts.layers.held_otherwise import bring_anything, held_otherwise, path_in_clips
from usdvol_lint.facts.prims.tables import Tables
from usdvol_lint.facts.usd.clip_faults import (
    ClipFault,
    Keys,
    find_fault,
    keys_without_set,
    misnamed_sets,
    used_sets,
)
from usdvol_lint.facts.usd.clips import Clips, ClipSet, open_layer
from usdvol_lint.facts.usd.held import attribute_paths
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.words import format_time, quoted

_OPENED = 4
"""How many clips of a set are searched, since opening all may take long."""
_FILE_PATH = "filePath"


class LostClips(NamedTuple):
    """A clip set on `prim` that USD does not use; `name` is "" where clips stand outside of one.

    `attributes` are those, at least one, that lack the values of the clips; `spec` is the prim spec
    to blame, and `advice` what to do.
    """

    prim: Any
    name: str
    fault: ClipFault
    attributes: tuple[Any, ...]
    spec: Any
    advice: str | None

    @property
    def without_value(self) -> tuple[Any, ...]:
        """Those of the attributes that have no value at all."""
        return tuple(attribute for attribute in self.attributes if attribute.Get() is None)


class _Clips(NamedTuple):
    """A clip set that is not used: `layers` are its first clips, as far as they open."""

    prim: Any
    name: str
    keys: Keys
    spec: Any
    fault: ClipFault
    layers: Sequence[Any]
    manifest: Any | None


def find_lost_clips(
    tables: Tables, clips: Clips, bearers: Iterable[tuple[Any, list[Any]]]
) -> Iterator[LostClips]:
    """The clip sets above or on prims of ours that USD does not use."""
    for bearer, ours in bearers:
        sound = tuple(_sound(bearer, clips.on(bearer)))
        for unused in chain(_refused(bearer, clips.on(bearer)), _misdirected(sound)):
            attributes = chain.from_iterable(without_samples(tables, prim) for prim in ours)
            if lost := tuple(each for each in attributes if _is_lost(unused, each)):
                yield _loss(unused, lost, _advice(unused, lost[0]))
        for each in sound:
            yield from _held_otherwise(each, _without_any(tables, ours))


def _loss(unused: _Clips, attributes: Sequence[Any], advice: str | None) -> LostClips:
    return LostClips(unused.prim, unused.name, unused.fault, tuple(attributes), unused.spec, advice)


def _without_any(tables: Tables, prims: Iterable[Any]) -> Iterator[Any]:
    """The paths and arrays of ours of prims on which no attribute of ours is animated."""
    for prim in prims:
        table, _ = tables.find(prim)
        names = schema.attributes_of(table.authored.schemas)
        attributes = list(filter(None, map(prim.GetAttribute, names)))
        if not any(attribute.GetNumTimeSamples() for attribute in attributes):
            types = Sdf.ValueTypeNames
            for attribute in attributes:
                type_name = attribute.GetTypeName()
                if type_name.isArray or type_name == types.Asset:
                    yield attribute


def _held_otherwise(sound: _Clips, attributes: Iterable[Any]) -> Iterator[LostClips]:
    """What sound clips hold under other names or as defaults, by what is wrong with it."""
    found: dict[ClipFault, list[Any]] = defaultdict(list)
    for attribute in attributes:
        path = path_in_clips(attribute, sound.prim, sound.keys["primPath"])
        fault = held_otherwise(attribute, path, sound.layers)
        if fault and not _is_outranked(sound, attribute):
            found[fault].append(attribute)
    for fault, lost in found.items():
        yield _loss(sound._replace(fault=fault), lost, fault.advice)


def without_samples(tables: Tables, prim: Any) -> Iterator[Any]:
    """The attributes of ours that may be animated, and are not."""
    table, _ = tables.find(prim)
    for name in schema.attributes_of(table.authored.schemas):
        attribute = prim.GetAttribute(name)
        if attribute and not attribute.GetNumTimeSamples():
            yield attribute


def _refused(prim: Any, read: Iterable[ClipSet]) -> Iterator[_Clips]:
    """The clip sets on a prim that USD refuses; `read` are those that say what they need."""
    found = {clip_set.name: clip_set.clips for clip_set in read}
    loose = keys_without_set(prim)
    if loose:
        what = f"hold {', '.join(sorted(loose))} outside of the dictionary of a clip set"
        advice = "put them into one, as in clips = { dictionary default = { … } }"
        yield _read(prim, "", loose, ClipFault("clips", what, advice), ())
    faulty = ((name, keys, find_fault(keys)) for name, keys in used_sets(prim).items())
    for name, keys, fault in chain(misnamed_sets(prim), faulty):
        if fault:
            yield _read(prim, name, keys, fault, found.get(name, ()))


def _sound(prim: Any, read: Iterable[ClipSet]) -> Iterator[_Clips]:
    """The other clip sets on a prim, as far as clips of theirs open."""
    found = {clip_set.name: clip_set.clips for clip_set in read}
    for name, keys in used_sets(prim).items():
        if not find_fault(keys):
            none = ClipFault("primPath", "", None)
            clips = _read(prim, name, keys, none, found.get(name, ()))
            if clips.layers:
                yield clips


def _misdirected(sound: Iterable[_Clips]) -> Iterator[_Clips]:
    """Those of sound clip sets whose path leads to nothing in the clips, or to something else."""
    for clips in sound:
        path = clips.keys["primPath"]
        what = f"has the primPath {quoted(path)}"
        if not any(layer.GetPrimAtPath(path) for layer in clips.layers):
            yield clips._replace(fault=ClipFault("primPath", f"{what}, which no clip has", None))
        elif not bring_anything(clips.prim, path, clips.layers):
            what += ", below which its clips hold nothing for this prim"
            yield clips._replace(fault=ClipFault("primPath", what, None))


def _read(prim: Any, name: str, keys: Keys, fault: ClipFault, clips: Sequence[Any]) -> _Clips:
    """A clip set that is not used; `clips` are those that USD names for it, if it does."""
    spec = _author(prim, name, fault.key)
    named = islice(clips or _named(prim, name, keys), _OPENED)
    opened = (open_layer(_resolved(prim, name, clip)) for clip in named)
    manifest = keys.get("manifestAssetPath")
    return _Clips(
        prim,
        name,
        keys,
        spec,
        fault,
        list(filter(None, opened)),
        open_layer(manifest) if isinstance(manifest, Sdf.AssetPath) else None,
    )


def _author(prim: Any, name: str, key: str) -> Any:
    """The strongest spec that authors a key of the clip set, or any of the set, or that of all."""
    stack = [spec for spec in prim.GetPrimStack() if spec.HasInfo("clips")]
    if key == "clipSets":
        return next(spec for spec in prim.GetPrimStack() if spec.HasInfo(key))
    with_set = [spec for spec in stack if name in spec.GetInfo("clips")] or stack
    authors = (spec for spec in with_set if name and key in spec.GetInfo("clips").get(name, {}))
    return next(authors, with_set[0])


def _resolved(prim: Any, name: str, asset: Any) -> Any:
    """The asset path with what it resolves to, which USD finds only in sets that it can use."""
    if asset.resolvedPath or not asset.path:
        return asset
    layer = _author(prim, name, "assetPaths").layer
    return Sdf.AssetPath(asset.path, layer.ComputeAbsolutePath(asset.path))


def _named(prim: Any, name: str, keys: Keys) -> Iterator[Any]:
    """The clips of a set that USD refuses."""
    assets, template = keys.get("assetPaths"), keys.get("templateAssetPath")
    if isinstance(assets, Sdf.AssetPathArray):
        yield from assets
    elif isinstance(template, str):
        layer = _author(prim, name, "templateAssetPath").layer
        yield from _named_by_template(layer, template)


def _named_by_template(layer: Any, template: str) -> Iterator[Any]:
    """The files that a template stands for, as far as they exist."""
    place = place_of(anchored_to(layer, template))
    matches = re.compile(re.sub(r"(?:\\#)+", "[0-9]+", re.escape(place.name))).fullmatch
    names = names_listed(place.folder) if "#" in place.name else []
    yield from (Sdf.AssetPath(clip, place.beside(clip)) for clip in names if matches(clip))


def _is_lost(unused: _Clips, attribute: Any) -> bool:
    """Whether the clips hold values that the attribute would have if USD used them."""
    if unused.fault.is_block and attribute.Get() is not None:
        return False
    if _is_outranked(unused, attribute):
        return False
    if not unused.layers and not unused.manifest:
        # Nothing says what the clips would hold.
        return "assetPaths" not in unused.keys and attribute.GetName() == _FILE_PATH
    return next(_holders(unused, attribute), None) is not None


def _holders(unused: _Clips, attribute: Any) -> Iterator[str]:
    """The prim paths at which clips, or the manifest, hold the attribute."""
    suffix = str(attribute.GetPath())[len(str(unused.prim.GetPath())) :]
    layers = [*unused.layers, *filter(None, (unused.manifest,))]
    if unused.fault.key != "primPath":
        prim_path = str(unused.keys.get("primPath", ""))
        at = f"{prim_path}{suffix}"
        yield from (prim_path for layer in layers if prim_path and layer.GetAttributeAtPath(at))
        return
    name = attribute.GetName()
    found = [path for layer in layers for path in attribute_paths(layer, name)]
    if f"{unused.keys.get('primPath')}{suffix}" not in found:
        yield from (path.removesuffix(suffix) for path in found if path.endswith(suffix))


def _is_outranked(unused: _Clips, attribute: Any) -> bool:
    """Whether a default is stronger than the clips, so that they would bring nothing anyway."""
    opinion = strongest_opinion(attribute, None)
    if opinion is None or attribute.Get() is None:
        return False
    stack = unused.prim.GetPrimStack()
    ranks = (
        rank
        for rank, spec in enumerate(stack)
        if opinion.spec.layer == spec.layer and opinion.spec.path.HasPrefix(spec.path)
    )
    return bool(next(ranks, 0) <= stack.index(_author(unused.prim, unused.name, "assetPaths")))


def _advice(unused: _Clips, attribute: Any) -> str | None:
    """What to write, where the clips say so themselves."""
    if unused.fault.key == "primPath":
        paths = set(_holders(unused, attribute))
        if paths == {""}:
            return "put what clips and manifest hold below one prim, and name that as primPath"
        paths.discard("")
        return f"did you mean {quoted(*paths)}?" if len(paths) == 1 else unused.fault.advice
    if unused.fault.key == "active" and "active" not in unused.keys:
        return _active(unused, attribute) or unused.fault.advice
    return unused.fault.advice


def _active(unused: _Clips, attribute: Any) -> str | None:
    """The `active` that the first samples of the clips speak for, if they are in order."""
    clips = unused.keys["assetPaths"]
    if len(unused.layers) < len(clips) or any(a != b for a, b in unused.keys.get("times", ())):
        return None
    suffix = str(attribute.GetPath())[len(str(unused.prim.GetPath())) :]
    path = f"{unused.keys['primPath']}{suffix}"
    firsts = [layer.ListTimeSamplesForPath(path)[:1] for layer in unused.layers]
    starts: list[float] = [first[0] for first in firsts if first]
    if len(starts) < len(clips) or sorted(set(starts)) != starts:
        return None
    pairs = ", ".join(f"({format_time(start)}, {index})" for index, start in enumerate(starts))
    return f"author 'double2[] active = [{pairs}]'"
