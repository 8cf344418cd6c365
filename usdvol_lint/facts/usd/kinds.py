"""Which schemas a prim answers to, cached by its type name and applied schemas."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any, TypeAlias

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import get_applied, get_type

KindKey: TypeAlias = tuple[str, ...]
"""A prim's type name, then the names of its applied schemas."""


class PrimKinds:
    """The schema names of each kind of prim: its type and bases, and its applied APIs.

    `fallbacks` is the stage's `fallbackPrimTypes`: the types that stand in for one that no plugin
    registers.
    """

    def __init__(self, fallbacks: Mapping[str, Sequence[str]] | None = None) -> None:
        self.knows_particle_fields = is_registered(schema.PARTICLE_FIELD)
        self._fallbacks = fallbacks or {}
        self._names: dict[KindKey, frozenset[str]] = {}
        self._known_keys: dict[tuple[str, tuple[str, ...], tuple[str, ...]], KindKey] = {}

    def key(self, prim: Any) -> KindKey:
        """The key of a prim's kind."""
        return self.keys((prim,))[0]

    def keys(self, prims: Sequence[Any]) -> list[KindKey]:
        """The keys of many prims' kinds, in a third of the time of asking for each."""
        try:
            return self._keys(prims, list(map(get_type, prims)))
        except UnicodeDecodeError:
            return self._keys(prims, list(map(_decoded_type, prims)))

    def _keys(self, prims: Sequence[Any], types: Sequence[str]) -> list[KindKey]:
        applied = list(map(get_applied, prims))
        if self.knows_particle_fields:
            if not any(applied):
                return list(zip(types))
            return [(name, *apis) for name, apis in zip(types, applied, strict=True)]
        known = self._known_keys
        schemas = zip(types, map(tuple, applied), map(raw_apis, prims), strict=True)
        return [known[names] if names in known else self._with_ours(*names) for names in schemas]

    def applied(self, prim: Any) -> tuple[str, ...]:
        """The applied schemas, those of particle fields also on a USD that does not know them."""
        return self.key(prim)[1:]

    def _with_ours(
        self, type_name: str, applied: tuple[str, ...], written: tuple[str, ...]
    ) -> KindKey:
        """The key on a USD without particle fields, whose APIs are known only as `written`."""
        ours = tuple(name for name in written if name in schema.API_INCLUDES)
        built_in = schema.BUILT_IN_APIS.get(type_name, ())
        key = (type_name, *applied, *schema.expand_apis(built_in + ours))
        self._known_keys[type_name, applied, written] = key
        return key

    def names(self, key: KindKey) -> frozenset[str]:
        """The schemas that prims of this kind answer to, UNKNOWN_TYPE or ABSTRACT_TYPE included."""
        if key not in self._names:
            self._names[key] = frozenset(key[1:]) | type_names(self._known_type(key[0]))
        return self._names[key]

    def _known_type(self, type_name: str) -> str:
        """The type itself if it is registered, else the first fallback that USD can use."""
        if is_registered(type_name):
            return type_name
        fallbacks = self._fallbacks.get(type_name, ())
        return next(filter(is_concrete, fallbacks), type_name)

    def is_a(self, prim: Any, name: str) -> bool:
        """Whether the prim answers to the schema of that name."""
        return name in self.names(self.key(prim))


def kinds_on(stage: Any) -> PrimKinds:
    """The kinds of prims on a stage: the same on all those that say no fallbacks of types."""
    fallbacks = stage.GetMetadata("fallbackPrimTypes")
    return PrimKinds(fallbacks) if fallbacks else _without_fallbacks()


@cache
def _without_fallbacks() -> PrimKinds:
    return PrimKinds()


@cache
def is_registered(type_name: str) -> bool:
    """Whether a plugin declares a schema of that name, a prim type or an applied API."""
    return not Usd.SchemaRegistry.GetTypeFromSchemaTypeName(type_name).isUnknown


@cache
def is_concrete(type_name: str) -> bool:
    """Whether prims can have that type: it is registered and not abstract."""
    return Usd.SchemaRegistry().FindConcretePrimDefinition(type_name) is not None


@cache
def type_names(type_name: str) -> frozenset[str]:
    """The schema names of a prim type and its bases; UNKNOWN_TYPE or ABSTRACT_TYPE if it is one."""
    if not type_name:
        return frozenset()
    if not is_registered(type_name):
        if type_name in schema.CONCRETE_TYPES:
            return frozenset((type_name, *schema.TYPE_BASES[type_name]))
        abstract = type_name in schema.ABSTRACT_TYPES
        return frozenset((schema.ABSTRACT_TYPE if abstract else schema.UNKNOWN_TYPE,))
    if not is_concrete(type_name):
        return frozenset((schema.ABSTRACT_TYPE,))
    ancestors = Usd.SchemaRegistry.GetTypeFromName(type_name).GetAllAncestorTypes()
    names = {Usd.SchemaRegistry.GetSchemaTypeName(ancestor) for ancestor in ancestors}
    # A newer USD may have more bases than the installed one.
    names.update(*(schema.TYPE_BASES.get(name, ()) for name in names))
    if "VolumeFieldAsset" in names:
        names.add(schema.FIELD_ASSET)  # its name in old USD, which rules subscribe to
    return frozenset(names - {""})


def _decoded_type(prim: Any) -> str:
    """The type of a prim; one that is no text is told as USD tells what it can't decode itself."""
    try:
        return str(get_type(prim))
    except UnicodeDecodeError as error:
        sys.excepthook(UnicodeDecodeError, error, None)
        return bytes(error.object).decode("utf-8", "backslashreplace")


def raw_apis(prim: Any) -> tuple[str, ...]:
    """The composed `apiSchemas` as written, including APIs that no plugin registers."""
    return tuple(prim.GetPrimTypeInfo().GetAppliedAPISchemas())
