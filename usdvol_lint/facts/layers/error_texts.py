"""Reads the texts of USD's composition errors, which are all that Python can see of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.facts.layers.composition import ARCS
from usdvol_lint.facts.usd.calls import ARCS as FIELDS
from usdvol_lint.paths import display

_QUOTED = re.compile(r"@(.+?)@(?:<([^>]*)>)?")
_INTRODUCED = re.compile(r"introduced by @(.+?)@<([^>]*)>")
_UNRESOLVED = re.compile(r"Unresolved (reference|payload) prim path @(.+?)@<([^>]*)>")
_CANNOT = "CANNOT"
_IN_LAYER = re.compile(r" at (?P<path>/\S*) in @(?P<layer>.+?)@")
_ABSOLUTE = re.compile(r"(?<=@)/[^@]+(?=@)")
_ANONYMOUS = re.compile(r"(?:,@)?anon:0x[0-9a-f]+(?::[^@>\s]*)?@?")


class LayerArc(NamedTuple):
    """An arc or clip set that names a layer, and the spec that holds it.

    `arc`: one of `ARCS`, or clip, clip template or clip manifest.
    `asset`: the path as authored; `path`: the absolute path.
    """

    arc: str
    asset: str
    path: str
    spec: Any


class PrimArc(NamedTuple):
    """A reference or payload to a prim, and the spec that holds it.

    `arc`, `asset`, `path` and `spec` are as in `LayerArc`.
    `target`: the prim's path as authored; "" asks for the default prim of the layer.
    `wanted`: the path that USD looked for; "" if the layer says no default prim.
    """

    arc: str
    asset: str
    path: str
    target: str
    wanted: str
    spec: Any


def unresolved_arc(text: str) -> PrimArc | None:
    """The arc in an error about a prim that is not there; None if its spec can't be found.

    All supported versions of USD use the same words.
    """
    named = _UNRESOLVED.match(text)
    introduced = _INTRODUCED.search(text)
    spec = _spec(introduced[1], introduced[2]) if introduced else None
    if not named or spec is None:
        return None
    arc, path, wanted = named.groups()
    wanted = wanted if wanted.startswith("/") else ""
    asset, target = _authored_target(spec, arc, path, wanted)
    return PrimArc(arc, asset, path, target, wanted, spec)


def missing_arc(text: str) -> LayerArc | None:
    """The arc in an error about a layer that does not open; None if its spec can't be found.

    All supported versions of USD use the same words.
    """
    quoted = _QUOTED.findall(text)
    if len(quoted) < 2:
        return None
    (resolved, _), (identifier, path) = quoted[:2]
    spec = _spec(identifier, path)
    if spec is None:
        return None
    words = text.partition(" -- ")[0]
    arc = next(arc for arc in ARCS if f" {arc} " in _QUOTED.sub("", words))
    return LayerArc(arc, _authored(spec, resolved), resolved, spec)


def reason_in(text: str, resolved: str) -> str:
    """Why a layer does not open, or "" if the text of the error gives no reason."""
    reason = text.partition(" -- ")[2].removesuffix("; skipping.")
    return as_reason(reason, resolved)


def as_reason(text: str, resolved: str) -> str:
    """USD's words about a layer in the style of our messages, with `it` for the layer."""
    text = text.replace(f"<{resolved}>", "it").replace(resolved, display(resolved))
    return _one_line(text).rstrip(". ")


def as_sentence(text: str) -> str:
    """USD's words in the style of our messages, with layers relative to the working directory."""
    line = _ABSOLUTE.sub(lambda path: display(path.group()), _one_line(text)).rstrip(". ")
    return line[:1].lower() + line[1:]


def blamed_spec(text: str) -> Any | None:
    """The spec that the text blames, if it names one; its layer must be open."""
    introduced = _INTRODUCED.search(text)
    if introduced:
        return _spec(introduced[1], introduced[2])
    if _CANNOT in text:  # it ends with the arc that closes a circle, whatever leads into that
        sites = _QUOTED.findall(_ANONYMOUS.sub("", text.partition(_CANNOT)[0]))
        return _spec_with_arcs(Sdf.Layer.Find(sites[-1][0]), sites[-1][1]) if sites else None
    located = _IN_LAYER.search(text)
    return _spec(located["layer"], located["path"]) if located else None


def _one_line(text: str) -> str:
    """USD's words without its line breaks and without the addresses of anonymous layers."""
    return " ".join(_ANONYMOUS.sub("", text).split())


def _spec(identifier: str, path: str) -> Any | None:
    layer = Sdf.Layer.Find(identifier)
    return layer.GetObjectAtPath(path or "/") if layer else None


def _spec_with_arcs(layer: Any | None, path: str) -> Any | None:
    """The strongest spec with arcs at a path of a layer and its sublayers."""
    spec = layer and layer.GetPrimAtPath(path)
    if layer is None or (spec and any(map(spec.HasInfo, FIELDS))):
        return spec
    below = (Sdf.Layer.FindRelativeToLayer(layer, each) for each in layer.subLayerPaths)
    return next(filter(None, (_spec_with_arcs(each, path) for each in below)), None)


def _authored(spec: Any, resolved: str) -> str:
    """The asset path as authored in the layer; the text has only what it resolved to."""
    named = list(_assets_named(spec))
    for asset in named:
        anchored = spec.layer.ComputeAbsolutePath(asset)
        if resolved in (asset, anchored, asset.replace("//", "/")):
            return str(asset)
    expressions = [asset for asset in named if Sdf.VariableExpression.IsExpression(asset)]
    return expressions[0] if len(expressions) == 1 else display(resolved)


def _authored_target(spec: Any, arc: str, path: str, wanted: str) -> tuple[str, str]:
    """The asset path and the prim path of an arc as authored; USD's text has what they led to."""
    prim = spec.layer.GetPrimAtPath(spec.path)
    listed = (prim.referenceList if arc == "reference" else prim.payloadList) if prim else None
    items = listed.GetAddedOrExplicitItems() if listed else ()
    for target in (wanted, ""):
        for item in items:
            if str(item.primPath) == target and _leads_to(spec.layer, item.assetPath, path):
                return str(item.assetPath), target
    return ("" if path == spec.layer.identifier else display(path)), wanted


def _leads_to(layer: Any, asset: str, path: str) -> bool:
    """Whether an asset path in a layer is that of the layer at a path; "" is the layer's own."""
    return not asset or path in (asset, layer.ComputeAbsolutePath(asset))


def _assets_named(spec: Any) -> Iterator[str]:
    if spec.path == Sdf.Path.absoluteRootPath:
        yield from spec.layer.subLayerPaths
        return
    prim = spec.layer.GetPrimAtPath(spec.path)
    if prim:
        for list_op in (prim.referenceList, prim.payloadList):
            yield from (arc.assetPath for arc in list_op.GetAddedOrExplicitItems())
