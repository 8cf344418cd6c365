"""One cause, one finding: which findings of a stage tell of the same mistake."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import combinations

from usdvol_lint.model import Finding

OF_ONE_PROPERTY = (
    # Why a path leads to no file that can be read, and what an absolute one comes to.
    {"AST001", "AST002", "AST003", "AST005", "AST008", "AST009", "AST010", "AST015"},
    {"AST007", "AST002", "AST008", "AST015"},
    # What kind of file is there, whether it is whole, and what it holds.
    {"AST006", "GRD001", "GRD002", "GRD010", "AST002"},
    {"GRD003", "GRD004", "GRD008", "GRD001"},
    # What leads to one frame at all times, and what stands for a frame.
    {"AST017", "FLD006"},
    {"AST011", "AST018"},
    # What a relationship targets.
    {"VOL001", "VOL002", "VOL003", "VOL004", "VOL005", "VOL006", "VOL007", "VOL008"},
    # Whether an attribute is one of the schema's, and has its type.
    {"SCH003", "SCH004", "SCH016", "PRT007"},
    # How many elements an array has.
    {"ARR002", "ARR003", "ARR004", "ARR005"},
    # Numbers after exp or the sigmoid, and before it.
    {"ARR008", "ARR019"},
    {"ARR009", "ARR019", "ARR024"},
)
"""Codes that have one cause where they are found at one property and a common time."""

OF_ONE_PRIM = (
    {"AST006", "FLD007"},
    {"SCH001", "SCH002", "SCH011", "SCH012", "SCH014"},
    {"STG005", "SCH014"},
)
"""Codes that have one cause wherever they are found on a prim."""

ABSENT = {
    "AST001": "filePath",
    "FLD001": "fieldName",
    "FLD002": "fieldDataType",
    "SCH007": "extent",
    "ARR001": "positions",
    "ARR017": "radiance:sphericalHarmonicsCoefficients",
    "ARR021": "orientations",
    "PRT001": "positions",
    "PRT002": "a kernel",
    "PRT003": "radiance",
}
"""What is absent where a code is found."""

OF_ONE_FILE = {
    *("AST002", "AST003", "AST005", "AST008", "AST009", "AST010", "AST011", "AST012", "AST013"),
    *("AST015", "AST017", "AST018", "GRD001", "GRD002"),
}
"""Codes about files, which are found once where several fields of a prim name one."""

LOST_APIS = {"PRT006", "PRT009", "PRT010"}
"""Codes about APIs that are not applied, whose messages say what nothing gives a prim."""

_MEANT = re.compile(r"did you mean '([^']+)'")
_EFFECT = re.compile(r", so nothing gives these splats (.*)")
_RAW = re.compile(r"these look like (?:the )?(logits|logarithms)")


def told_twice(findings: Iterable[Finding]) -> list[str]:
    """Each two findings that have one cause and that no report tells in one line."""
    return [
        f"{one.code} at {one.site.prim}: {one.message}; {other.code}: {other.message}"
        for one, other in combinations(findings, 2)
        if one.site.prim
        and one.site.variant == other.site.variant
        and not _is_one_line(one, other)
        and _have_one_cause(one, other)
    ]


def _is_one_line(one: Finding, other: Finding) -> bool:
    """Whether reports for people fold the two."""
    return one.code == other.code and one.fold is not None and one.fold == other.fold


def _have_one_cause(one: Finding, other: Finding) -> bool:
    if _explains(one, other) or _explains(other, one):
        return True
    if one.site.prim != other.site.prim:
        return _name_one_file(one, other)
    if _is_of_positions(one, other) or _is_of_positions(other, one):
        return True
    codes = {one.code, other.code}
    if len(codes) == 2 and any(codes <= group for group in OF_ONE_PRIM):
        return True
    if one.site.property != other.site.property or not _meet(one, other):
        return False
    if one.message == other.message or _raw(one) & _raw(other):
        return True
    # Two opinions may each be wrong.
    is_one_place = len(codes) == 2 or one.site[:5] == other.site[:5]
    return is_one_place and any(codes <= group for group in OF_ONE_PROPERTY)


def _explains(cause: Finding, effect: Finding) -> bool:
    """Whether one finding says why what the other misses is absent."""
    if effect.code not in ABSENT:
        return False
    absent = ABSENT[effect.code]
    is_of_prim = effect.site.prim == cause.site.prim or f"<{cause.site.prim}>" in effect.message
    return is_of_prim and not _taken(cause).isdisjoint((absent, f"{absent}h"))


def _is_of_positions(cause: Finding, effect: Finding) -> bool:
    """Whether an extent is not finite because positions at the same times are not."""
    names = str(cause.site.property).removesuffix("h"), effect.site.property
    is_pair = (cause.code, effect.code, *names) == ("ARR007", "SCH008", "positions", "extent")
    is_covered = set(effect.site.times) <= set(cause.site.times)
    return is_pair and is_covered and "is not finite" in effect.message


def _taken(finding: Finding) -> set[str | None]:
    """What a misspelt name, another type or the lack of an API takes from a prim."""
    if finding.code == "SCH003":
        return {finding.site.property}
    if finding.code == "PRT007":
        name = finding.site.property or ""
        return {name, name.partition(":")[0]}
    if finding.code == "SCH004":
        return set(_MEANT.findall(finding.suggestion or ""))
    effect = _EFFECT.search(finding.message) if finding.code in LOST_APIS else None
    return set(effect[1].split(" or ")) if effect else set()


def _name_one_file(one: Finding, other: Finding) -> bool:
    """Whether fields of one prim are told the same of a file."""
    parents = {(finding.site.prim or "").rpartition("/")[0] for finding in (one, other)}
    told = {(finding.code, finding.message) for finding in (one, other)}
    return len(parents) == len(told) == 1 and one.code in OF_ONE_FILE


def _meet(one: Finding, other: Finding) -> bool:
    """Whether they are found at a common time; what has no times is so at all of them."""
    times, others = set(one.site.times), set(other.site.times)
    return not (times and others and times.isdisjoint(others))


def _raw(finding: Finding) -> set[str]:
    """What numbers are instead of those that the schema asks for, as the advice says."""
    return set(_RAW.findall(finding.suggestion or ""))
