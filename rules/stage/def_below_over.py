"""STG005: a `def` below an `over` that nothing defines is not on the stage."""

from usdvol_lint.rule import INFO, STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, quoted, rule
from usdvol_lint.schema import SPECIFIER


@rule("STG005", on=STAGE, severity=WARNING, since="0.1")
def def_below_over(root: Prim, facts: Facts) -> Problems:
    for undefined in facts.layers.undefined:
        over, prims, similar, copies = undefined
        if facts.tells("VOL008") and all(map(facts.volumes.is_targeted, prims)):
            continue
        first = f"{prims[0].GetTypeName()} {prims[0].GetName()!r}"
        more = f" and {len(prims) - 1} more" if len(prims) > 1 else ""
        what = f"{first}{more} below it {'are' if more else 'is'} not on the stage"
        where = f" (at {copies} prims)" if copies > 1 else ""
        name = over.GetName()
        kind = f"{over.GetTypeName()} " if over.GetTypeName() else ""
        yield Problem(
            f"no layer defines {name!r}, there is only an over, so {what}{where}",
            at=over,
            spec=undefined.spec,
            severity=None if similar else INFO,
            suggestion=f"did you mean {quoted(similar)}?"
            if similar
            else f"write 'def {kind}\"{name}\"' where it should be drawn",
            absent=[lacks(over, SPECIFIER)],
        )
