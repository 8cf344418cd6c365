"""ARR027: the samples of animated particles should cover the time range of the stage."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR027", on="ParticleField", severity=WARNING, since="0.1")
def sample_range_differs(particles: Prim, facts: Facts) -> Problems:
    wanted, arrays = facts.layers.time_range, facts.particles.arrays(particles)
    if wanted is None or facts.layers.may_lack_values(particles):
        return
    for span in arrays.spans():
        are_positions = span.arrays[0] is arrays.positions
        if are_outside := span.is_outside(wanted):
            severity = None if are_positions else INFO
            advice = f"if they are to begin with the stage, {span.advice_on_shift(wanted.start)}"
        else:
            severity = None if wanted.is_asked else INFO
            advice = "write the frames that are missing" + ", or correct the range of the stage" * (not wanted.is_asked)
        seen = [words for words, times in span.held(wanted) if not span.is_hidden(times)]
        is_told = facts.tells("STG008") and facts.layers.rate_is_unsaid(span.attribute)
        if seen and (are_positions or are_outside) and not is_told and span.is_animated:
            yield Problem(
                f"the samples of {span.names} {wanted.beside(span.first, span.last)}: {' and '.join(seen)}",
                at=span.attribute,
                spec=wanted.meeting_samples(span.attribute, span.first, span.last),
                suggestion=span.rate_at_fault(wanted) or advice,
                severity=severity,
            )
