"""SCH004: an attribute whose name is not quite one of the schema's is read by nobody."""

from typing import Any

from usdvol_lint.rule import ERROR, OURS, WARNING, Facts, Prim, Prims, Problem, Problems, When, lacks, rule

_LOSSES = {"filePath": "so no file is found", "fieldName": "so the field names no grid"}


@rule(
    "SCH004",
    on=OURS,
    when=When(Prims.authored, lambda authored: bool(authored.misspellings)),
    severity=ERROR,
    since="0.1",
)
def attribute_misspelt(prim: Prim, facts: Facts) -> Problems:
    for slip in () if facts.prims.encoding(prim) else facts.prims.misspelt(prim):
        meant, loss = slip.intended, _loss(slip, prim, facts)
        holds_all = meant.startswith("positions") and _holds_the_particles(slip, prim, facts)
        yield Problem(
            f"{prim.GetTypeName()} has no attribute {slip.shown!r}"
            + (f", only {f'{slip.hiding} {slip.attribute.GetName()}'!r}" if slip.hiding else "")
            + (f", so {meant!r} keeps the value of a weaker layer" if slip.overridden else "")
            + (f", {loss}" if loss else "")
            + (f", and without {meant!r} no particles" if holds_all else ""),
            at=slip.attribute,
            severity=None if holds_all or slip.hiding or (loss and meant == "filePath") else WARNING,
            suggestion=f"did you mean {meant!r}?",
            absent=[lacks(prim, meant)] if loss else (),
        )


def _loss(slip: Any, prim: Prim, facts: Facts) -> str:
    """In words what nothing says instead; empty where something else may, or was not meant to."""
    if slip.overridden or slip.intended not in _LOSSES or facts.layers.may_lack_values(prim):
        return ""
    files = facts.files if slip.intended == "filePath" else None
    is_elsewhere = files and (files.paths(prim).is_only_declared or files.unlisted_clips(prim))
    return "" if is_elsewhere else _LOSSES[slip.intended]


def _holds_the_particles(slip: Any, particles: Prim, facts: Facts) -> bool:
    """Whether a particle field has no particles, and this array has elements."""
    if not facts.particles.arrays(particles).lack_positions:
        return False
    values = facts.prims.values(particles, slip.attribute.GetName())
    has_elements = slip.attribute.GetTypeName().isArray and any(map(len, values))
    return has_elements and not facts.layers.may_lack_values(particles)
