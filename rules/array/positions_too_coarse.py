"""ARR020: the numbers of positions must be finer than the particles that they place."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR020", on="ParticleField", severity=WARNING, since="0.1")
def positions_too_coarse(particles: Prim, facts: Facts, *, factor: float = 4.0, few: float = 0.1) -> Problems:
    found = facts.particles.coarse_positions(particles, factor)
    if not found or not _size_is_known(particles, facts):
        return
    seen, coarse, far = found.counts
    are_most_lost = far > 0.5 * seen
    if not are_most_lost and coarse <= few * seen:
        return
    kind = "half" if found.is_half else "float"
    amount = f"{factor:g} times the largest scale of {far:,}" if are_most_lost else f"the largest scale of {coarse:,}"
    yield Problem(
        f"at {found.largest:.8g}, the step from one {kind} to the next is {found.step:g}, "
        f"more than {amount} of {seen:,} particles{found.count}",
        at=found,
        against=[array.attribute for array in facts.particles.arrays(particles).used("scales")],
        severity=None if are_most_lost else INFO,
        suggestion=_remedy(found.is_half, found.middle),
    )


def _size_is_known(particles: Prim, facts: Facts) -> bool:
    """Whether there are scales, or certainly none."""
    if any(facts.particles.arrays(particles).used("scales")):
        return True
    return not facts.particles.is_told_as_misspelt(particles, "scales") and not facts.layers.may_lack_values(particles)


def _remedy(is_half: bool, middle: tuple[float, ...]) -> str:
    if is_half:
        return "author positions, in full precision, in place of positionsh"
    origin = ", ".join(f"{number:.8g}" for number in middle)
    return (
        f"subtract ({origin}) from positions and extent while they are still doubles, "
        "and author it as xformOp:translate"
    )
