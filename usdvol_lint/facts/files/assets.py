"""Asset attributes: every authored sample, resolved as USD does it, and classified."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, NamedTuple

from pxr import Ar, Sdf, Usd

from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.patterns import find_pattern
from usdvol_lint.facts.files.states import PLACES, AssetState, FileFault
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.clips import ClipSet, authored_path, open_layer
from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion
from usdvol_lint.facts.usd.values import Occurrences, read_values
from usdvol_lint.model import frame_ranges, quoted

_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+-]+):")
_LIVE_SCHEMES = frozenset({"op", "opdef", "oplib"})
_FORMAT_ARGUMENTS = ":SDF_FORMAT_ARGS:"
_LAYERS_NAMED = 3
_READ_TOGETHER = 1024
_FILE = frozenset({AssetState.FILE})
_PATH_OF = attrgetter("path")


class Sample(NamedTuple):
    """One value of an asset attribute.

    `time` is None for the default; `authored` is as written, an expression where it is one and
    `path` what it evaluates to; `resolved` is the file, without arguments for a file format;
    `detail` says more of the state: the fault, the error, the variable, the scheme, the pattern.
    """

    time: float | None
    authored: str
    path: str
    resolved: str
    state: AssetState
    detail: str = ""

    @property
    def is_there(self) -> bool:
        """Whether it is a readable file with content."""
        return self.state is AssetState.FILE


class AssetSamples(NamedTuple):
    """All samples of one asset attribute in ascending time, the default first.

    `states` are those that occur: most rules find nothing, and need not look at each sample.
    """

    attribute: Any
    samples: tuple[Sample, ...]
    states: frozenset[AssetState]

    def of(self, *states: AssetState) -> Affected | None:
        """The samples in one of these states, or None if there are none."""
        if self.states.isdisjoint(states):
            return None
        return self.affected(sample for sample in self.samples if sample.state in states)

    def matching(
        self, pattern: re.Pattern[str], states: Collection[AssetState] = PLACES
    ) -> Affected | None:
        """The samples in one of these states whose paths match from their start."""
        if not any(map(pattern.match, map(_PATH_OF, self.samples))):  # no loop of ours: most do not
            return None
        return self.affected(
            sample
            for sample in self.samples
            if sample.state in states and pattern.match(sample.path)
        )

    def affected(self, samples: Iterable[Sample]) -> Affected | None:
        """Some of the samples, or None if there are none."""
        found = tuple(samples)
        timed = sum(sample.time is not None for sample in self.samples) if found else 0
        return Affected(self.attribute, found, timed) if found else None

    def anchored(self, sample: Sample) -> str:
        """The absolute path that a sample would have, did it exist."""
        return _anchored(self.attribute, sample.time, sample.path)

    def by_detail(self, *states: AssetState) -> Iterator[Affected]:
        """The samples in one of these states, apart for each detail."""
        found = self.of(*states)
        if found:
            apart: dict[str, list[Sample]] = defaultdict(list)
            for sample in found.samples:
                apart[sample.detail].append(sample)
            yield from (replace(found, samples=tuple(samples)) for samples in apart.values())

    @property
    def names_a_path(self) -> bool:
        """Whether there is a value of some kind at some time."""
        return not self.states <= {AssetState.EMPTY, AssetState.BLOCKED}


@dataclass(frozen=True, slots=True)
class Affected(Occurrences):
    """Some of an attribute's samples, with what a finding says of them."""

    samples: tuple[Sample, ...]

    @property
    def first(self) -> Sample:
        return self.samples[0]

    @property
    def asset(self) -> str:
        return self.first.authored

    @property
    def shown(self) -> str:
        """The first path in quotes, with the expression that it was evaluated from."""
        first = self.first
        origin = "" if first.authored == first.path else f" (from {quoted(first.authored)})"
        return f"{quoted(first.path)}{origin}"

    def _more(self, times: Sequence[float]) -> Iterator[str]:
        """The frames as authored where they differ, and the layers where there are several."""
        authored = self._authored(times)
        if authored != times:
            frames = "frame" if len(authored) == 1 else "frames"
            yield f"authored as {frames} {frame_ranges(authored)}"
        layers = self._layers(times)
        if len(layers) > 1:
            more = f" and {len(layers) - _LAYERS_NAMED} more" if len(layers) > _LAYERS_NAMED else ""
            yield f"in {len(layers)} layers: {', '.join(layers[:_LAYERS_NAMED])}{more}"

    def _authored(self, times: Sequence[float]) -> Sequence[float]:
        """The times as the layer of the first sample has them, before its layer offset."""
        held = strongest_opinion(self.attribute, times[0])
        if held is None or held.offset.IsIdentity():
            return times
        inverse = held.offset.GetInverse()
        return tuple(sorted(inverse * time for time in times))

    def _layers(self, times: Sequence[float]) -> list[str]:
        """The names of the layers that hold the samples; only clips spread them over several."""
        from_clips = is_from_clips(self.attribute, times[0])
        asked = self.samples if from_clips else (self.samples[0], self.samples[-1])
        held = (strongest_opinion(self.attribute, sample.time) for sample in asked)
        return list(dict.fromkeys(found.spec.layer.GetDisplayName() for found in held if found))

    def anchored(self) -> str:
        """The absolute path that the first sample would have, did it exist."""
        return _anchored(self.attribute, self.first.time, self.first.path)


