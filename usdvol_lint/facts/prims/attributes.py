"""The authored properties of prims, sorted by what the schemas declare."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

from pxr import Sdf

from usdvol_lint import schema, spelling
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.clips import Clips
from usdvol_lint.facts.usd.kinds import KindKey, PrimKinds

Shape: TypeAlias = tuple[tuple[str, ...], bool, bool]
"""The names of authored properties; whether a prim has several specs; whether clips apply to it."""

_API_OF = {
    "colorSpace:name": "ColorSpaceAPI",
    **{name: api for api, names in schema.API_ATTRIBUTES.items() for name in names},
}
"""By the names of attributes that applied APIs declare, these APIs."""


@dataclass(frozen=True, slots=True, eq=False)
class Authored:
    """The properties authored on prims of one kind and shape: these prims share it.

    `schemas`: those that the prims answer to.
    `declared`: by name, the attributes that UsdVol's schemas or their bases declare, including
    those that have values only in clips.
    `types`: the names of these with their `Sdf.ValueTypeName`s.
    `tokens`: the names of those that allow only certain tokens, with these.
    `uniform`: the names of those that must not be animated.
    `bound`: the property names in the `field:` namespace, for Volumes.
    `lacks_apis`: whether a particle field has no API for positions, kernel or radiance, or none for
    an attribute.
    `undeclared`: the names that no schema declares.
    `misspellings`: those of them, and of those that UsdGeom declares, with a likely correction:
    name, corrected name, its type.
    `is_layered`: whether the prims have several specs.
    `is_clipped`: whether value clips apply to them.
    """

    LASTS: ClassVar = True

    schemas: frozenset[str]
    declared: Mapping[str, schema.Attribute]
    types: tuple[tuple[str, Any], ...]
    tokens: tuple[tuple[str, tuple[str, ...]], ...]
    uniform: tuple[str, ...]
    bound: tuple[str, ...]
    lacks_apis: bool
    undeclared: frozenset[str]
    misspellings: tuple[tuple[str, str, str], ...]
    is_layered: bool
    is_clipped: bool


_MOST_SHARED = 10_000
_SHARED: dict[tuple[KindKey, frozenset[str], Shape], Authored] = {}
"""What is authored on prims of a kind and shape is the same on all stages."""


class AuthoredReader:
    """Reads what is authored on prims, once for all prims of one kind and shape."""

    def __init__(self, kinds: PrimKinds, clips: Clips) -> None:
        self._kinds = kinds
        self._clips = clips

    def shapes(self, batch: PrimBatch, key: KindKey) -> list[Shape]:
        """The shapes of prims of one kind; attributes with values in clips count as authored."""
        are_clipped = self._clips.reach(batch)
        are_layered = [len(stack) > 1 for stack in batch.stacks]
        shapes = list(zip(batch.names, are_layered, are_clipped, strict=True))
        if any(are_clipped):
            known = schema.attributes_of(self._kinds.names(key))
            for row, prim in enumerate(batch.prims):
                if are_clipped[row]:
                    valued = (name for name in known if prim.GetAttribute(name).HasAuthoredValue())
                    shapes[row] = ((*batch.names[row], *valued), are_layered[row], True)
        return shapes

    def read(self, prim: Any, key: KindKey, shape: Shape) -> Authored:
        """What is authored on the prims of a kind and shape; `prim` is one of them."""
        schemas = self._kinds.names(key)
        authored = _SHARED.get((key, schemas, shape))
        if authored is None:
            if len(_SHARED) >= _MOST_SHARED:
                _SHARED.clear()
            authored = _SHARED[key, schemas, shape] = _sort_by_schema(prim, schemas, *shape)
        return authored

    def read_alone(self, prim: Any) -> Authored:
        """What is authored on one prim."""
        key = self._kinds.key(prim)
        (shape,) = self.shapes(PrimBatch((prim,)), key)
        return self.read(prim, key, shape)


def _sort_by_schema(
    prim: Any, schemas: frozenset[str], names: Iterable[str], is_layered: bool, is_clipped: bool
) -> Authored:
    known = schema.attributes_of(schemas)
    candidates = dict(known)
    if schema.PARTICLE_FIELD in schemas:
        candidates.update(schema.attributes_of(schema.API_ATTRIBUTES))  # whether applied or not
    registered = prim.GetPrimDefinition().GetPropertyNames()
    declared = {name: known[name] for name in names if name in known}
    undeclared = frozenset(names).difference(candidates, registered)
    inherited = declared.keys() - schema.DECLARED_BY.keys()
    needed = {*schema.BASE_APIS, *(_API_OF[name] for name in names if name in _API_OF)}
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
        lacks_apis=schema.PARTICLE_FIELD in schemas and not schemas.issuperset(needed),
        undeclared=undeclared,
        misspellings=tuple(
            (name, meant, candidates[meant].type_name)
            for name in sorted(undeclared | inherited)
            if (meant := spelling.misspelt_attribute(name, candidates.keys() - {name}))
        ),
        is_layered=is_layered,
        is_clipped=is_clipped,
    )
