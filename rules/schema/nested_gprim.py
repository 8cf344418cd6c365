"""SCH009: Volumes and particle fields are Gprims, and Gprims do not nest."""

from usdvol_lint.rule import WARNING, Facts, Prim, Prims, Problem, Problems, When, rule


@rule("SCH009", on=("Volume", "ParticleField"), when=When(Prims.are_nested, bool), severity=WARNING, since="0.1")
def nested_gprim(prim: Prim, facts: Facts) -> Problems:
    above = facts.prims.gprim_above(prim)
    if above:
        yield Problem(
            f"{prim.GetTypeName()} below {_named(above, facts)}, which is a Gprim too, and Gprims do not nest",
            at=prim,
            against=[above],
            suggestion="move it beside that prim, below a common Xform",
        )
    for gprim, place in facts.prims.gprims_below(prim):
        held = "" if gprim == place else f", which holds {_named(gprim, facts)},"
        what = gprim.GetTypeName() if gprim == place else "an instance"
        yield Problem(
            f"{what}{held} below {_named(prim, facts)}, which is a Gprim too, and Gprims do not nest",
            at=place,
            of=None if gprim == place else "references",
            against=[prim] if gprim == place else [],
            subject=place.GetName(),
            suggestion=f"move it beside the {prim.GetTypeName()}, below a common Xform",
        )


def _named(prim: Prim, facts: Facts) -> str:
    return f"{prim.GetTypeName()} <{facts.prims.shown_path(prim)}>"
