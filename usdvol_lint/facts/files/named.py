"""Which files of a numbered family layers name beside a field: in variants, or for other prims."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.files.families import Family, read_family
from usdvol_lint.facts.usd.firsts import first_to_say
from usdvol_lint.facts.usd.instances import on_stage
from usdvol_lint.paths import FORMAT_ARGUMENTS


def in_variants(field: Any, family: Family) -> Iterator[int]:
    """The numbers of the files of a family that variants of the field, or above it, name."""
    prim = on_stage(field)
    while prim and not prim.IsPseudoRoot():
        for spec in prim.GetPrimStack() if prim.HasVariantSets() else ():
            for variant_set in spec.variantSets.values():
                for variant in variant_set.variants.values():
                    yield from _in_spec(variant.primSpec, family)
        prim = prim.GetParent()


def in_layer(field: Any, family: Family) -> Iterator[int]:
    """The numbers of the files of a family that defaults in the layer of the field's own name."""
    opinion = first_to_say(field.GetAttribute("filePath"), None)
    for spec in _file_paths(opinion.spec.layer.pseudoRoot) if opinion else ():
        if not spec.HasInfo("timeSamples"):
            yield from numbers_in(spec, spec.default, family)


def _file_paths(prim_spec: Any) -> Iterator[Any]:
    """The specs of `filePath` below a spec."""
    found: list[Any] = []

    def visit(path: Any) -> None:
        if path.IsPropertyPath() and path.name == "filePath":
            found.append(prim_spec.layer.GetAttributeAtPath(path))

    prim_spec.layer.Traverse(prim_spec.path, visit)
    return filter(None, found)


def _in_spec(prim_spec: Any, family: Family) -> Iterator[int]:
    for spec in _file_paths(prim_spec):
        yield from numbers_in(spec, spec.default, family)
        for time in spec.layer.ListTimeSamplesForPath(spec.path):
            yield from numbers_in(spec, spec.layer.QueryTimeSample(spec.path, time), family)


def numbers_in(spec: Any, value: Any, family: Family) -> set[int]:
    """The number of the file that a value in a layer names, if it is of the family."""
    if not isinstance(value, Sdf.AssetPath) or not value.path:
        return set()
    path, _, _ = value.path.partition(FORMAT_ARGUMENTS)
    found = read_family(spec.layer.ComputeAbsolutePath(path).replace(os.sep, "/"))
    return {found[0].number} if found and found[1] == family else set()
