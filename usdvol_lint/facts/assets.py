"""Asset attributes: every authored sample, resolved as USD does it, and classified."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from pxr import Sdf, Usd

from usdvol_lint.facts.clips import ClipSet
from usdvol_lint.facts.files import Files
from usdvol_lint.facts.states import AssetState
from usdvol_lint.model import frame_ranges

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+-]+:")
_LIVE_SCHEMES = ("op:", "opdef:", "oplib:")
_FORMAT_ARGUMENTS = ":SDF_FORMAT_ARGS:"
_PATTERN = re.compile(
    r"\$\{?F\d*\}?|\$SF\d*|#+|%0?\d*d|<(?:UDIM|f|frame|F)\d*>|@{3,}|\{frame[^}]*\}", re.IGNORECASE
)


@dataclass(frozen=True, slots=True)
class Sample:
    """One value: `time` is None for the default, `path` is evaluated, `detail` says why."""

    time: float | None
    authored: str
    path: str
    resolved: str
    state: AssetState
    detail: str = ""


@dataclass(frozen=True, slots=True)
class AssetSamples:
    """All samples of one asset attribute in ascending time, the default first."""

    attribute: Any
    samples: tuple[Sample, ...]

    def of(self, *states: AssetState) -> Affected | None:
        """The samples in one of these states, or None if there are none."""
        found = tuple(sample for sample in self.samples if sample.state in states)
        return Affected(self.attribute, found, len(self.samples)) if found else None

    @property
    def names_a_path(self) -> bool:
        """Whether there is a value of some kind at some time."""
        nothing = (AssetState.EMPTY, AssetState.BLOCKED)
        return any(sample.state not in nothing for sample in self.samples)


@dataclass(frozen=True, slots=True)
class Affected:
    """Some of an attribute's samples, never none, with what a finding says of them."""

    attribute: Any
    samples: tuple[Sample, ...]
    total: int

    @property
    def first(self) -> Sample:
        return self.samples[0]

    @property
    def times(self) -> tuple[float, ...]:
        """The stage times of the samples, without the default."""
        return tuple(sample.time for sample in self.samples if sample.time is not None)

    @property
    def at_default(self) -> bool:
        return self.samples[0].time is None

    @property
    def count(self) -> str:
        """`` for a single value, else ` (4 of 240 samples)`, with authored frames if they differ."""
        if self.total == 1:
            return ""
        words = f"{len(self.samples)} of {self.total} samples"
        authored = self._authored_times()
        if authored and authored != self.times:
            words += f", authored as frames {frame_ranges(authored)}"
        return f" ({words})"

    def _authored_times(self) -> tuple[float, ...]:
        """The times as the layer of the first sample has them, before its layer offset."""
        if not self.times:
            return ()
        stack = self.attribute.GetPropertyStackWithLayerOffsets(self.times[0])
        if not stack or stack[0][1].IsIdentity():
            return self.times
        inverse = stack[0][1].GetInverse()
        return tuple(sorted(inverse * time for time in self.times))

    def anchored(self) -> str:
        """The absolute path that the first sample would have, did it exist."""
        time = self.first.time
        stack = self.attribute.GetPropertyStack(Usd.TimeCode.Default() if time is None else time)
        path, _ = Sdf.Layer.SplitIdentifier(self.first.path)
        return str(stack[0].layer.ComputeAbsolutePath(path)) if stack else path


def read_asset_samples(
    attribute: Any, files: Files, advance: Callable[[int], None] = lambda count: None
) -> AssetSamples:
    """Reads every value that USD gives for the attribute: default, time samples, value clips.

    `advance` is told how many samples were read since its last call.
    """
    samples = []
    for number, (time, value) in enumerate(_values(attribute), start=1):
        samples.append(_classify(attribute, time, value, files))
        if number % 1024 == 0:
            advance(1024)
    return AssetSamples(attribute, tuple(samples))


def hidden_animation(attribute: Any, clips: tuple[ClipSet, ...]) -> Any | None:
    """The weaker spec, or clip set, whose animation a stronger layer's default hides."""
    stack = attribute.GetPropertyStack()
    valued = [spec for spec in stack if spec.HasInfo("default") or _has_samples(spec)]
    if not valued or _has_samples(valued[0]) or attribute.Get() is None:
        return None
    weaker = next((spec for spec in valued[1:] if _has_samples(spec)), None)
    return weaker or next(
        (clip_set for clip_set in clips if clip_with_samples(attribute, clip_set)), None
    )


