"""STG010: what an `over` says should be said of a prim that something defines."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, quoted, rule
from usdvol_lint.schema import SPECIFIER


@rule("STG010", on=STAGE, severity=WARNING, since="0.1")
def override_misnamed(root: Prim, facts: Facts) -> Problems:
    for misnamed in facts.layers.misnamed:
        over, similar, properties, _, copies = misnamed
        more = f" and {len(properties) - 1} more" if len(properties) > 1 else ""
        where = f" (at {copies} prims)" if copies > 1 else ""
        yield Problem(
            f"no layer defines {over.GetName()!r}, there is only an over, so what it says of "
            f"{properties[0]!r}{more} reaches nothing{where}",
            at=over,
            spec=misnamed.spec,
            suggestion=f"did you mean {quoted(similar)}?",
            absent=[lacks(over, SPECIFIER)],
        )
