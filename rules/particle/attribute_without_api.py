"""PRT007: an attribute counts only if the API that declares it is applied."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, rule
from usdvol_lint.schema import API_ATTRIBUTES


@rule("PRT007", on="ParticleField", severity=WARNING, since="0.1")
def attribute_without_api(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    declared = frozenset(particles.GetPrimDefinition().GetPropertyNames())
    for api, names in API_ATTRIBUTES.items():
        if apis.has(api):
            continue
        attributes = [particles.GetAttribute(name) for name in names if name not in declared]
        authored = [attribute for attribute in attributes if attribute.HasAuthoredValue()]
        if authored:
            yield Problem(
                f"{', '.join(repr(attribute.GetName()) for attribute in authored)} without {api!r}{apis.doubt}",
                at=authored[0],
                severity=INFO if apis.third_party else None,
                suggestion=f"apply {api}",
            )