def clip_with_samples(attribute: Any, clip_set: ClipSet) -> Any | None:
    """The first of the set's leading clip layers that holds time samples of the attribute."""
    path = clip_set.layer_path(attribute.GetPrim()).AppendProperty(attribute.GetName())
    for clip in clip_set.clips[:_CLIPS_LOOKED_AT]:
        layer = Sdf.Layer.FindOrOpen(clip.resolvedPath) if clip.resolvedPath else None
        if layer and layer.GetNumTimeSamplesForPath(path):
            return layer
    return None


_CLIPS_LOOKED_AT = 4


def _has_samples(spec: Any) -> bool:
    return bool(spec.layer.GetNumTimeSamplesForPath(spec.path))


def _values(attribute: Any) -> Iterator[tuple[float | None, Any]]:
    if not attribute.IsAuthored() and not attribute.HasAuthoredValue():
        return
    default = attribute.Get()
    times = attribute.GetTimeSamples()
    if default is not None or not times:
        yield None, default
    get = attribute.Get
    for index, time in enumerate(times):
        # Where a clip begins, USD adds a sample a hair before it that repeats the last value.
        if index + 1 < len(times) and times[index + 1] - time < 1e-6 * max(1.0, abs(time)):
            continue
        yield time, get(time)


def _classify(attribute: Any, time: float | None, value: Any, files: Files) -> Sample:
    if value is None:
        return Sample(time, "", "", "", AssetState.BLOCKED)
    if not isinstance(value, Sdf.AssetPath):
        return Sample(time, str(value), "", "", AssetState.MISTYPED)
    resolved = value.resolvedPath
    authored = value.authoredPath if _KEEPS_AUTHORED else _authored_path(attribute, time)
    if resolved:
        fault = files.fault(resolved)
        state = AssetState.NOT_A_FILE if fault else AssetState.FILE
        return Sample(time, authored, value.path, resolved, state, fault or "")
    state, detail = _why_unresolved(attribute, authored, value.path)
    return Sample(time, authored, value.path, "", state, detail)


_KEEPS_AUTHORED = hasattr(Sdf.AssetPath, "authoredPath")
"""Old USD forgets the expression that a path was evaluated from."""


def _authored_path(attribute: Any, time: float | None) -> str:
    spec = attribute.GetPropertyStack(Usd.TimeCode.Default() if time is None else time)[0]
    value = spec.default if time is None else spec.layer.QueryTimeSample(spec.path, time)
    return value.path if isinstance(value, Sdf.AssetPath) else attribute.Get(time).path


def _why_unresolved(attribute: Any, authored: str, path: str) -> tuple[AssetState, str]:
    if Sdf.VariableExpression.IsExpression(authored):
        errors = Sdf.VariableExpression(authored).GetErrors()
        if errors:
            return AssetState.BROKEN_EXPRESSION, errors[0]
        unset = _unset_variables(attribute, authored)
        if unset:
            return AssetState.UNSET_VARIABLE, unset[0]
        if Sdf.VariableExpression.IsExpression(path):
            return AssetState.BROKEN_EXPRESSION, "it does not evaluate to a string"
    if not path:
        return AssetState.EMPTY, ""
    if path.startswith(_LIVE_SCHEMES):
        return AssetState.LIVE_SESSION, path.partition(":")[0]
    if is_uri(path):
        return AssetState.UNVERIFIABLE, path.partition(":")[0]
    if pattern := _PATTERN.search(os.path.basename(path)):
        return AssetState.PATTERN, pattern.group()
    return AssetState.MISSING, ""


def is_uri(path: str) -> bool:
    """Whether a path names a scheme that some resolver, not the file system, answers for."""
    return bool(_SCHEME.match(path)) and _FORMAT_ARGUMENTS not in path


def _unset_variables(attribute: Any, expression: str) -> list[str]:
    """The variables of an expression that no layer of the stage sets."""
    used = Sdf.VariableExpression(expression).Evaluate({}).usedVariables
    layers = attribute.GetStage().GetUsedLayers()
    known = {name for layer in layers for name in layer.expressionVariables}
    return sorted(set(used) - known)
