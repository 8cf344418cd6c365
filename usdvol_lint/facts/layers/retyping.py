"""Prims whose type, from a stronger layer, hides one of ours."""

from __future__ import annotations

from collections.abc import Iterable
from os.path import splitext
from typing import Any

from usdvol_lint import schema
from usdvol_lint.facts.prims.retyped import Retyped, retyped_ours
from usdvol_lint.facts.usd.arcs import Layered
from usdvol_lint.facts.usd.calls import get_type, holder_of
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.facts.usd.untyped import GROUP_TYPES


def retyped_prims(layered: Iterable[Layered], kinds: PrimKinds) -> dict[Any, Retyped]:
    """By path: the prims that would be a Volume, field or particle field but for a stronger type.

    What USD takes a prim for counts, so a type with a fallback of ours hides nothing.  One of ours
    hides that the prim is a field of another type, if it names a file as that one does, and any
    other of ours whose data it has in vain.
    """
    found = []
    for prim, specs, _ in layered:
        type_name = get_type(prim)
        if type_name in schema.FILE_EXTENSIONS:
            found.append(_retyped_field(prim, specs, type_name, kinds))
        elif type_name and _is_ours(kinds, (type_name,)):
            found.append(retyped_ours(prim, specs, kinds))
        elif type_name:
            found.append(_retyped(prim, specs, kinds))
    by_path = {each.prim.GetPath(): each for each in found if each}
    return dict(sorted(by_path.items()))


def _retyped(prim: Any, specs: list[Any], kinds: PrimKinds) -> Retyped | None:
    typed = [spec for spec in specs if spec.typeName]
    for number, spec in enumerate(typed):
        if _is_ours(kinds, (spec.typeName,)):
            is_field = _is_field(kinds, spec)
            stands_in = not is_field and get_type(prim) not in GROUP_TYPES
            return Retyped(prim, spec, tuple(typed[:number]), is_field, stands_in)
    return None


def _retyped_field(prim: Any, specs: list[Any], type_name: str, kinds: PrimKinds) -> Retyped | None:
    """What the type of a field hides: that of one for another file, or of what is drawn."""
    for number, spec in enumerate(specs):
        stronger = tuple(each for each in specs[:number] if each.typeName)
        if spec.typeName in schema.FILE_EXTENSIONS and spec.typeName != type_name:
            extension = schema.FILE_EXTENSIONS[spec.typeName]
            is_meant = _names_file(prim, specs[number:], extension)
            return Retyped(prim, spec, stronger, True, False) if is_meant else None
        if spec.typeName and _is_ours(kinds, (spec.typeName,)) and not _is_field(kinds, spec):
            has_file = prim.GetAttribute("filePath").HasAuthoredValue()  # or it lacks that first
            return Retyped(prim, spec, stronger, False, False) if has_file else None
    return None


def _names_file(prim: Any, specs: list[Any], extension: str) -> bool:
    """Whether these specs give a field its file, and that has the extension."""
    attribute = prim.GetAttribute("filePath")
    time = next(iter(attribute.GetTimeSamples()), None)
    opinion = strongest_opinion(attribute, time)
    value = attribute.Get() if time is None else attribute.Get(time)
    is_given = opinion is not None and holder_of(opinion.spec) in specs
    return is_given and splitext(getattr(value, "path", ""))[1].lower() == extension


def _is_ours(kinds: PrimKinds, key: tuple[str, ...]) -> bool:
    return not schema.OURS.isdisjoint(kinds.names(key))


def _is_field(kinds: PrimKinds, spec: Any) -> bool:
    return schema.FIELD in kinds.names((spec.typeName,))
