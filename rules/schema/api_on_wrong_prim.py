"""SCH010: the APIs of particle fields belong on particle fields."""

from usdvol_lint.rule import APIS, ERROR, TYPE, UNKNOWN_TYPE, Facts, NotChecked, Prim, Problem, Problems, rule
from usdvol_lint.schema import PARTICLE_FIELD, PARTICLE_FIELD_ONLY_APIS
from usdvol_lint.spelling import misspelt_type


@rule("SCH010", on=PARTICLE_FIELD_ONLY_APIS, severity=ERROR, since="0.1")
def api_on_wrong_prim(prim: Prim, facts: Facts) -> Problems:
    if facts.prims.is_a(prim, PARTICLE_FIELD) or facts.layers.hides_ours(prim):
        return
    type_name = prim.GetTypeName()
    applied = [api for api in facts.particles.apis(prim).applied if api in PARTICLE_FIELD_ONLY_APIS]
    names = ", ".join(map(repr, applied))
    if not facts.prims.is_a(prim, UNKNOWN_TYPE):
        yield Problem(
            f"{names} on {repr(type_name) if type_name else 'a prim without a type'}, so no particles are drawn",
            at=prim,
            of=TYPE,
            against=[(prim, (APIS, api)) for api in applied],
            suggestion="make the type ParticleField or ParticleField3DGaussianSplat",
        )
    elif not (misspelt_type(type_name) and facts.tells("SCH001")):
        yield NotChecked(f"{names} on {type_name!r}, a type this USD does not know", at=prim)
