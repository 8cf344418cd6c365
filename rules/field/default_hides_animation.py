"""FLD006: a default must not hide the animation of a field's file."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, layered, quoted, rule


@rule("FLD006", on="FieldAsset", when=layered(), severity=WARNING, since="0.1")
def default_hides_animation(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    hidden = facts.prims.hidden_animation(paths.attribute)
    if hidden:
        default = quoted(paths.samples[0].authored)
        yield Problem(
            f"the default {default} holds at all times and hides {hidden.words}",
            at=paths.attribute,
            suggestion="author time samples in its place, or remove it",
        )
