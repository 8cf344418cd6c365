"""Variants that are not selected and hold a path for a field."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.facts.usd.instances import on_stage
from usdvol_lint.words import quoted


class VariantPath(NamedTuple):
    """A variant that names a file for a field; `selected` is that of its set, or ""."""

    set_name: str
    name: str
    selected: str

    @property
    def words(self) -> str:
        """What a message about the path that the field lacks ends with."""
        where = f"the variant set {quoted(self.set_name)}"
        has = f", but the variant {quoted(self.name)} of {where} has one"
        return f"{has}, and {'another' if self.selected else 'none'} is selected"

    @property
    def advice(self) -> str:
        """What to do, so that the other variants stay what they are."""
        where = f"the variant set {quoted(self.set_name)}"
        what = f"select a variant of {where}"
        if self.selected:
            what = f"author it in the variant {quoted(self.selected)} of {where}"
        return f"{what}: a path outside of it would hold for all variants"


def unselected_path(field: Any) -> VariantPath | None:
    """The first variant that is not selected and names a file; of a set without selection first."""
    found = sorted(_unselected(field), key=lambda each: bool(each.selected))
    return found[0] if found else None


def _unselected(field: Any) -> Iterator[VariantPath]:
    field = prim = on_stage(field)
    while prim and not prim.IsPseudoRoot():
        below = field.GetPath().MakeRelativePath(prim.GetPath()) if prim != field else None
        for spec in prim.GetPrimStack() if prim.HasVariantSets() else ():
            for set_name, variant_set in spec.variantSets.items():
                selected = prim.GetVariantSet(set_name).GetVariantSelection()
                for name, variant in variant_set.variants.items():
                    if name != selected and _names_a_file(variant.primSpec, below):
                        yield VariantPath(set_name, name, selected)
        prim = prim.GetParent()


def _names_a_file(variant: Any, below: Any) -> bool:
    path = variant.path.AppendPath(below) if below else variant.path
    spec = variant.layer.GetAttributeAtPath(path.AppendProperty("filePath"))
    if not spec:
        return False
    times = spec.layer.ListTimeSamplesForPath(spec.path)
    return bool(times) or (isinstance(spec.default, Sdf.AssetPath) and bool(spec.default.path))
