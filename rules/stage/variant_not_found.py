"""STG011: a variant selection must name a variant that is there."""

from usdvol_lint.rule import INFO, STAGE, WARNING, Facts, Prim, Problem, Problems, quoted, rule


@rule("STG011", on=STAGE, severity=WARNING, since="0.1")
def variant_not_found(root: Prim, facts: Facts) -> Problems:
    for prim, spec, set_name, variant, known, similar, copies in facts.layers.wrong_selections:
        where = f" (at {copies} prims)" if copies > 1 else ""
        there = f"there is no variant set {quoted(set_name)} to select {quoted(variant)} in"
        if known:
            there = f"the variant set {quoted(set_name)} has no {quoted(variant)}"
        named = ", ".join(map(quoted, known[:5])) + ", …" * (len(known) > 5)
        yield Problem(
            f"{there}, so nothing of its variants is on the stage{where}",
            at=prim,
            spec=spec,
            subject=set_name,
            severity=None if similar else INFO,
            suggestion=f"did you mean {quoted(similar)}?" if similar else f"it has {named}",
        )
