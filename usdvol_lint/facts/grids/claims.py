"""What a field claims about the content of its files."""

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
    """What a field claims about its file at one time; what is not authored is empty or None.

    Compared by identity: fields with the same values share one.
    """

    name: str = ""
    purpose: str = ""
    index: int | None = None
    data_type: str = ""
    field_class: str = ""
    role_hint: str = ""


class FieldClaims:
    """The claims of a field over time, which change at `times`.

    Fields with the same values and without time samples share one.
    """

    def __init__(self, default: Claim, samples: Sequence[tuple[float, Claim]] = ()) -> None:
        self.default = default
        self._samples = StepSamples(samples)
        self.times = self._samples.times
        self.all = (default, *(claim for _, claim in samples))
        self.always_say_type = all(claim.data_type for claim in self.all)

    def at(self, time: Time) -> Claim:
        """The claim at a time."""
        return self.default if time is None else self._samples.at(time) or self.default


class ClaimReader:
    """Reads the claims of fields, on one stage after the other."""

    def __init__(self) -> None:
        self._claims: dict[tuple[Any, ...], Claim] = {}
        self._constants: dict[tuple[Any, ...], FieldClaims] = {}

    def __len__(self) -> int:
        """How many claims are known."""
        return len(self._claims) + len(self._constants)

    def forget(self) -> None:
        """Makes every claim anew from now on."""
        self._claims.clear()
        self._constants.clear()

    def read(self, batch: PrimBatch, authored: Authored) -> list[FieldClaims]:
        """The claims of each of many fields; `authored` is what all of them share."""
        names = tuple(name for name in _ATTRIBUTES if name in authored.declared)
        if not names:
            return [self._constant((), ())] * len(batch.prims)
        values = zip(*map(batch.values, names), strict=True)
        counts = zip(*map(batch.counts, names), strict=True)
        found = []
        for field, defaults, sample_counts in zip(batch.prims, values, counts, strict=True):
            if any(sample_counts):
                found.append(self._read_animated([field.GetAttribute(name) for name in names]))
            else:
                found.append(self._constant(names, defaults))
        return found

    def _constant(self, names: tuple[str, ...], values: tuple[Any, ...]) -> FieldClaims:
        key = (names, values, *map(type, values))  # as keys 1, 1.0 and True are the same
        found = self._constants.get(key)
        if found is None:
            claim = self._claim(dict(zip(map(_ATTRIBUTES.__getitem__, names), values, strict=True)))
            found = self._constants[key] = FieldClaims(claim)
        return found

    def _read_animated(self, attributes: Sequence[Any]) -> FieldClaims:
        constant: dict[str, Any] = {}
        animated: dict[str, StepSamples[Any]] = {}
        for attribute in attributes:
            name = _ATTRIBUTES[attribute.GetName()]
            if count_samples(attribute):
                animated[name] = StepSamples(read_values(attribute))
            else:
                constant[name] = get_value(attribute)

        def at(time: Time) -> Claim:
            return self._claim(
                constant | {name: samples.at(time) for name, samples in animated.items()}
            )

        times = {time for samples in animated.values() for time in samples.times}
        return FieldClaims(at(None), [(time, at(time)) for time in sorted(times)])

    def _claim(self, values: dict[str, Any]) -> Claim:
        """The claim with these values, always the same object; those of other types are dropped."""
        typed: Any = {name: value for name, value in values.items() if type(value) is _TYPES[name]}
        key = tuple(sorted(typed.items()))  # constant values come before animated ones
        return self._claims.setdefault(key, Claim(**typed))
