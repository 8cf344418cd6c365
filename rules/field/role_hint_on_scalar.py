"""FLD003: only vectors have a role."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, authored, rule
from usdvol_lint.schema import SCALAR_DATA_TYPES

_ROLE, _DATA_TYPE = "vectorDataRoleHint", "fieldDataType"


@rule("FLD003", on="FieldAsset", when=authored(_ROLE), severity=INFO, since="0.1")
def role_hint_on_scalar(field: Prim, facts: Facts) -> Problems:
    declared = facts.prims.authored(field).declared
    if _ROLE not in declared:
        return
    types = list(facts.prims.values(field, _DATA_TYPE))
    if not all(isinstance(name, str) and name in SCALAR_DATA_TYPES for name in types):
        return
    roles = [token for token in declared[_ROLE].tokens if token != "None"]
    for role, held in facts.prims.values(field, _ROLE).grouped(lambda value: _among(roles, value)):
        yield Problem(
            f"{_ROLE} {role!r} on a field of type {types[0]!r}, which is no vector{held.count}",
            at=held,
            against=[field.GetAttribute(_DATA_TYPE)],
            suggestion=f"remove it, or correct {_DATA_TYPE}",
        )


def _among(roles: list[str], value: object) -> str | None:
    return value if isinstance(value, str) and value in roles else None
