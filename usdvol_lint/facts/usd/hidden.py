"""Time samples and value clips of an attribute that a stronger default hides."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.facts.usd.clips import ClipSet
from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.words import quoted


class HiddenAnimation(NamedTuple):
    """The strongest of what is hidden, in words; the `layers` that hold it, all at one `path`."""

    words: str
    layers: tuple[Any, ...]
    path: Any

    def values(self) -> Iterator[Any]:
        """The value of each sample, read one after the other; none of blocks."""
        for layer in self.layers:
            for time in layer.ListTimeSamplesForPath(self.path):
                value = layer.QueryTimeSample(self.path, time)
                if value is not None and not isinstance(value, Sdf.ValueBlock):
                    yield value

    @property
    def differs(self) -> bool:
        """Whether two of the values differ."""
        values = self.values()
        first = next(values, None)
        return any(value != first for value in values)


def hidden_animation(attribute: Any, clips: tuple[ClipSet, ...]) -> HiddenAnimation | None:
    """The time samples or clips of an attribute that a stronger default hides; None if none are."""
    specs = attribute.GetPropertyStack()
    if len(specs) < 2 and not clips:
        return None  # nearly always, and what follows is slow
    default = strongest_opinion(attribute, None)
    if default is None or attribute.Get() is None or attribute.GetNumTimeSamples():
        return None
    for spec in specs:
        if count := spec.layer.GetNumTimeSamplesForPath(spec.path):
            samples = "time sample" if count == 1 else f"{count} time samples"
            words = f"the {samples} in {quoted(spec.layer.GetDisplayName())}"
            return HiddenAnimation(words, (spec.layer,), spec.path)
    for clip_set in clips:
        layers = clip_set.layers_with_samples(attribute)
        if (
            layers
            and not clip_set.passes_over(attribute)
            and clip_set.is_outranked_by(default.spec)
        ):
            words = f"the value clips {quoted(clip_set.name)} on <{shown(clip_set.prim).path}>"
            return HiddenAnimation(words, layers, clip_set.path_in_layers(attribute))
    return None