class AssetReader:
    """Reads every value that USD gives for an attribute: default, time samples, value clips.

    `advance` is told how many samples were read since its last call.
    """

    def __init__(self, disk: Disk, advance: Callable[[int], None]) -> None:
        self._disk = disk
        self._advance = advance
        self._alone: dict[Any, tuple[Sample]] = {}
        """Defaults that name files, which are the same wherever they are authored."""

    def read(self, batch: PrimBatch, name: str) -> list[AssetSamples]:
        """The values of an attribute of that name on each of many prims."""
        known = self._alone
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
            samples = tuple(self._classified(attribute))
            return AssetSamples(attribute, samples, frozenset(each.state for each in samples))
        if value is None and not attribute.GetResolveInfo().ValueIsBlocked():
            return AssetSamples(attribute, (), frozenset())
        alone = (_classify(attribute, None, value, self._disk),)
        if alone[0].state is AssetState.FILE and _FORMAT_ARGUMENTS not in alone[0].path:
            self._alone[value] = alone
        return AssetSamples(attribute, alone, frozenset({alone[0].state}))

    def _classified(self, attribute: Any) -> Iterator[Sample]:
        for number, (time, value) in enumerate(read_values(attribute), start=1):
            yield _classify(attribute, time, value, self._disk)
            if number % _READ_TOGETHER == 0:
                self._advance(_READ_TOGETHER)


def hidden_animation(attribute: Any, clips: tuple[ClipSet, ...]) -> str | None:
    """The weaker time samples or clip set, in words, that a stronger default hides."""
    specs = attribute.GetPropertyStack()
    if len(specs) < 2 and not clips:
        return None  # so it is nearly always, and all that follows takes time
    held = strongest_opinion(attribute, None)
    if held is None or attribute.Get() is None or attribute.GetNumTimeSamples():
        return None
    for spec in specs:
        if count := spec.layer.GetNumTimeSamplesForPath(spec.path):
            samples = "time sample" if count == 1 else f"{count} time samples"
            return f"the {samples} in {quoted(spec.layer.GetDisplayName())}"
    for clip_set in clips:
        if clip_set.is_outranked_by(held.spec) and clip_set.layer_with_samples(attribute):
            return f"the value clips {quoted(clip_set.name)} on <{shown(clip_set.prim).path}>"
    return None


@dataclass(frozen=True, slots=True)
class UnlistedClips:
    """Clips that hold samples of an attribute which their manifest does not declare.

    `clip` and `manifest` are the names of layers; `spec` names the manifest at `manifest_path`.
    """

    clip: str
    manifest: str
    manifest_path: str
    spec: Any


