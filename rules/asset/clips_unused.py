"""AST016: value clips that hold what a volume or particle field needs must arrive there."""

from typing import Any

from usdvol_lint.rule import ERROR, STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, quoted, rule
from usdvol_lint.schema import CLIPS


@rule("AST016", on=STAGE, severity=ERROR, since="0.1")
def clips_unused(root: Prim, facts: Facts) -> Problems:
    for lost in facts.layers.clip_losses.lost:
        it, them = (f"the clip set {quoted(lost.name)}", "it") if lost.name else ("clips", "them")
        yield problem(f"{it} {lost.fault.what}: USD does not use {them}, and", lost, lost.advice, lost.name)
    for left in facts.layers.clip_losses.left_behind:
        advice = f"bring in <{left.path}>, or author its clips here too"
        yield problem(f"an arc to a prim below leaves behind {clips(left)}:", left, advice)
    for stopped in facts.layers.clip_losses.stopped:
        advice = "remove instanceable, or carry the clips on a prim inside what is instanced"
        yield problem(f"{clips(stopped.carrier)} do not reach into this instance:", stopped, advice)


def problem(what: str, lost: Any, advice: str | None, name: str = "") -> Problem:
    return Problem(
        f"{what} {effect(lost)}",
        at=lost.prim,
        spec=lost.spec,
        of=CLIPS,
        subject=name,
        suggestion=advice,
        severity=None if lost.without_value else WARNING,
        absent=absent(lost),
    )


def clips(carrier: Any) -> str:
    return f"the value clips of <{carrier.path}> in {quoted(carrier.layer.GetDisplayName())}"


def effect(lost: Any) -> str:
    """What the attributes lack."""
    missed: Any = lost.without_value or lost.attributes
    names = missed[0].GetName() + (f" and {len(missed) - 1} more" if len(missed) > 1 else "")
    what = "no value" if lost.without_value else "only a default, the same at all times"
    return f"{names} {'has' if len(missed) == 1 else 'have'} {what}"


def absent(lost: Any) -> list[tuple[tuple[Any, str], ...]]:
    """What each attribute lacks: what the clips need, or a value from elsewhere."""
    return [(*lacks(lost.prim, CLIPS), *lacks(each.GetPrim(), each.GetName())) for each in lost.attributes]
