"""ARR008: an opacity goes from 0 to 1."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("ARR008", on="ParticleField", severity=ERROR, since="0.1")
def opacity_out_of_range(particles: Prim, facts: Facts, *, tolerance: float = 1e-3) -> Problems:
    for array in facts.particles.arrays(particles).used("opacities"):
        found = array.outside(-tolerance, 1 + tolerance)
        is_raw = facts.particles.are_raw(array, found)
        if found and array.low and array.high and not (is_raw and array.has_infinity):  # ARR007 says it
            (low,), (high,) = array.low, array.high
            yield Problem(
                f"{found.amount} outside of 0 to 1, from {low:.6g} to {high:.6g}, {found.first}",
                at=found,
                suggestion=_LOGITS if is_raw else _remedy(low, high, found.share),
            )


_LOGITS = "these look like the logits of a PLY file: apply the sigmoid, 1 / (1 + exp(-x)), before the export"


def _remedy(low: float, high: float, share: float) -> str:
    """Bytes reach far beyond what logits do; few strays are neither."""
    if share > 0.5 and low >= 0 and high <= 255:
        return "these look like bytes: divide them by 255 before the export"
    return "clamp them to 0 and 1 before the export"
