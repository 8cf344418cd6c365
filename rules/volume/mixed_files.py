"""VOL014: the fields of one Volume should name one file."""

from usdvol_lint.rule import INFO, BindingMark, Facts, Prim, Problem, Problems, bindings, rule


@rule("VOL014", on="Volume", when=bindings(BindingMark.SEVERAL), severity=INFO, since="0.1")
def mixed_files(volume: Prim, facts: Facts) -> Problems:
    def is_told(field: Prim) -> bool:
        still = facts.tells("AST017") and facts.files.still(field, facts.layers.time_range)
        return bool(still and still.beside)

    mixed = facts.volumes.mixed_files(volume, is_told)
    if mixed:
        yield Problem(
            f"the fields name {len(mixed.fields)} files at one time, {mixed.shown}: some renderers read the first only",
            at=volume,
            against=mixed.opinions,
            times=mixed.times,
            at_default=mixed.at_default,
            suggestion="write the grids into one file, or give each file a Volume of its own",
        )
