"""What USD could not compose: layers that do not open, and every other composition error."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from pxr import Pcp, Sdf, Tf, Usd

from usdvol_lint.facts.files.disk import file_fault
from usdvol_lint.facts.files.paths import is_packaged, is_uri
from usdvol_lint.facts.usd.clips import ClipSet, authored_path, open_layer
from usdvol_lint.facts.usd.diagnostics import commentary, without_parser_rule
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.paths import display

_QUOTED = re.compile(r"@(.+?)@(?:<([^>]*)>)?")
_INTRODUCED = re.compile(r"introduced by @(.+?)@<([^>]*)>")
_IN_LAYER = re.compile(r" at (?P<path>/\S*) in @(?P<layer>.+?)@")
_ABSOLUTE = re.compile(r"(?<=@)/[^@]+(?=@)")
_ANONYMOUS = re.compile(r"(?:,@)?anon:0x[0-9a-f]+(?::[^@>\s]*)?@?")
_ASSET_ERRORS = frozenset({Pcp.ErrorType_InvalidAssetPath, Pcp.ErrorType_InvalidSublayerPath})
_ARCS = ("sublayer", "reference", "payload")


@dataclass(frozen=True, slots=True)
class MissingLayer:
    """A layer that an arc names and USD can't open.

    `arc` is sublayer, reference, payload, clip, clip template or clip manifest; `asset` is the
    path as authored, `path` the absolute one.  `spec` holds the arc; `prims` are those of the
    stage that lack something for it.  `reason` is what is wrong with a file that is there, or "".
    """

    arc: str
    asset: str
    path: str
    spec: Any
    reason: str
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        return self.prims[0]

    @property
    def is_uri(self) -> bool:
        return is_uri(self.asset)


@dataclass(frozen=True, slots=True)
class CompositionError:
    """Any other error: `message` in one line, `spec` is to blame, `prims` are where it shows."""

    message: str
    spec: Any | None
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        return self.prims[0]


@dataclass(frozen=True)
class Composition:
    """Everything that a stage could not compose, each once, in a stable order."""

    missing_layers: tuple[MissingLayer, ...]
    errors: tuple[CompositionError, ...]
    unloaded: tuple[Any, ...]
    """Prims with payloads that were not loaded."""

    @property
    def is_whole(self) -> bool:
        """Whether every layer that an arc names was there and loaded."""
        return not self.unloaded and not self._lack_opinions

    def may_lack(self, prim: Any) -> bool:
        """Whether a layer that does not open may say something about a prim and what is below."""
        return _is_at_or_below(prim, self._lack_opinions)

    def may_lack_values(self, prim: Any) -> bool:
        """The same with value clips, which say nothing but what attributes are worth."""
        return _is_at_or_below(prim, self._lack_opinions | self._lack_clips)

    @cached_property
    def _lack_opinions(self) -> frozenset[Any]:
        return _as_walked(missing for missing in self.missing_layers if missing.arc in _ARCS)

    @cached_property
    def _lack_clips(self) -> frozenset[Any]:
        return _as_walked(missing for missing in self.missing_layers if missing.arc not in _ARCS)


def read_composition(stage: Any, clip_sets: Iterable[ClipSet]) -> Composition:
    """Reads the composition errors of the whole stage and opens what the clip sets name.

    An error of a layer that many prims compose is one error: it is known by its place.
    """
    missing: dict[_Arc, list[Any]] = defaultdict(list)
    said: dict[str, set[str]] = defaultdict(set)
    errors: dict[tuple[str, Any], list[Any]] = defaultdict(list)
    for arc, prim in _missing_clips(clip_sets):
        missing[arc].append(prim)
    for error in stage.GetCompositionErrors():
        text = str(error)
        prim = stage.GetPrimAtPath(error.rootSite.path) or stage.GetPseudoRoot()
        if not prim.IsActive():
            continue
        unopened = _missing_arc(text) if error.errorType in _ASSET_ERRORS else None
        if unopened:
            missing[unopened].append(prim)
            said[unopened.path].add(_reason_in(text, unopened.path))
        else:
            errors[_as_sentence(text), _blamed_spec(text)].append(prim)
    reasons = {path: _reason(path, said[path]) for path in {arc.path for arc in missing}}
    layers = (
        MissingLayer(*arc, reasons[arc.path], _sorted(prims)) for arc, prims in missing.items()
    )
    return Composition(
        tuple(sorted(layers, key=_missing_order)),
        tuple(
            sorted(
                (CompositionError(*error, _sorted(prims)) for error, prims in errors.items()),
                key=lambda error: (str(error.prim.GetPath()), error.message),
            )
        ),
        _unloaded_prims(stage),
    )


def _unloaded_prims(stage: Any) -> tuple[Any, ...]:
    if stage.GetLoadRules() == Usd.StageLoadRules.LoadAll():
        return ()  # to find what can be loaded, USD would traverse the whole stage once more
    loadable = map(stage.GetPrimAtPath, sorted(stage.FindLoadable()))
    return tuple(prim for prim in loadable if prim and not prim.IsLoaded())


class _Arc(NamedTuple):
    """An arc to a layer that does not open, known by its place."""

    arc: str
    asset: str
    path: str
    spec: Any


def _reason(path: str, said: set[str]) -> str:
    """What is wrong with a layer that is there, in the same words in every run.

    USD tells it with only some of the arcs that name the layer, now these and now those.
    """
    fault = file_fault(path)
    if os.path.exists(path):
        reason = f"it is {fault}" if fault else _why_not_open(path)
    else:
        reason = _why_not_open(path) if is_packaged(path) and not fault else ""
    return reason or min(filter(None, said), default="")


def _missing_order(missing: MissingLayer) -> tuple[str, ...]:
    spec = missing.spec
    return (str(missing.prim.GetPath()), spec.layer.identifier, str(spec.path), missing.asset)


def _missing_arc(text: str) -> _Arc | None:
    """Python sees no more of these errors than their text, which is the same in all versions."""
    quoted = _QUOTED.findall(text)
    if len(quoted) < 2:
        return None
    (resolved, _), (identifier, place) = quoted[:2]
    spec = _spec(identifier, place)
    if spec is None:
        return None
    words = text.partition(" -- ")[0]
    arc = next(arc for arc in _ARCS if f" {arc} " in _QUOTED.sub("", words))
    return _Arc(arc, _authored(spec, resolved), resolved, spec)


def _reason_in(text: str, resolved: str) -> str:
    """Why a layer does not open, if the text of an error tells it."""
    reason = text.partition(" -- ")[2].removesuffix("; skipping.")
    return _as_reason(reason, resolved)


def _as_reason(text: str, resolved: str) -> str:
    text = text.replace(f"<{resolved}>", "it").replace(resolved, display(resolved))
    return _one_line(text).rstrip(". ")


def _spec(identifier: str, place: str) -> Any | None:
    layer = Sdf.Layer.Find(identifier)
    return layer.GetObjectAtPath(place or "/") if layer else None


def _blamed_spec(text: str) -> Any | None:
    """The spec that the text of an error says has introduced it."""
    introduced = _INTRODUCED.search(text)
    if introduced:
        return _spec(introduced[1], introduced[2])
    place = _IN_LAYER.search(text)
    return _spec(place["layer"], place["path"]) if place else None


def _authored(spec: Any, resolved: str) -> str:
    """The asset path as the layer has it, where USD only says what it became."""
    named = list(_assets_named(spec))
    for asset in named:
        anchored = spec.layer.ComputeAbsolutePath(asset)
        if resolved in (asset, anchored, asset.replace("//", "/")):
            return str(asset)
    expressions = [asset for asset in named if Sdf.VariableExpression.IsExpression(asset)]
    return expressions[0] if len(expressions) == 1 else display(resolved)


def _assets_named(spec: Any) -> Iterator[str]:
    if spec.path == Sdf.Path.absoluteRootPath:
        yield from spec.layer.subLayerPaths
        return
    prim = spec.layer.GetPrimAtPath(spec.path)
    if prim:
        for list_op in (prim.referenceList, prim.payloadList):
            yield from (arc.assetPath for arc in list_op.GetAddedOrExplicitItems())


def _missing_clips(clip_sets: Iterable[ClipSet]) -> Iterator[tuple[_Arc, Any]]:
    for clip_set in clip_sets:
        for arc, key, asset in _clip_assets(clip_set):
            if not open_layer(asset):
                spec = clip_set.spec_with(key)
                path = asset.resolvedPath or spec.layer.ComputeAbsolutePath(asset.path)
                yield _Arc(arc, authored_path(asset) or asset.path, path, spec), clip_set.prim


def _clip_assets(clip_set: ClipSet) -> Iterator[tuple[str, str, Any]]:
    """What a clip set names: the kind of layer, the key that names it, the asset path."""
    if clip_set.template and not clip_set.clips:
        yield "clip template", "templateAssetPath", Sdf.AssetPath(clip_set.template)
    if not clip_set.template:
        yield from (("clip", "assetPaths", clip) for clip in clip_set.clips)
    if clip_set.manifest:
        yield "clip manifest", "manifestAssetPath", clip_set.manifest


def _why_not_open(resolved: str) -> str:
    """Why USD can't open a layer that is there, or "" if it can."""
    try:
        return "" if Sdf.Layer.FindOrOpen(resolved) else "it is not a valid layer"
    except Tf.ErrorException as error:
        words = "; ".join(dict.fromkeys(map(without_parser_rule, map(commentary, error.args))))
        return _as_reason(words, resolved) or "it is not a valid layer"


def _as_walked(missing_layers: Iterable[MissingLayer]) -> frozenset[Any]:
    """The paths of the prims that lack something, as the walk meets these prims."""
    prims = [prim for missing in missing_layers for prim in missing.prims]
    prims += [prim.GetPrototype() for prim in prims if prim.IsInstance()]
    return frozenset(in_prototype(prim).GetPath() for prim in prims)


def _is_at_or_below(prim: Any, paths: frozenset[Any]) -> bool:
    path = in_prototype(prim).GetPath()
    return not paths.isdisjoint([Sdf.Path.absoluteRootPath, *path.GetPrefixes()])


def _sorted(prims: Iterable[Any]) -> tuple[Any, ...]:
    return tuple(sorted(dict.fromkeys(prims), key=lambda prim: prim.GetPath()))


def _as_sentence(text: str) -> str:
    """USD's words in the manner of messages, with layers relative to the working directory."""
    line = _ABSOLUTE.sub(lambda path: display(path.group()), _one_line(text)).rstrip(". ")
    return line[:1].lower() + line[1:]


def _one_line(text: str) -> str:
    """USD's words without its line breaks and without the addresses of anonymous layers."""
    return " ".join(_ANONYMOUS.sub("", text).split())
