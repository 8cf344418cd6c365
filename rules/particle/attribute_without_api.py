"""PRT007: an attribute counts only if the API that declares it is applied."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, lacks, rule


@rule("PRT007", on="ParticleField", severity=WARNING, since="0.1")
def attribute_without_api(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    for api, attributes in facts.particles.without_api(particles):
        for attribute in attributes:
            yield Problem(
                f"{attribute.GetName()!r} is not read: {api!r} is not applied{apis.doubt}",
                at=attribute,
                absent=[lacks(particles, word) for word in apis.absent(api)],
                fold=f"{facts.prims.shown_path(particles)} {api}",
                severity=INFO if apis.third_party else None,
                suggestion=f"apply {api}",
            )
