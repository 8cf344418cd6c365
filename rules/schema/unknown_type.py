"""SCH001: a prim whose type USD does not know is nothing to USD."""

from usdvol_lint.rule import ERROR, TYPE, UNKNOWN_TYPE, WARNING, Facts, NotChecked, Prim, Problem, Problems, rule
from usdvol_lint.schema import PARTICLE_FIELD_ONLY_APIS
from usdvol_lint.spelling import is_slip, misspelt_type, versioned_type


@rule("SCH001", on=UNKNOWN_TYPE, severity=ERROR, since="0.1")
def unknown_type(prim: Prim, facts: Facts) -> Problems:
    name = prim.GetTypeName()
    version_of, meant = versioned_type(name), misspelt_type(name)
    if version_of and facts.prims.has_data_of(prim, version_of) and not _is_reported(prim, facts):
        yield NotChecked(
            f"type {name!r} was not checked: if it is a version of {version_of!r}, its plugin is not installed here",
            at=prim,
            of=TYPE,
        )
    elif meant and not version_of and not facts.prims.encoding(prim):
        yield Problem(
            f"USD knows no type {name!r}",
            at=prim,
            of=TYPE,
            severity=None if is_slip(name, meant) and _is_in_use(prim, meant, facts) else WARNING,
            suggestion=f"did you mean {meant!r}?",
        )


def _is_in_use(prim: Prim, meant: str, facts: Facts) -> bool:
    """Whether the prim would be drawn if it had the type, as far as all of it is composed."""
    is_read = facts.prims.has_data_of(prim, meant) or facts.volumes.is_target_of_unknown_type(prim)
    return is_read and not facts.layers.may_lack(prim)


def _is_reported(prim: Prim, facts: Facts) -> bool:
    """Whether VOL002 or SCH010 says already that the type is not known."""
    has_apis = not set(PARTICLE_FIELD_ONLY_APIS).isdisjoint(facts.particles.apis(prim).applied)
    is_target = facts.volumes.is_target_of_unknown_type(prim)
    return (is_target and facts.tells("VOL002")) or (has_apis and facts.tells("SCH010"))
