"""Reads the values of asset attributes, and classifies each by what it resolves to."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import Any

from pxr import Ar, Sdf, Usd

from usdvol_lint.facts.files.assets import AssetSample, AssetSamples
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.paths import anchored, is_packaged, is_uri
from usdvol_lint.facts.files.patterns import find_pattern
from usdvol_lint.facts.files.states import AssetState, FileFault
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.clips import authored_path
from usdvol_lint.facts.usd.opinions import is_of_retimed_clip, strongest_opinion
from usdvol_lint.facts.usd.values import read_values
from usdvol_lint.paths import FORMAT_ARGUMENTS

_LIVE_SCHEMES = frozenset({"op", "opdef", "oplib"})
"""Schemes of paths into a Houdini session."""
_READ_TOGETHER = 1024
_FILE = frozenset({AssetState.FILE})


class AssetReader:
    """Reads every value that USD gives for an attribute: default, time samples, value clips.

    `advance` is told how many samples were read since its last call.
    """

    def __init__(self, disk: Disk, advance: Callable[[int], None]) -> None:
        self._disk = disk
        self._advance = advance
        self._defaults: dict[Any, tuple[AssetSample]] = {}
        """The samples of defaults that resolve to files, by value: fields share them."""

    def read(self, batch: PrimBatch, name: str) -> list[AssetSamples]:
        """The values of an attribute of that name on each of many prims."""
        known = self._defaults
        return [
            AssetSamples(attribute, known[value], _FILE)
            if not count and isinstance(value, Sdf.AssetPath) and value in known
            else self._read(attribute, count, value)
            for attribute, count, value in zip(
                batch.attributes(name), batch.counts(name), batch.values(name), strict=True
            )
        ]

    def _read(self, attribute: Any, count: int, value: Any) -> AssetSamples:
        if count:
            samples = tuple(self._read_samples(attribute))
            states = frozenset(sample.state for sample in samples)
            return AssetSamples(attribute, samples, states)
        if value is None and not attribute.GetResolveInfo().ValueIsBlocked():
            return AssetSamples(attribute, (), frozenset())
        default = _classify(attribute, None, value, self._disk)
        if default.state is AssetState.FILE and FORMAT_ARGUMENTS not in default.path:
            self._defaults[value] = (default,)
        return AssetSamples(attribute, (default,), frozenset({default.state}))

    def _read_samples(self, attribute: Any) -> Iterator[AssetSample]:
        for number, (time, value) in enumerate(read_values(attribute), start=1):
            yield _classify(attribute, time, value, self._disk)
            if number % _READ_TOGETHER == 0:
                self._advance(_READ_TOGETHER)


def _classify(attribute: Any, time: float | None, value: Any, disk: Disk) -> AssetSample:
    if value is None:
        return AssetSample(time, "", "", "", AssetState.BLOCKED)
    if not isinstance(value, Sdf.AssetPath):
        return AssetSample(time, str(value), "", "", AssetState.MISTYPED)
    path, resolved = value.path, value.resolvedPath
    led_to = ""
    if path and disk.storage.knows_any:
        names = _names(attribute, time, path)
        led_to = disk.storage.led_to(*names)
        if disk.storage.is_assumed(*names, *filter(None, (led_to,))):
            return AssetSample(time, authored_path(value) or path, path, "", AssetState.ASSUMED)
        found = _file_at(led_to)
        resolved, led_to = found or resolved, led_to if found or not resolved else ""
    if not led_to and (FORMAT_ARGUMENTS in path or (not resolved and _is_retimed(attribute, time))):
        resolved = _resolved_anew(attribute, time, path)
    fault = disk.fault(resolved) if resolved else None
    if fault is FileFault.BROKEN_LINK:
        resolved, fault = "", None  # USD resolves a link without asking where it leads
    if resolved and not fault:
        authored = authored_path(value) or path
        return AssetSample(time, authored, path, resolved, AssetState.FILE, led_to=led_to)
    authored = authored_path(value) or _authored_in_layer(attribute, time) or path
    if fault:
        return AssetSample(time, authored, path, resolved, AssetState.NOT_A_FILE, fault, led_to)
    state, detail = _why_unresolved(attribute, time, authored, path, led_to)
    return AssetSample(time, authored, path, "", state, detail, led_to)


def _names(attribute: Any, time: float | None, path: str) -> tuple[str, str]:
    """A path as it is written, and its absolute form, both without file format arguments."""
    return path.partition(FORMAT_ARGUMENTS)[0], anchored(attribute, time, path)


def _file_at(path: str) -> str:
    """The file at an absolute path, which may be one in a package; empty if none is there."""
    if is_packaged(path):
        return str(Ar.GetResolver().Resolve(path))
    return path if os.path.isfile(path) else ""


def _authored_in_layer(attribute: Any, time: float | None) -> str | None:
    """The text in the layer, for a USD that forgets what it was evaluated from."""
    strongest = strongest_opinion(attribute, time)
    if strongest is None:
        return None
    spec, offset = strongest
    value = None
    if time is not None:
        layer_time = offset.GetInverse() * time
        _, *around = spec.layer.GetBracketingTimeSamplesForPath(spec.path, layer_time)
        nearest = min(around, key=lambda sample: abs(sample - layer_time))
        value = spec.layer.QueryTimeSample(spec.path, nearest)
    value = value or spec.default
    return str(value.path) if isinstance(value, Sdf.AssetPath) else None


def _is_retimed(attribute: Any, time: float | None) -> bool:
    """Whether a value is one of retimed clips, whose paths USD anchors at another clip (26.11)."""
    if time is None or not (found := strongest_opinion(attribute, time)):
        return False
    return is_of_retimed_clip(attribute, time, found)


def _resolved_anew(attribute: Any, time: float | None, path: str) -> str:
    """The file that a path names, without arguments, where USD may give none or another one."""
    with Ar.ResolverContextBinder(attribute.GetStage().GetPathResolverContext()):
        return str(Ar.GetResolver().Resolve(anchored(attribute, time, path)))


def _why_unresolved(
    attribute: Any, time: float | None, authored: str, path: str, led_to: str
) -> tuple[AssetState, str]:
    """The state of a value that resolves to no file, and its detail."""
    if Sdf.VariableExpression.IsExpression(authored):
        variables = _expression_variables(attribute, time)
        result = Sdf.VariableExpression(authored).Evaluate(variables)
        if result.errors:
            return AssetState.BROKEN_EXPRESSION, result.errors[0]
        if result.value not in (None, "") and not isinstance(result.value, str):
            return AssetState.BROKEN_EXPRESSION, f"it gives {result.value!r}, not a string"
        unset = sorted(name for name in result.usedVariables - variables.keys() if name in path)
        if unset:
            return AssetState.UNSET_VARIABLE, ", ".join(unset)
        path = result.value or ""
    if not path:
        return AssetState.EMPTY, ""
    if is_uri(path) and not led_to:
        scheme = path.partition(":")[0]
        live = scheme.lower() in _LIVE_SCHEMES
        return AssetState.LIVE_SESSION if live else AssetState.UNVERIFIABLE, scheme
    bare, query, _ = path.partition("?")
    if query and os.path.isfile(anchored(attribute, time, bare)):
        return AssetState.UNVERIFIABLE, "?"
    if pattern := find_pattern(path):
        return AssetState.PATTERN, pattern
    return AssetState.MISSING, ""


def _expression_variables(attribute: Any, time: float | None) -> dict[str, Any]:
    """The expression variables of the layer stack that holds the strongest opinion."""
    code = Usd.TimeCode.Default() if time is None else time
    node = attribute.GetResolveInfo(code).GetNode()
    return dict(node.layerStack.expressionVariables.GetVariables()) if node else {}
