"""FLD006: a default must not hide the animation of a field's file."""

from usdvol_lint.rule import WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("FLD006", on="FieldAsset", when=file_paths(PathMark.LAYERED), severity=WARNING, since="0.1")
def default_hides_animation(field: Prim, facts: Facts) -> Problems:
    hidden = facts.files.hidden_animation(field)
    if hidden:
        paths = facts.files.paths(field)
        default = quoted(paths.samples[0].authored)
        yield Problem(
            f"the default {default} holds at all times and hides {hidden}",
            at=paths.attribute,
            suggestion="author time samples in its place, or remove it",
        )
