"""FLD006: a default must not hide animation: of a field's file, of particles, of an extent."""

from collections.abc import Iterator

from usdvol_lint.rule import INFO, WARNING, Facts, ParticleArray, Prim, Prims, Problem, Problems, When, quoted, rule

_ON = ("FieldAsset", "ParticleField", "Volume")
_SLACK = 1e-5
_HALF_SLACK = 2**-10
_CLAMP = 50_000.0
_MAY_HIDE = When(Prims.authored, lambda authored: authored.is_layered or authored.is_clipped)


@rule("FLD006", on=_ON, when=_MAY_HIDE, severity=WARNING, since="0.1")
def default_hides_animation(prim: Prim, facts: Facts) -> Problems:
    if facts.prims.is_a(prim, "FieldAsset"):
        yield from _of_file(prim, facts)
    elif not facts.layers.may_lack_values(prim):
        for array, words, is_mild in _hidden_arrays(prim, facts):
            yield _problem(f"the default of {array.name!r}", words, array.attribute, is_mild)
        hidden = facts.prims.hidden_boxes_outside(prim, _SLACK)
        if hidden and not _extent_is_told_of(prim, facts):
            yield _problem(
                "the default of 'extent'",
                f"{hidden.words}, which it does not enclose",
                prim.GetAttribute("extent"),
                is_mild=True,
            )


def _of_file(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    hidden = facts.prims.hidden_animation(paths.attribute)
    if hidden:
        yield _problem(f"the default {quoted(paths.samples[0].authored)}", hidden.words, paths.attribute)


def _problem(default: str, hidden: str, attribute: object, is_mild: bool = False) -> Problem:
    return Problem(
        f"{default} holds at all times and hides {hidden}",
        at=attribute,
        severity=INFO if is_mild else None,
        suggestion="author time samples in its place, or remove it",
    )


def _hidden_arrays(particles: Prim, facts: Facts) -> Iterator[tuple[ParticleArray, str, bool]]:
    """The arrays without a sample whose hidden ones differ, and of positions also those that are all alike."""
    arrays = facts.particles.arrays(particles) if facts.prims.is_a(particles, "ParticleField") else None
    for array in arrays.used() if arrays else ():
        hidden = None if array.total else facts.prims.hidden_animation(array.attribute)
        if not arrays or not hidden:
            continue
        sizes = [len(value) for value in hidden.values()]
        if len(sizes) < 2 or (array.most not in sizes and not arrays.fit(array)):
            continue  # ARR002, ARR003 or ARR004 says it
        is_of_positions = array is arrays.positions
        if hidden.differs:
            yield array, hidden.words, not is_of_positions
        elif is_of_positions:
            yield array, f"{hidden.words}, which are all alike", True


def _extent_is_told_of(prim: Prim, facts: Facts) -> bool:
    """Whether VOL013 or ARR013 finds it too small."""
    if facts.prims.is_a(prim, "Volume"):
        return facts.volumes.shortfall(prim, _SLACK) is not None
    positions = facts.particles.arrays(prim).positions
    slack = _HALF_SLACK if positions and positions.is_half else _SLACK
    return facts.particles.positions_outside_extent(prim, slack, _CLAMP) is not None
