"""Reads the texts of USD's composition errors, which are all that Python can see of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.paths import display

ARCS = ("sublayer", "reference", "payload")
"""The composition arcs that name a layer, in the words of these texts."""

_QUOTED = re.compile(r"@(.+?)@(?:<([^>]*)>)?")
_INTRODUCED = re.compile(r"introduced by @(.+?)@<([^>]*)>")
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
    located = _IN_LAYER.search(text)
    return _spec(located["layer"], located["path"]) if located else None


def _one_line(text: str) -> str:
    """USD's words without its line breaks and without the addresses of anonymous layers."""
    return " ".join(_ANONYMOUS.sub("", text).split())


def _spec(identifier: str, path: str) -> Any | None:
    layer = Sdf.Layer.Find(identifier)
    return layer.GetObjectAtPath(path or "/") if layer else None


def _authored(spec: Any, resolved: str) -> str:
    """The asset path as authored in the layer; the text has only what it resolved to."""
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
