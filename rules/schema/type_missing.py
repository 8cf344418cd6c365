"""SCH014: what makes a Volume or splat is nothing on a prim of another type, or of none."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import PARTICLE_FIELD_ONLY_APIS, TYPE_NAME


@rule("SCH014", on=STAGE, severity=WARNING, since="0.1")
def type_missing(stage: Prim, facts: Facts) -> Problems:
    for prim, binding in facts.volumes.lookalikes:
        if facts.tells("SCH010") and not set(facts.particles.apis(prim).applied).isdisjoint(PARTICLE_FIELD_ONLY_APIS):
            continue
        kind = f"of type {prim.GetTypeName()!r}" if prim.GetTypeName() else "without a type"
        wanted = "Volume" if binding else "ParticleField3DGaussianSplat"
        yield Problem(
            (f"{binding.GetName()!r} to a field" if binding else "all the arrays of a splat")
            + f" on a prim {kind}: nothing is drawn",
            at=prim,
            against=[binding or prim.GetAttribute("positions")],
            suggestion=f'make it a {wanted}: def {wanted} "{prim.GetName()}"',
            absent=[lacks(prim, TYPE_NAME)],
        )
