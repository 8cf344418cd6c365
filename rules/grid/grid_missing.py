"""GRD003: the grid that a field names must be in its file."""

from typing import Any

from usdvol_lint.rule import ERROR, Content, Facts, Prim, Problem, Problems, contents, quoted, rule
from usdvol_lint.spelling import closest_name


def _missing(content: Content) -> tuple[str, str, bool] | None:
    """What is missing, where nothing of that name may lie in what was not read."""
    file, claim = content.file, content.claim
    if file is None or not file.complete or not claim.name or content.grids:
        return None
    return claim.name, claim.purpose, bool(file.grids)


@rule("GRD003", on="FieldAsset", when=contents(_missing), severity=ERROR, since="0.1")
def grid_missing(field: Prim, facts: Facts) -> Problems:
    for (name, purpose, has_grids), content, found in facts.grids.contents(field).grouped(_missing):
        holds = content.holds if has_grids else "no grids"
        where = f" of {purpose!r}" if purpose else ""
        yield Problem(
            f"no grid {quoted(name)}{where} in {found.shown}, which holds {holds}{found.count}",
            at=found,
            against=[field.GetAttribute("fieldName")],
            fold=None if has_grids else facts.files.alike(field),
            suggestion=_similar(name, content) or _choice(name, has_grids, field, found, facts),
        )


def _similar(name: str, content: Content) -> str | None:
    if content.claim.purpose and content.purposes:
        return f"did you mean fieldPurpose {' or '.join(map(quoted, content.purposes))}?"
    if parts := content.parts:
        return f"{quoted(name)} is split into {', '.join(map(quoted, parts))}: write it as one vector"
    meant = closest_name(name, content.grid_names - {""})
    return f"did you mean {quoted(meant)}?" if meant else None


def _choice(name: str, has_grids: bool, field: Prim, found: Any, facts: Facts) -> str:
    if not has_grids:
        return f"export it again with a grid {quoted(name)}, without voxels where there is nothing to show"
    if len(found.samples) < len(facts.files.paths(field).samples):
        return f"export a grid {quoted(name)} to these files too"
    return f"set fieldName to a grid that is there, or export a grid {quoted(name)}"
