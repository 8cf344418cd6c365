"""What variants that are not selected may say of a prim."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from usdvol_lint.facts.usd.calls import ARCS, get_parent, get_prim_stack
from usdvol_lint.facts.usd.instances import on_stage

_BRINGS = (*ARCS, "variantSetNames")


def may_be_said(prim: Any, says: Callable[[Any], bool]) -> bool:
    """Whether a variant, of the prim or of one above it, that is not selected might say something.

    `says` tells it of a spec for the prim; what an arc in a variant brings is not known.
    """
    prim = on_stage(prim)
    path = prim.GetPath()
    return any(
        _may_say(variant, path.MakeRelativePath(above.GetPath()).GetPrefixes(), says)
        for above in _from(prim)
        for variant in _unselected(above)
    )


def _from(prim: Any) -> Iterator[Any]:
    """A prim and those above it."""
    while not prim.IsPseudoRoot():
        yield prim
        prim = get_parent(prim)


def _unselected(prim: Any) -> Iterator[Any]:
    """The specs of a prim's variants that are not selected."""
    sets = prim.GetVariantSets()
    for spec in get_prim_stack(prim) if sets.GetNames() else ():
        for name, variant_set in spec.variantSets.items():
            selected = sets.GetVariantSelection(name)
            yield from (
                each.primSpec for each in variant_set.variants.values() if each.name != selected
            )


def _may_say(variant: Any, prefixes: Iterable[Any], says: Callable[[Any], bool]) -> bool:
    """Whether a variant says it of the last of these relative paths, or has arcs there or above."""
    specs = [variant, *(variant.GetPrimAtPath(path) for path in prefixes if path.name != ".")]
    return any(spec and any(map(spec.HasInfo, _BRINGS)) for spec in specs) or bool(
        specs[-1] and says(specs[-1])
    )
