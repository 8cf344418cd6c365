"""What a field says of the content of its files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import count_samples, get_value
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.facts.usd.values import read_values

_ATTRIBUTES = {
    "fieldName": "name",
    "fieldPurpose": "purpose",
    "fieldIndex": "index",
    "fieldDataType": "data_type",
    "fieldClass": "field_class",
    "vectorDataRoleHint": "role_hint",
}
_TYPES = {name: int if name == "index" else str for name in _ATTRIBUTES.values()}


@dataclass(frozen=True, slots=True, eq=False)
class Claim:
    """What a field says at one time of what it wants from its file; empty where it says nothing.

    Fields of a stage that say the same share one.
    """

    name: str = ""
    purpose: str = ""
    index: int | None = None
    data_type: str = ""
    field_class: str = ""
    role_hint: str = ""


class FieldClaims:
    """What a field says over time: `times` are those at which it changes, if it ever does.

    Fields of a stage that say the same once and for all share one.
    """

    def __init__(self, default: Claim, samples: Sequence[tuple[float, Claim]] = ()) -> None:
        self.default = default
        self._samples = StepSamples(samples)
        self.times = self._samples.times
        self.all = (default, *(claim for _, claim in samples))

    def at(self, time: Time) -> Claim:
        """What it says at a time."""
        return self.default if time is None else self._samples.at(time) or self.default


class ClaimReader:
    """Reads what the fields of a stage say."""

    def __init__(self) -> None:
        self._claims: dict[tuple[Any, ...], Claim] = {}
        self._unchanging: dict[tuple[Any, ...], FieldClaims] = {}

    def read(self, batch: PrimBatch, authored: Authored) -> list[FieldClaims]:
        """What many fields say that are alike."""
        names = tuple(name for name in _ATTRIBUTES if name in authored.declared)
        if not names:
            return [self._constant((), ())] * len(batch.prims)
        values = zip(*map(batch.values, names), strict=True)
        counts = zip(*map(batch.counts, names), strict=True)
        found = []
        for field, said, are_animated in zip(batch.prims, values, counts, strict=True):
            if any(are_animated):
                found.append(self._read_changing([field.GetAttribute(name) for name in names]))
            else:
                found.append(self._constant(names, said))
        return found

    def _constant(self, names: tuple[str, ...], said: tuple[Any, ...]) -> FieldClaims:
        key = (names, said, *map(type, said))  # to a dictionary 1, 1.0 and True are the same
        found = self._unchanging.get(key)
        if found is None:
            claim = self._claim(dict(zip(map(_ATTRIBUTES.__getitem__, names), said, strict=True)))
            found = self._unchanging[key] = FieldClaims(claim)
        return found

    def _read_changing(self, attributes: Sequence[Any]) -> FieldClaims:
        constant: dict[str, Any] = {}
        animated: dict[str, StepSamples[Any]] = {}
        for attribute in attributes:
            name = _ATTRIBUTES[attribute.GetName()]
            if count_samples(attribute):
                animated[name] = StepSamples(read_values(attribute))
            else:
                constant[name] = get_value(attribute)

        def at(time: Time) -> Claim:
            return self._claim(constant | {name: held.at(time) for name, held in animated.items()})

        times = {time for held in animated.values() for time in held.times}
        return FieldClaims(at(None), [(time, at(time)) for time in sorted(times)])

    def _claim(self, said: dict[str, Any]) -> Claim:
        """The claim of these values, the same one for the same values."""
        given: Any = {name: value for name, value in said.items() if type(value) is _TYPES[name]}
        return self._claims.setdefault(tuple(given.items()), Claim(**given))
