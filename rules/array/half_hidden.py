"""ARR012: of a float and a half array only one is ever read."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, quoted, rule


@rule("ARR012", on="ParticleField", severity=WARNING, since="0.1")
def half_hidden(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    pairs = [(pair.used, pair.hidden) for pair in arrays.pairs.values() if pair.used and pair.hidden]
    for are_half in (True, False):
        found = [(used, hidden) for used, hidden in pairs if hidden.is_half == are_half]
        if not found:
            continue
        hidden = ", ".join(quoted(array.name) for _, array in found)
        used, s, are, one = quoted(found[0][0].name), "s", "is", "one of them"
        if len(found) > 1:
            used, s, are, one = f"the {'float' if are_half else 'half'} arrays", "", "are", "one of each pair"
        sizes = [(arrays.size_difference(*pair), pair[1]) for pair in found]
        differing = next((differs for differs in sizes if differs[0]), None)
        if are_half:
            who = differing[1].noun if differing and len(found) > 1 else "they"
            message = f"{used} count{s}, so {hidden} {are} never read"
            message += f"; {who} differ in size: {differing[0]}" if differing else ""
        else:
            message = f"{hidden} {are} empty at the earliest time, so {used} count{s} at all times"
        yield Problem(
            message,
            at=(differing or sizes[0])[1].attribute,
            against=[used.attribute for used, _ in found],
            severity=None if differing else INFO,
            suggestion=f"author only {one}",
        )