def unlisted_clips(attribute: Any, clips: tuple[ClipSet, ...]) -> UnlistedClips | None:
    """The clips that would give the attribute its values if the manifest declared it."""
    if not clips or attribute.GetNumTimeSamples():
        return None
    held = strongest_opinion(attribute, None)
    for clip_set in clips:
        if held and clip_set.is_outranked_by(held.spec):
            return None
        manifest = clip_set.manifest
        declared = open_layer(manifest) if manifest else None
        if not manifest or not declared:
            continue
        clip = clip_set.layer_with_samples(attribute)
        if clip and not declared.GetAttributeAtPath(clip_set.path_in_layers(attribute)):
            return UnlistedClips(
                clip.GetDisplayName(),
                declared.GetDisplayName(),
                authored_path(manifest) or manifest.path,
                clip_set.spec_with("manifestAssetPath"),
            )
    return None


def _classify(attribute: Any, time: float | None, value: Any, disk: Disk) -> Sample:
    if value is None:
        return Sample(time, "", "", "", AssetState.BLOCKED)
    if not isinstance(value, Sdf.AssetPath):
        return Sample(time, str(value), "", "", AssetState.MISTYPED)
    path, resolved = value.path, value.resolvedPath
    if _FORMAT_ARGUMENTS in path:
        resolved = _resolved_without_arguments(attribute, time, path)
    fault = disk.fault(resolved) if resolved else None
    if fault is FileFault.BROKEN_LINK:
        resolved, fault = "", None  # USD takes a link for a file, wherever it leads
    if resolved and not fault:
        return Sample(time, authored_path(value) or path, path, resolved, AssetState.FILE)
    authored = authored_path(value) or _authored_in_layer(attribute, time) or path
    if fault:
        return Sample(time, authored, path, resolved, AssetState.NOT_A_FILE, fault)
    state, detail = _why_unresolved(attribute, time, authored, path)
    return Sample(time, authored, path, "", state, detail)


def _authored_in_layer(attribute: Any, time: float | None) -> str | None:
    held = strongest_opinion(attribute, time)
    if held is None:
        return None
    spec, offset = held
    value = None
    if time is not None:
        there = offset.GetInverse() * time
        _, *around = spec.layer.GetBracketingTimeSamplesForPath(spec.path, there)
        nearest = min(around, key=lambda sample: abs(sample - there))
        value = spec.layer.QueryTimeSample(spec.path, nearest)
    value = value or spec.default
    return str(value.path) if isinstance(value, Sdf.AssetPath) else None


def _resolved_without_arguments(attribute: Any, time: float | None, path: str) -> str:
    """The file that a path with file format arguments names: USD versions do not agree here."""
    with Ar.ResolverContextBinder(attribute.GetStage().GetPathResolverContext()):
        return str(Ar.GetResolver().Resolve(_anchored(attribute, time, path)))


def _anchored(attribute: Any, time: float | None, path: str) -> str:
    """The absolute path, in relation to the layer that holds the opinion, without arguments."""
    bare = str(Sdf.Layer.SplitIdentifier(path)[0])
    held = strongest_opinion(attribute, time)
    if held is None:
        return bare
    layer = held.spec.layer
    absolute = str(layer.ComputeAbsolutePath(bare))
    # USD leaves a bare name that it finds nowhere to the resolver's search path.
    searched = absolute == bare and not (os.path.isabs(bare) or is_uri(bare))
    return str(layer.ComputeAbsolutePath(f"./{bare}")) if searched else absolute


def _why_unresolved(
    attribute: Any, time: float | None, authored: str, path: str
) -> tuple[AssetState, str]:
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
    if is_uri(path):
        scheme = path.partition(":")[0]
        live = scheme in _LIVE_SCHEMES
        return AssetState.LIVE_SESSION if live else AssetState.UNVERIFIABLE, scheme
    if pattern := find_pattern(path):
        return AssetState.PATTERN, pattern
    return AssetState.MISSING, ""


def _expression_variables(attribute: Any, time: float | None) -> dict[str, Any]:
    """The variables that USD knows where the opinion is."""
    code = Usd.TimeCode.Default() if time is None else time
    node = attribute.GetResolveInfo(code).GetNode()
    return dict(node.layerStack.expressionVariables.GetVariables()) if node else {}


def is_uri(path: str) -> bool:
    """Whether a path has a scheme that no resolver here answers for."""
    if ":" not in path:
        return False
    scheme = _SCHEME.match(Sdf.Layer.SplitIdentifier(path)[0])
    return scheme is not None and scheme[1].lower() not in Ar.GetRegisteredURISchemes()
