"""The authored attributes of prims, held against what the schemas declare."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from pxr import Sdf

from usdvol_lint import schema
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.clips import Clips
from usdvol_lint.facts.usd.kinds import KindKey, PrimKinds

Shape: TypeAlias = tuple[tuple[str, ...], bool, bool]
"""The names of authored properties; whether there are several specs; whether there are clips."""


@dataclass(frozen=True, slots=True, eq=False)
class Authored:
    """What prims of one kind share on which the same properties are authored.

    `schemas` are those that they answer to.
    `declared` are those that UsdVol's schemas, or the ones they derive from, declare, with those
    that have values in clips alone; `types` are theirs, `tokens` and `uniform` are some of them.
    `bound` are the names of a Volume's `field:` namespace.
    `undeclared` are names that no schema declares; `misspellings` are those of them with a likely
    correction, and the type that this one has.
    `is_layered` says that several specs have a say, `is_clipped` that value clips may.
    """

    schemas: frozenset[str]
    declared: Mapping[str, schema.Attribute]
    types: tuple[tuple[str, Any], ...]
    tokens: tuple[tuple[str, tuple[str, ...]], ...]
    uniform: tuple[str, ...]
    bound: tuple[str, ...]
    undeclared: frozenset[str]
    misspellings: tuple[tuple[str, str, str], ...]
    is_layered: bool
    is_clipped: bool


class AuthoredReader:
    """Finds what is authored on prims: there are few combinations, and many prims of each."""

    def __init__(self, kinds: PrimKinds, clips: Clips) -> None:
        self._kinds = kinds
        self._clips = clips
        self._shared: dict[tuple[KindKey, Shape], Authored] = {}

    def shapes(self, batch: PrimBatch, key: KindKey) -> list[Shape]:
        """What makes prims of one kind alike: names, and who else may have a say in the values."""
        are_clipped = self._clips.reach(batch)
        are_layered = [len(stack) > 1 for stack in batch.stacks]
        shapes = list(zip(batch.names, are_layered, are_clipped, strict=True))
        if any(are_clipped):
            known = schema.attributes_of(self._kinds.names(key))
            for row, prim in enumerate(batch.prims):
                if are_clipped[row]:
                    also = (name for name in known if prim.GetAttribute(name).HasAuthoredValue())
                    shapes[row] = ((*batch.names[row], *also), are_layered[row], True)
        return shapes

    def read(self, prim: Any, key: KindKey, shape: Shape) -> Authored:
        """What is authored on all prims of a kind that are of a shape; `prim` is one of them."""
        found = self._shared.get((key, shape))
        if found is None:
            found = self._shared[key, shape] = _compare(prim, self._kinds.names(key), *shape)
        return found

    def read_alone(self, prim: Any) -> Authored:
        """What is authored on one prim."""
        key = self._kinds.key(prim)
        (shape,) = self.shapes(PrimBatch((prim,)), key)
        return self.read(prim, key, shape)


def _compare(
    prim: Any, schemas: frozenset[str], names: Iterable[str], is_layered: bool, is_clipped: bool
) -> Authored:
    known = schema.attributes_of(schemas)
    candidates = dict(known)
    if schema.PARTICLE_FIELD in schemas:
        candidates.update(schema.attributes_of(schema.API_ATTRIBUTES))  # whether applied or not
    registered = prim.GetPrimDefinition().GetPropertyNames()
    declared = {name: known[name] for name in names if name in known}
    undeclared = frozenset(names).difference(candidates, registered)
    bound: tuple[str, ...] = ()
    if schema.VOLUME in schemas:
        bound = tuple(name for name in names if name.startswith(schema.FIELD_NAMESPACE))
        undeclared = undeclared.difference(bound)
    return Authored(
        schemas=schemas,
        declared=declared,
        types=tuple(
            (name, Sdf.ValueTypeNames.Find(attribute.type_name))
            for name, attribute in declared.items()
        ),
        tokens=tuple((name, known.tokens) for name, known in declared.items() if known.tokens),
        uniform=tuple(name for name, known in declared.items() if known.uniform),
        bound=bound,
        undeclared=undeclared,
        misspellings=tuple(
            (name, meant, candidates[meant].type_name)
            for name in sorted(undeclared)
            if (meant := schema.misspelt_attribute(name, candidates))
        ),
        is_layered=is_layered,
        is_clipped=is_clipped,
    )
